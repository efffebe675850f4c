#include "core/native/solver/equilibrium.hpp"

#include <catch2/catch.hpp>
#include <limits>

#include "core/native/solver/contact_problem.hpp"

namespace equilibrium_test {

using namespace holdfast::internal;
using namespace holdfast::internal::native;

namespace {

constexpr double kMass = 2.0;    // kg
constexpr double kRadius = 0.5;  // m
const Vec3 kInertia(3.0, 5.0, 7.0);

/// A body that nothing touches, with this velocity at the end of the step.
ContactProblem free_body(const BodyVector& velocity) {
  ContactProblem problem;
  problem.bodies.push_back({kMass, Mat3(kInertia.asDiagonal()), kRadius});
  problem.free_velocity.push_back(velocity);
  problem.velocity.resize(2);
  return problem;
}

}  // namespace

TEST_CASE("equilibrium: a force or a torque along any axis is a residual", "[core][equilibrium]") {
  constexpr double kUnit = 0.1;  // m/s
  EquilibriumCheck check;
  CHECK(check.residual(free_body({}), kUnit) == 0.0);
  for (int axis = 0; axis < 3; ++axis) {
    CAPTURE(axis);
    Vec3 velocity = Vec3::Zero();
    velocity[axis] = 0.3;  // m/s or rad/s
    const double shift = check.residual(free_body(body_vector(velocity, Vec3::Zero())), kUnit);
    const double turn = check.residual(free_body(body_vector(Vec3::Zero(), velocity)), kUnit);
    CHECK(shift == Approx(0.3 / kUnit));
    CHECK(turn == Approx(kInertia[axis] * 0.3 / (kRadius * kMass * kUnit)));
  }
}

TEST_CASE("equilibrium: what is not a number is no balance", "[core][equilibrium]") {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (int row = 0; row < 3; ++row) {
    BodyVector velocity;
    velocity.row[row] = kNan;
    CHECK(EquilibriumCheck().residual(free_body(velocity), 0.1) == std::numeric_limits<double>::infinity());
    velocity = {};
    velocity.row[kAngularRow + row] = kNan;
    CHECK(EquilibriumCheck().residual(free_body(velocity), 0.1) == std::numeric_limits<double>::infinity());
  }
}

}  // namespace equilibrium_test
