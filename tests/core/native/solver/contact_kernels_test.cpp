#include "core/native/solver/contact_kernels.hpp"
#include "core/native/solver/contact_problem.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "core/native/solver/each_instruction_set.hpp"
#include "core/native/solver/random_contacts.hpp"
#include "same_bits.hpp"

namespace contact_kernels_test {

using namespace holdfast::internal;
using namespace holdfast::internal::native;

namespace {

/// One iteration by the kernels: `relax`, then `project` of where it leads.
struct Sweep {
  PrimalResidual primal_residual;
  std::vector<ConstraintVector> u = std::vector<ConstraintVector>(kConstraints), g = u, r = u;
  std::vector<LaneWrench> wrench = std::vector<LaneWrench>(kBodies + 1);

  Sweep(RandomContacts& contacts, bool with_mid_arms) {
    primal_residual = relax(contacts.constraints, contacts.velocity, u, g, r);
    project(Projection::coulomb, contacts.constraints, with_mid_arms ? contacts.mid_arms : std::vector<Arms>(), g, u,
            {}, wrench);
  }
};

using Wrench = Eigen::Matrix<double, kBodyRows, 1>;

/// What `relax` and `project` are said to do, point by point.
struct PlainSweep {
  PrimalResidual primal_residual;
  std::vector<Wrench> wrench = std::vector<Wrench>(kBodies + 1, Wrench::Zero());

  explicit PlainSweep(RandomContacts& contacts, bool with_mid_arms) {
    for (std::size_t p = 0; p < kConstraints; ++p) {
      const ContactConstraint& constraint = contacts.constraints[p];
      for (std::size_t lane = 0; lane < static_cast<std::size_t>(constraint.count); ++lane)
        take(contacts.constraints[p], with_mid_arms ? contacts.mid_arms[p] : constraint.arms, lane, contacts.velocity);
    }
  }

  void take(ContactConstraint& constraint, const Arms& mid, std::size_t lane, const std::vector<BodyVector>& velocity) {
    Mat3 directions;  // Its rows are the normal and the tangents.
    for (std::size_t d = 0; d < 3; ++d)
      for (std::size_t i = 0; i < 3; ++i)
        directions(static_cast<Eigen::Index>(d), static_cast<Eigen::Index>(i)) = constraint.directions[d][i];
    const auto speed = [&](std::int32_t body, const std::array<Lanes, 3>& arms) {
      const BodyVector& v = velocity[static_cast<std::size_t>(body)];
      return Vec3(linear(v) + angular(v).cross(arm_of(arms, lane)));
    };
    Vec3 u = directions * (speed(constraint.b, constraint.arms.b) - speed(constraint.a, constraint.arms.a));
    u += Vec3(constraint.velocity_bias.row[0][lane], constraint.velocity_bias.row[1][lane],
              constraint.velocity_bias.row[2][lane]);
    const double tangential = constraint.penalty[1][lane];
    const Vec3 penalty(constraint.penalty[0][lane], tangential, tangential);
    const Vec3 z(constraint.contact_velocity.row[0][lane], constraint.contact_velocity.row[1][lane],
                 constraint.contact_velocity.row[2][lane]);
    const Vec3 impulse(constraint.impulse.row[0][lane], constraint.impulse.row[1][lane],
                       constraint.impulse.row[2][lane]);
    const Vec3 x = impulse - penalty.cwiseProduct(u);
    Vec3 y = x;
    y.x() = std::max(0.0, x.x());
    const double radius = constraint.friction * y.x();
    const double length = std::hypot(x.y(), x.z());
    if (length > radius) y.tail<2>() = x.tail<2>() * (radius / length);
    // Of the iterate before, which the iteration starts from.
    primal_residual.largest = std::max(primal_residual.largest, (u - z).cwiseAbs().maxCoeff());
    primal_residual.squares += (u - z).squaredNorm();
    const Vec3 slip = (y - x).cwiseQuotient(penalty);
    for (std::size_t i = 0; i < 3; ++i) {
      constraint.impulse.row[i][lane] = y[static_cast<Eigen::Index>(i)];
      constraint.contact_velocity.row[i][lane] = slip[static_cast<Eigen::Index>(i)];
    }
    const Vec3 force = directions.transpose() * (y + penalty.cwiseProduct(slip - u));
    add(constraint.b, arm_of(mid.b, lane), force);
    add(constraint.a, arm_of(mid.a, lane), -force);
  }

