#include "core/native/solver/interior_point_kernels.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "core/native/collision/oriented_box.hpp"
#include "random.hpp"

namespace interior_point_kernels_test {

using namespace holdfast::internal;
using namespace holdfast::internal::native;

namespace {

constexpr std::size_t kSamples = 200;

/// Inside the Lorentz cone, nearer to its boundary than `share` of its size.
Vec3 inside(Random& random, double share) {
  const double size = std::pow(10.0, random.between(-2, 2));
  const double direction = random.between(0, 6.3);
  const double tangential = size * random.between(1.0 - share, 1.0);
  return {tangential + size * share * random.between(0.1, 1.0), tangential * std::cos(direction),
          tangential * std::sin(direction)};
}

void set_lane(ConstraintVector& vector, std::size_t lane, const Vec3& value) {
  for (std::size_t d = 0; d < 3; ++d) vector.row[d][lane] = value[static_cast<Eigen::Index>(d)];
}

Vec3 at_lane(const ConstraintVector& vector, std::size_t lane) {
  return {vector.row[0][lane], vector.row[1][lane], vector.row[2][lane]};
}

Vec3 multiply(const ConstraintMatrix& matrix, std::size_t lane, const Vec3& x) {
  Vec3 product = Vec3::Zero();
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      product[static_cast<Eigen::Index>(i)] += matrix.entry[i][j][lane] * x[static_cast<Eigen::Index>(j)];
  return product;
}

/// Constraints of every kind of point: lane 0 is bounded, 1 and 2 are not, 3 takes no part.
std::vector<InteriorPoints> random_points(double share) {
  Random random(1);
  std::vector<InteriorPoints> points(kSamples);
  for (InteriorPoints& own : points) {
    own.friction = random.between(0.1, 1.0);
    own.inverse_friction = 1.0 / own.friction;
    for (std::size_t lane = 0; lane < 3; ++lane) {
      own.takes_part[lane] = own.has_friction[lane] = 1.0;
      set_lane(own.y, lane, inside(random, share));
      set_lane(own.s, lane, inside(random, share));
    }
    own.is_bounded[0] = 1.0;
    own.p[0] = std::pow(10.0, random.between(-4, 1));
    own.l[0] = std::pow(10.0, random.between(-4, 1));
    own.bound[0] = own.p[0] + own.inverse_friction * own.y.row[0][0];
  }
  return points;
}

}  // namespace

TEST_CASE("interior_point_kernels: the resistance takes velocities to impulses", "[core][interior_point_kernels]") {
  // W² y = s, so R = (W² + λ/p n nᵀ)⁻¹ takes s + n λ y_n / p to y, here in the constraint's coordinates.
  for (const double share : {1.0, 1e-2, 1e-4}) {
    std::vector<InteriorPoints> points = random_points(share);
    std::vector<ConstraintMatrix> resistance(points.size());
    std::vector<ContactConstraint> constraints(points.size());
    scale(points, resistance);
    write_back(points, constraints);
    double worst = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (std::size_t lane = 0; lane < 3; ++lane) {
        const Vec3 impulse = at_lane(constraints[i].impulse, lane);
        Vec3 velocity = at_lane(constraints[i].contact_velocity, lane);
        velocity[0] += points[i].l[lane] / points[i].p[lane] * impulse[0];
        const double error = (multiply(resistance[i], lane, velocity) - impulse).norm() / impulse.norm();
        if (!(error <= worst)) worst = error;
      }
    }
    CAPTURE(share, worst);
    CHECK(worst < 1e-13 / share);
  }
}

TEST_CASE("interior_point_kernels: the complementarity is the sum over all pairs", "[core][interior_point_kernels]") {
  std::vector<InteriorPoints> points = random_points(1.0);
  std::vector<ConstraintMatrix> resistance(points.size());
  double sum = 0.0;
  for (const InteriorPoints& own : points) {
    for (std::size_t lane = 0; lane < 3; ++lane) sum += at_lane(own.y, lane).dot(at_lane(own.s, lane));
    sum += own.p[0] * own.l[0];
  }
  CHECK(scale(points, resistance) == Approx(sum).epsilon(1e-13));
}

TEST_CASE("interior_point_kernels: a point that takes no part has no impulse and ends no step",
          "[core][interior_point_kernels]") {
  std::vector<InteriorPoints> points(1);
  std::vector<ConstraintMatrix> resistance(1);
  std::vector<ContactConstraint> constraints(1);
  std::vector<ConstraintVector> u(1), du(1);
  for (Lanes& row : u[0].row) row.fill(-3.0);
  for (Lanes& row : du[0].row) row.fill(7.0);
  CHECK(scale(points, resistance) == 0.0);
  for (const InteriorTarget target : {InteriorTarget{0.0, false}, InteriorTarget{0.1, true}}) {
    find_drive(target, points, resistance, u, constraints);
    CHECK(std::isinf(find_changes(target, points, resistance, u, du)));
    take_step(1.0, points);
    write_back(points, constraints);
    for (std::size_t d = 0; d < 3; ++d) {
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        CHECK(constraints[0].impulse.row[d][lane] == 0.0);
        CHECK(constraints[0].contact_velocity.row[d][lane] == 0.0);
        CHECK(points[0].y.row[d][lane] == (d == 0 ? 1.0 : 0.0));
        CHECK(points[0].s.row[d][lane] == (d == 0 ? 1.0 : 0.0));
      }
    }
  }
}

TEST_CASE("interior_point_kernels: the longest step is that of the first cone or bound that is met",
          "[core][interior_point_kernels]") {
  // Without resistance y stays as it is, and s = (2, 0, 0) goes where u and J Δv send it.
  std::vector<InteriorPoints> points(2);
  std::vector<ConstraintMatrix> resistance(2);
  std::vector<ContactConstraint> constraints(2);
  std::vector<ConstraintVector> u(2), du(2);
  for (std::size_t i = 0; i < 2; ++i) {
    points[i].takes_part.fill(1.0);
    points[i].has_friction.fill(1.0);
    points[i].s.row[0].fill(2.0);
    u[i].row[0].fill(2.0);
  }
  scale(points, resistance);
  std::fill(resistance.begin(), resistance.end(), ConstraintMatrix{});
  const auto longest = [&] {
    find_drive({}, points, resistance, u, constraints);
    return find_changes({}, points, resistance, u, du);
  };
  CHECK(std::isinf(longest()));
  du[0].row[1][2] = 0.5;
  CHECK(longest() == Approx(4.0));
  du[1].row[0][3] = -1.0;
  CHECK(longest() == Approx(2.0));
  du[0].row[2][0] = std::nan("");
  CHECK(std::isnan(longest()));
}

}  // namespace interior_point_kernels_test
