#include "core/native/solver/contact_kernels.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "core/native/solver/each_instruction_set.hpp"
#include "core/native/solver/random_contacts.hpp"
#include "same_bits.hpp"

using namespace holdfast::internal;
using namespace holdfast::internal::native;

namespace {

constexpr double kRelaxation = 1.6;

/// One iteration by the kernels: `aim`, then `project` of where it leads.
struct Sweep {
  Mismatch mismatch;
  std::vector<PatchVector> u = std::vector<PatchVector>(kPatches), g = u, r = u;
  std::vector<LaneWrench> wrench = std::vector<LaneWrench>(kBodies + 1);

  Sweep(Contacts& contacts, bool with_mid_arms, double relaxation = kRelaxation) {
    mismatch = aim(contacts.patches, contacts.velocity, relaxation, u, g, r);
    project(Projection::coulomb, contacts.patches, with_mid_arms ? contacts.mid_arms : std::vector<Arms>(), g, u, {},
            wrench);
  }
};

using Wrench = Eigen::Matrix<double, kBodyRows, 1>;

/// What `aim` and `project` are said to do, point by point.
struct PlainSweep {
  Mismatch mismatch;
  std::vector<Wrench> wrench = std::vector<Wrench>(kBodies + 1, Wrench::Zero());

  explicit PlainSweep(Contacts& contacts, bool with_mid_arms) {
    for (std::size_t p = 0; p < kPatches; ++p) {
      const Patch& patch = contacts.patches[p];
      for (std::size_t lane = 0; lane < static_cast<std::size_t>(patch.count); ++lane)
        take(contacts.patches[p], with_mid_arms ? contacts.mid_arms[p] : patch.arms, lane, contacts.velocity);
    }
  }

  void take(Patch& patch, const Arms& mid, std::size_t lane, const std::vector<BodyVector>& velocity) {
    Mat3 directions;  // Its rows are the normal and the tangents.
    for (std::size_t d = 0; d < 3; ++d)
      for (std::size_t i = 0; i < 3; ++i)
        directions(static_cast<Eigen::Index>(d), static_cast<Eigen::Index>(i)) = patch.directions[d][i];
    const auto speed = [&](std::int32_t body, const std::array<Lanes, 3>& arms) {
      const double* v = velocity[static_cast<std::size_t>(body)].row;
      return Vec3(Vec3(v[0], v[1], v[2]) + Vec3(v[3], v[4], v[5]).cross(arm_of(arms, lane)));
    };
    Vec3 u = directions * (speed(patch.b, patch.arms.b) - speed(patch.a, patch.arms.a));
    u += Vec3(patch.allowance.row[0][lane], patch.allowance.row[1][lane], patch.allowance.row[2][lane]);
    const double tangential = patch.resistance[1][lane];
    const Vec3 resistance(patch.resistance[0][lane], tangential, tangential);
    const Vec3 z(patch.slip.row[0][lane], patch.slip.row[1][lane], patch.slip.row[2][lane]);
    const Vec3 impulse(patch.impulse.row[0][lane], patch.impulse.row[1][lane], patch.impulse.row[2][lane]);
    const Vec3 x = impulse - resistance.cwiseProduct(z + kRelaxation * (u - z));
    Vec3 y = x;
    y.x() = std::max(0.0, x.x());
    const double radius = patch.friction * y.x();
    const double length = std::hypot(x.y(), x.z());
    if (length > radius) y.tail<2>() = x.tail<2>() * (radius / length);
    // Of the iterate before, which the iteration starts from.
    mismatch.largest = std::max(mismatch.largest, (u - z).cwiseAbs().maxCoeff());
    mismatch.squares += (u - z).squaredNorm();
    const Vec3 slip = (y - x).cwiseQuotient(resistance);
    for (std::size_t i = 0; i < 3; ++i) {
      patch.impulse.row[i][lane] = y[static_cast<Eigen::Index>(i)];
      patch.slip.row[i][lane] = slip[static_cast<Eigen::Index>(i)];
    }
    const Vec3 force = directions.transpose() * (y + resistance.cwiseProduct(slip - u));
    add(patch.b, arm_of(mid.b, lane), force);
    add(patch.a, arm_of(mid.a, lane), -force);
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

/// Impulses and slips only: a patch has padding.
bool same_patches(const std::vector<Patch>& a, const std::vector<Patch>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Patch& p, const Patch& q) {
    return same_bits(std::vector{p.impulse}, std::vector{q.impulse}) &&
           same_bits(std::vector{p.slip}, std::vector{q.slip});
  });
}

}  // namespace