  void add(std::int32_t body, const Vec3& arm, const Vec3& force) {
    wrench[static_cast<std::size_t>(body)].head<3>() += force;
    wrench[static_cast<std::size_t>(body)].tail<3>() += arm.cross(force);
  }
};

Wrench total(const LaneWrench& wrench) {
  Wrench sum = Wrench::Zero();
  for (Eigen::Index i = 0; i < kBodyRows; ++i)
    for (const double lane : wrench.row[i]) sum[i] += lane;
  return sum;
}

/// Impulses and slips only: a constraint has padding.
bool same_constraints(const std::vector<ContactConstraint>& a, const std::vector<ContactConstraint>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const ContactConstraint& p, const ContactConstraint& q) {
    return same_bits(std::vector{p.impulse}, std::vector{q.impulse}) &&
           same_bits(std::vector{p.contact_velocity}, std::vector{q.contact_velocity});
  });
}

}  // namespace

TEST_CASE("contact_kernels: a sweep does what its formulas say", "[core][contact_kernels]") {
  for (const bool with_mid_arms : {false, true}) {
    RandomContacts contacts = random_contacts(11);
    RandomContacts copy = contacts;
    const Sweep swept(contacts, with_mid_arms);
    const PlainSweep plain(copy, with_mid_arms);
    double worst = 0.0;
    for (std::size_t p = 0; p < kConstraints; ++p) {
      for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
          worst = std::max(
              {worst, std::abs(contacts.constraints[p].impulse.row[i][lane] - copy.constraints[p].impulse.row[i][lane]),
               std::abs(contacts.constraints[p].contact_velocity.row[i][lane] -
                        copy.constraints[p].contact_velocity.row[i][lane])});
        }
      }
    }
    double worst_wrench = 0.0;
    for (std::size_t body = 0; body < kBodies; ++body)
      worst_wrench = std::max(worst_wrench, (total(swept.wrench[body]) - plain.wrench[body]).cwiseAbs().maxCoeff());
    CAPTURE(with_mid_arms, worst, worst_wrench);
    CHECK(worst < 1e-13);
    CHECK(worst_wrench < 1e-12);
    CHECK(swept.primal_residual.largest == Approx(plain.primal_residual.largest).epsilon(1e-13));
    CHECK(swept.primal_residual.squares == Approx(plain.primal_residual.squares).epsilon(1e-13));
  }
}

TEST_CASE("contact_kernels: relaxed and projected in one pass, the bits are those of two", "[core][contact_kernels]") {
  for (const bool with_mid_arms : {false, true}) {
    RandomContacts contacts = random_contacts(14);
    RandomContacts copy = contacts;
    const Sweep swept(contacts, with_mid_arms);
    std::vector<LaneWrench> wrench(kBodies + 1);
    const PrimalResidual residual =
        relax_and_project(Projection::coulomb, copy.constraints, with_mid_arms ? copy.mid_arms : std::vector<Arms>(),
                          copy.velocity, {}, wrench);
    CHECK(same_constraints(contacts.constraints, copy.constraints));
    CHECK(same_bits(swept.wrench, wrench));
    CHECK(residual.largest == swept.primal_residual.largest);
    CHECK(residual.squares == swept.primal_residual.squares);
  }
}

TEST_CASE("contact_kernels: a sweep leaves every impulse in its cone, and unused lanes at nothing",
          "[core][contact_kernels]") {
  RandomContacts contacts = random_contacts(12);
  const Sweep swept(contacts, false);
  int sticking = 0, sliding = 0, open = 0;
  for (const ContactConstraint& constraint : contacts.constraints) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const double normal = constraint.impulse.row[0][lane];
      const double tangential = std::hypot(constraint.impulse.row[1][lane], constraint.impulse.row[2][lane]);
      CAPTURE(lane, constraint.count, constraint.friction, normal, tangential);
      if (lane >= static_cast<std::size_t>(constraint.count)) {
        for (std::size_t i = 0; i < 3; ++i) {
          CHECK(constraint.impulse.row[i][lane] == 0.0);
          CHECK(constraint.contact_velocity.row[i][lane] == 0.0);
        }
        continue;
      }
      CHECK(normal >= 0.0);
      CHECK(tangential <= constraint.friction * normal * (1 + 4e-16));
      const double slip =
          std::hypot(constraint.contact_velocity.row[1][lane], constraint.contact_velocity.row[2][lane]);
      (normal == 0.0 ? open : slip < 1e-12 ? sticking : sliding) += 1;
      // Friction acts against the slip, the normal impulse only where nothing parts.
      CHECK(constraint.impulse.row[1][lane] * constraint.contact_velocity.row[1][lane] +
                constraint.impulse.row[2][lane] * constraint.contact_velocity.row[2][lane] ==
            Approx(-slip * tangential).margin(1e-12));
      CHECK(std::abs(normal * constraint.contact_velocity.row[0][lane]) < 1e-12);
    }
  }
  CAPTURE(sticking, sliding, open);
  CHECK(std::min({sticking, sliding, open}) > 5);
}

TEST_CASE("contact_kernels: impulses add up to what they do to the bodies", "[core][contact_kernels]") {
  RandomContacts contacts = random_contacts(13);
  std::vector<LaneWrench> wrench(kBodies + 1);
  add_impulses(contacts.constraints, contacts.mid_arms, wrench);
  std::vector<Wrench> expected(kBodies + 1, Wrench::Zero());
  for (std::size_t p = 0; p < kConstraints; ++p) {
    const ContactConstraint& constraint = contacts.constraints[p];
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      Vec3 force = Vec3::Zero();
      for (std::size_t d = 0; d < 3; ++d)
        force += constraint.impulse.row[d][lane] *
                 Vec3(constraint.directions[d][0], constraint.directions[d][1], constraint.directions[d][2]);
      const auto on = [&](std::int32_t body) -> Wrench& { return expected[static_cast<std::size_t>(body)]; };
      on(constraint.b).head<3>() += force;
      on(constraint.b).tail<3>() += arm_of(contacts.mid_arms[p].b, lane).cross(force);
      on(constraint.a).head<3>() -= force;
      on(constraint.a).tail<3>() -= arm_of(contacts.mid_arms[p].a, lane).cross(force);
    }
  }
  double worst = 0.0;
  for (std::size_t body = 0; body <= kBodies; ++body)
    worst = std::max(worst, (total(wrench[body]) - expected[body]).cwiseAbs().maxCoeff());
  CAPTURE(worst);
  CHECK(worst < 1e-13);
}

TEST_CASE("contact_kernels: the power that impulses can take is what it is point by point", "[core][contact_kernels]") {
  const RandomContacts contacts = random_contacts(61);
  Random random(62);
  std::vector<NormalBounds> most(kConstraints);
  for (NormalBounds& bounds : most)
    for (double& bound : bounds.lane) bound = random.between(0.0, 3.0);
  std::vector<ConstraintVector> u(kConstraints);
  find_contact_velocities(contacts.constraints, contacts.velocity, u);
  double bounded = 0.0, unbounded = 0.0;
  for (std::size_t p = 0; p < kConstraints; ++p) {
    const ContactConstraint& constraint = contacts.constraints[p];
    for (std::size_t lane = 0; lane < static_cast<std::size_t>(constraint.count); ++lane) {
      const double slip = std::hypot(u[p].row[1][lane], u[p].row[2][lane]);
      const double taken = std::max(0.0, constraint.friction * slip - u[p].row[0][lane]);
      bounded += std::min(1.5, most[p].lane[lane]) * taken;
      unbounded += 1.5 * taken;
    }
  }
  CHECK(supported_power(contacts.constraints, contacts.velocity, 1.5, most) == Approx(bounded).epsilon(1e-12));
  CHECK(supported_power(contacts.constraints, contacts.velocity, 1.5, {}) == Approx(unbounded).epsilon(1e-12));
  CHECK(bounded < 0.9 * unbounded);
}