TEST_CASE("contact_kernels: a sweep does what its formulas say", "[core][contact_kernels]") {
  for (const bool with_mid_arms : {false, true}) {
    Contacts contacts = random_contacts(11);
    Contacts copy = contacts;
    const Sweep swept(contacts, with_mid_arms);
    const PlainSweep plain(copy, with_mid_arms);
    double worst = 0.0;
    for (std::size_t p = 0; p < kPatches; ++p) {
      for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
          worst = std::max({worst,
                            std::abs(contacts.patches[p].impulse.row[i][lane] - copy.patches[p].impulse.row[i][lane]),
                            std::abs(contacts.patches[p].slip.row[i][lane] - copy.patches[p].slip.row[i][lane])});
        }
      }
    }
    double worst_wrench = 0.0;
    for (std::size_t body = 0; body < kBodies; ++body)
      worst_wrench = std::max(worst_wrench, (total(swept.wrench[body]) - plain.wrench[body]).cwiseAbs().maxCoeff());
    CAPTURE(with_mid_arms, worst, worst_wrench);
    CHECK(worst < 1e-13);
    CHECK(worst_wrench < 1e-12);
    CHECK(swept.mismatch.largest == Approx(plain.mismatch.largest).epsilon(1e-13));
    CHECK(swept.mismatch.squares == Approx(plain.mismatch.squares).epsilon(1e-13));
  }
}

TEST_CASE("contact_kernels: a sweep leaves every impulse in its cone, and unused lanes at nothing",
          "[core][contact_kernels]") {
  Contacts contacts = random_contacts(12);
  const Sweep swept(contacts, false);
  int sticking = 0, sliding = 0, open = 0;
  for (const Patch& patch : contacts.patches) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const double normal = patch.impulse.row[0][lane];
      const double tangential = std::hypot(patch.impulse.row[1][lane], patch.impulse.row[2][lane]);
      CAPTURE(lane, patch.count, patch.friction, normal, tangential);
      if (lane >= static_cast<std::size_t>(patch.count)) {
        for (std::size_t i = 0; i < 3; ++i) {
          CHECK(patch.impulse.row[i][lane] == 0.0);
          CHECK(patch.slip.row[i][lane] == 0.0);
        }
        continue;
      }
      CHECK(normal >= 0.0);
      CHECK(tangential <= patch.friction * normal * (1 + 4e-16));
      const double slip = std::hypot(patch.slip.row[1][lane], patch.slip.row[2][lane]);
      (normal == 0.0 ? open : slip < 1e-12 ? sticking : sliding) += 1;
      // Friction acts against the slip, the normal impulse only where nothing parts.
      CHECK(patch.impulse.row[1][lane] * patch.slip.row[1][lane] +
                patch.impulse.row[2][lane] * patch.slip.row[2][lane] ==
            Approx(-slip * tangential).margin(1e-12));
      CHECK(std::abs(normal * patch.slip.row[0][lane]) < 1e-12);
    }
  }
  CAPTURE(sticking, sliding, open);
  CHECK(std::min({sticking, sliding, open}) > 5);
}

TEST_CASE("contact_kernels: impulses add up to what they do to the bodies", "[core][contact_kernels]") {
  Contacts contacts = random_contacts(13);
  std::vector<LaneWrench> wrench(kBodies + 1);
  add_impulses(contacts.patches, contacts.mid_arms, wrench);
  std::vector<Wrench> expected(kBodies + 1, Wrench::Zero());
  for (std::size_t p = 0; p < kPatches; ++p) {
    const Patch& patch = contacts.patches[p];
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      Vec3 force = Vec3::Zero();
      for (std::size_t d = 0; d < 3; ++d)
        force +=
            patch.impulse.row[d][lane] * Vec3(patch.directions[d][0], patch.directions[d][1], patch.directions[d][2]);
      const auto on = [&](std::int32_t body) -> Wrench& { return expected[static_cast<std::size_t>(body)]; };
      on(patch.b).head<3>() += force;
      on(patch.b).tail<3>() += arm_of(contacts.mid_arms[p].b, lane).cross(force);
      on(patch.a).head<3>() -= force;
      on(patch.a).tail<3>() -= arm_of(contacts.mid_arms[p].a, lane).cross(force);
    }
  }
  double worst = 0.0;
  for (std::size_t body = 0; body <= kBodies; ++body)
    worst = std::max(worst, (total(wrench[body]) - expected[body]).cwiseAbs().maxCoeff());
  CAPTURE(worst);
  CHECK(worst < 1e-13);
}