TEST_CASE("contact_kernels: every instruction set computes the same bits", "[core][contact_kernels]") {
  const RandomContacts contacts = random_contacts(31);
  struct Output {
    std::vector<ContactConstraint> constraints;
    std::vector<LaneWrench> swept, added = std::vector<LaneWrench>(kBodies + 1);
    std::vector<ConstraintVector> u, g, r, difference, step;
    PrimalResidual primal_residual;
    std::array<double, 6> product{};  // one more than the accelerated iteration asks for
    double power = 0.0;
  };
  std::vector<Output> outputs;
  for_each_instruction_set([&](std::int64_t) {
    Output& out = outputs.emplace_back();
    RandomContacts own = contacts;
    for (int i = 0; i < 3; ++i) {
      const Sweep sweep(own, true);
      out.primal_residual = sweep.primal_residual;
      out.swept = sweep.wrench;
      out.u = sweep.u;
      out.g = sweep.g;
      out.r = sweep.r;
    }
    out.constraints = own.constraints;
    const std::array with{out.r.data(), out.g.data(), out.u.data(), out.r.data(), out.u.data(), out.g.data()};
    dot(out.constraints, out.g, with, out.product);
    out.difference = out.g;
    subtract(std::vector{out.r, out.u}, std::array{0.3, -0.7}, out.difference);
    std::vector<ConstraintVector> last = out.u;
    out.step.resize(kConstraints);
    take_difference(out.g, last, out.step);
    add_impulses(out.constraints, {}, out.added);
    out.power = supported_power(own.constraints, own.velocity, 1.5, {});
  });
  REQUIRE_FALSE(outputs.empty());
  CHECK(outputs.front().primal_residual.largest > 0.0);
  for (const Output& out : outputs) {
    const Output& first = outputs.front();
    CAPTURE(&out - &first);
    CHECK(out.primal_residual.largest == first.primal_residual.largest);
    CHECK(out.primal_residual.squares == first.primal_residual.squares);
    CHECK(same_constraints(out.constraints, first.constraints));
    CHECK(same_bits(out.swept, first.swept));
    CHECK(same_bits(out.added, first.added));
    CHECK(out.product == first.product);
    CHECK(out.power == first.power);
    CHECK(same_bits(out.u, first.u));
    CHECK(same_bits(out.g, first.g));
    CHECK(same_bits(out.r, first.r));
    CHECK(same_bits(out.difference, first.difference));
    CHECK(same_bits(out.step, first.step));
  }
}

TEST_CASE("contact_kernels: an iteration leads from x = y - R z to g = x + r", "[core][contact_kernels]") {
  RandomContacts contacts = random_contacts(41);
  const std::vector<ContactConstraint> before = contacts.constraints;
  const Sweep swept(contacts, false);
  double worst = 0.0;
  for (std::size_t p = 0; p < kConstraints; ++p) {
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const double penalty = before[p].penalty[i > 0][lane];
        const double z = before[p].contact_velocity.row[i][lane];
        const double x = before[p].impulse.row[i][lane] - penalty * z;
        const double r = -penalty * (swept.u[p].row[i][lane] - z);
        worst = std::max({worst, std::abs(swept.r[p].row[i][lane] - r), std::abs(swept.g[p].row[i][lane] - x - r)});
      }
    }
  }
  CAPTURE(worst);
  CHECK(worst < 1e-14);
}

TEST_CASE("contact_kernels: products and differences of impulses are what they are point by point",
          "[core][contact_kernels]") {
  RandomContacts contacts = random_contacts(51);
  const Sweep swept(contacts, false);
  std::vector<ConstraintVector> difference = swept.g, last = swept.u, step(kConstraints);
  subtract(std::vector{swept.r, swept.u}, std::array{0.3, -0.7}, difference);
  take_difference(swept.g, last, step);
  std::array<double, 3> product{};
  double worst = 0.0;
  for (std::size_t p = 0; p < kConstraints; ++p) {
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const double g = swept.g[p].row[i][lane];
        const double r = swept.r[p].row[i][lane];
        const double u = swept.u[p].row[i][lane];
        const double inverse_penalty = contacts.constraints[p].inverse_penalty[i > 0][lane];
        product[0] += g * r * inverse_penalty;
        product[1] += g * u * inverse_penalty;
        product[2] += g * g * inverse_penalty;
        worst = std::max(worst, std::abs(difference[p].row[i][lane] - (g - 0.3 * r + 0.7 * u)));
        worst = std::max(worst, std::abs(step[p].row[i][lane] - (g - u)));
        CHECK(last[p].row[i][lane] == g);
      }
    }
  }
  CAPTURE(product, worst);
  // However many are computed together, each has the same bits.
  const std::array with{swept.r.data(), swept.u.data(), swept.g.data(), swept.r.data(),
                        swept.u.data(), swept.g.data(), swept.r.data()};
  std::array<double, with.size()> together{};
  for (std::size_t many = 1; many <= with.size(); ++many) {
    dot(contacts.constraints, swept.g, std::span(with).first(many), together);
    for (std::size_t k = 0; k < many; ++k) {
      CAPTURE(many, k);
      double alone = 0.0;
      dot(contacts.constraints, swept.g, std::span(with).subspan(k, 1), std::span(&alone, 1));
      CHECK(together[k] == alone);
      CHECK(together[k] == Approx(product[k % 3]).epsilon(1e-12));
    }
  }
  CHECK(worst < 1e-14);
}

TEST_CASE("contact_kernels: the orthogonal projection gives the nearest point of Coulomb's cone",
          "[core][contact_kernels]") {
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    RandomContacts contacts = random_contacts(seed);
    Random random(100 + seed);
    std::vector<ConstraintVector> x(kConstraints);
    const std::vector<ConstraintVector> u(kConstraints);
    std::vector<NormalBounds> most(kConstraints);
    for (std::size_t p = 0; p < kConstraints; ++p) {
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        most[p].lane[lane] = lane % 2 == 0 ? std::numeric_limits<double>::infinity() : random.between(0.0, 1.0);
        for (auto& row : x[p].row) row[lane] = random.between(-2, 2);
      }
    }
    std::vector<LaneWrench> wrench(kBodies + 1);
    project(Projection::orthogonal, contacts.constraints, {}, x, u, most, wrench);
    for (std::size_t p = 0; p < kConstraints; ++p) {
      const double friction = contacts.constraints[p].friction;
      for (std::size_t lane = 0; lane < static_cast<std::size_t>(contacts.constraints[p].count); ++lane) {
        const auto& row = contacts.constraints[p].impulse.row;
        const Vec3 y(row[0][lane], row[1][lane], row[2][lane]);
        // Without friction the tangents are no part of the problem.
        const double tangent = friction > 0.0 ? 1.0 : 0.0;
        const Vec3 from(x[p].row[0][lane], tangent * x[p].row[1][lane], tangent * x[p].row[2][lane]);
        const double slip = std::hypot(y[1], y[2]);
        CHECK(y[0] >= 0.0);
        CHECK(y[0] <= most[p].lane[lane]);
        CHECK(slip <= friction * y[0] + 1e-12);
        // No point of the set is nearer: for every one of them, w, (x − y) · (w − y) ≤ 0.
        for (int k = 0; k < 50; ++k) {
          const double normal = random.between(0.0, std::min(3.0, most[p].lane[lane]));
          const double angle = random.between(0.0, 6.3);
          const double size = friction * normal * random.between(0.0, 1.0);
          const Vec3 w(normal, size * std::cos(angle), size * std::sin(angle));
          CHECK((from - y).dot(w - y) <= 1e-12);
        }
      }
    }
  }
}

}  // namespace contact_kernels_test