TEST_CASE("contact_kernels: every instruction set computes the same bits", "[core][contact_kernels]") {
  const Contacts contacts = random_contacts(31);
  struct Output {
    std::vector<Patch> patches;
    std::vector<LaneWrench> swept, added = std::vector<LaneWrench>(kBodies + 1);
    std::vector<PatchVector> u, g, r, difference, step;
    Mismatch mismatch;
    double product = 0.0;
  };
  std::vector<Output> outputs;
  for_each_instruction_set([&](std::int64_t) {
    Output& out = outputs.emplace_back();
    Contacts own = contacts;
    for (int i = 0; i < 3; ++i) {
      const Sweep sweep(own, true);
      out.mismatch = sweep.mismatch;
      out.swept = sweep.wrench;
      out.u = sweep.u;
      out.g = sweep.g;
      out.r = sweep.r;
    }
    out.patches = own.patches;
    out.product = dot(out.patches, out.g, out.r);
    out.difference = out.g;
    subtract(std::vector{out.r, out.u}, std::array{0.3, -0.7}, out.difference);
    std::vector<PatchVector> last = out.u;
    out.step.resize(kPatches);
    take_difference(out.g, last, out.step);
    add_impulses(out.patches, {}, out.added);
  });
  REQUIRE_FALSE(outputs.empty());
  CHECK(outputs.front().mismatch.largest > 0.0);
  for (const Output& out : outputs) {
    const Output& first = outputs.front();
    CAPTURE(&out - &first);
    CHECK(out.mismatch.largest == first.mismatch.largest);
    CHECK(out.mismatch.squares == first.mismatch.squares);
    CHECK(same_patches(out.patches, first.patches));
    CHECK(same_bits(out.swept, first.swept));
    CHECK(same_bits(out.added, first.added));
    CHECK(out.product == first.product);
    CHECK(same_bits(out.u, first.u));
    CHECK(same_bits(out.g, first.g));
    CHECK(same_bits(out.r, first.r));
    CHECK(same_bits(out.difference, first.difference));
    CHECK(same_bits(out.step, first.step));
  }
}

TEST_CASE("contact_kernels: an iteration leads from x = y - R z to g = x + r", "[core][contact_kernels]") {
  Contacts contacts = random_contacts(41);
  const std::vector<Patch> before = contacts.patches;
  const Sweep swept(contacts, false);
  double worst = 0.0;
  for (std::size_t p = 0; p < kPatches; ++p) {
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const double resistance = before[p].resistance[i > 0][lane];
        const double z = before[p].slip.row[i][lane];
        const double x = before[p].impulse.row[i][lane] - resistance * z;
        const double r = -kRelaxation * resistance * (swept.u[p].row[i][lane] - z);
        worst = std::max({worst, std::abs(swept.r[p].row[i][lane] - r), std::abs(swept.g[p].row[i][lane] - x - r)});
      }
    }
  }
  CAPTURE(worst);
  CHECK(worst < 1e-14);
}

TEST_CASE("contact_kernels: products and differences of impulses are what they are point by point",
          "[core][contact_kernels]") {
  Contacts contacts = random_contacts(51);
  const Sweep swept(contacts, false);
  std::vector<PatchVector> difference = swept.g, last = swept.u, step(kPatches);
  subtract(std::vector{swept.r, swept.u}, std::array{0.3, -0.7}, difference);
  take_difference(swept.g, last, step);
  double product = 0.0, worst = 0.0;
  for (std::size_t p = 0; p < kPatches; ++p) {
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const double g = swept.g[p].row[i][lane];
        const double r = swept.r[p].row[i][lane];
        const double u = swept.u[p].row[i][lane];
        product += g * r * contacts.patches[p].compliance[i > 0][lane];
        worst = std::max(worst, std::abs(difference[p].row[i][lane] - (g - 0.3 * r + 0.7 * u)));
        worst = std::max(worst, std::abs(step[p].row[i][lane] - (g - u)));
        CHECK(last[p].row[i][lane] == g);
      }
    }
  }
  CAPTURE(product, worst);
  CHECK(dot(contacts.patches, swept.g, swept.r) == Approx(product).epsilon(1e-12));
  CHECK(worst < 1e-14);
}

TEST_CASE("contact_kernels: the orthogonal projection gives the nearest point of Coulomb's cone",
          "[core][contact_kernels]") {
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    Contacts contacts = random_contacts(seed);
    Random random(100 + seed);
    std::vector<PatchVector> x(kPatches);
    const std::vector<PatchVector> u(kPatches);
    std::vector<NormalBounds> most(kPatches);
    for (std::size_t p = 0; p < kPatches; ++p) {
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        most[p].lane[lane] = lane % 2 == 0 ? std::numeric_limits<double>::infinity() : random.between(0.0, 1.0);
        for (auto& row : x[p].row) row[lane] = random.between(-2, 2);
      }
    }
    std::vector<LaneWrench> wrench(kBodies + 1);
    project(Projection::orthogonal, contacts.patches, {}, x, u, most, wrench);
    for (std::size_t p = 0; p < kPatches; ++p) {
      const double friction = contacts.patches[p].friction;
      for (std::size_t lane = 0; lane < static_cast<std::size_t>(contacts.patches[p].count); ++lane) {
        const auto& row = contacts.patches[p].impulse.row;
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
