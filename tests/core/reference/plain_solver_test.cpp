#include "core/reference/plain_solver.hpp"

#include <catch2/catch.hpp>

namespace plain_solver_test {

using namespace holdfast::internal;
using namespace holdfast::internal::plain;

namespace {

constexpr double kTolerance = 1e-13;  ///< m/s
constexpr std::uint64_t kMostSweeps = 5000;

/// A point mass, which does not rotate.
Mover mass(double kilograms, const Vec3& velocity) { return {.inverse_mass = 1.0 / kilograms, .velocity = velocity}; }

/// A contact with the ground, body 1, at a point below body 0.
PointLaw on_ground(double friction) { return {.a = 1, .b = 0, .normal = Vec3::UnitZ(), .friction = friction}; }

}  // namespace

TEST_CASE("plain_solver: a falling mass is stopped, a rising one is not changed", "[core][plain_solver]") {
  std::vector<Mover> falling = {mass(2, {0, 0, -3}), Mover{}};
  const Solution held = solve(falling, {on_ground(0)}, kTolerance, kMostSweeps);
  CHECK(falling[0].velocity.norm() < 1e-14);
  CHECK((held.impulses[0] - Vec3(0, 0, 6)).norm() < 1e-14);
  std::vector<Mover> rising = {mass(2, {0, 0, 3}), Mover{}};
  CHECK(solve(rising, {on_ground(0.5)}, kTolerance, kMostSweeps).impulses[0].isZero(0.0));
  CHECK(rising[0].velocity == Vec3(0, 0, 3));
}

TEST_CASE("plain_solver: friction stops slow sliding and slows fast sliding", "[core][plain_solver]") {
  std::vector<Mover> slow = {mass(2, {0.9, -1.2, -3.1}), Mover{}};
  solve(slow, {on_ground(0.5)}, kTolerance, kMostSweeps);
  CHECK(slow[0].velocity.norm() < 1e-12);
  std::vector<Mover> fast = {mass(2, {3, -4, -3}), Mover{}};
  const Solution solution = solve(fast, {on_ground(0.5)}, kTolerance, kMostSweeps);
  // 1.5 of 5 m/s is lost.
  CHECK((fast[0].velocity - Vec3(3, -4, 0) * 0.7).norm() < 1e-12);
  CHECK((solution.impulses[0] - Vec3(-1.8, 2.4, 6)).norm() < 1e-12);
}

TEST_CASE("plain_solver: a collision of two masses conserves momentum", "[core][plain_solver]") {
  std::vector<Mover> movers = {mass(1, {3, 0, 0}), mass(2, {-1, 0, 0})};
  solve(movers, {{.a = 0, .b = 1, .normal = Vec3::UnitX()}}, kTolerance, kMostSweeps);
  CHECK(movers[0].velocity.x() == Approx(1.0 / 3));
  CHECK(movers[1].velocity.x() == Approx(1.0 / 3));
}

TEST_CASE("plain_solver: an impulse off the centre of mass rotates a body", "[core][plain_solver]") {
  // A rod of 12 kg and 1 m that falls on one end: u = v + ω r with v' = v + y/m, ω' = r y/I gives y = m v / (1 + m
  // r²/I).
  Mover rod{.inverse_mass = 1.0 / 12, .inverse_inertia = Eigen::Matrix3d::Identity(), .velocity = {0, 0, -1}};
  std::vector<Mover> movers = {rod, Mover{}};
  const PointLaw law{.a = 1, .b = 0, .arm_b = {0.5, 0, 0}, .normal = Vec3::UnitZ()};
  const Solution solution = solve(movers, {law}, kTolerance, kMostSweeps);
  CHECK(solution.impulses[0].z() == Approx(12.0 / 4));
  CHECK(movers[0].velocity.z() == Approx(-0.75));
  CHECK(movers[0].angular_velocity.y() == Approx(-1.5));
  CHECK(relative_velocity(movers, law).norm() < 1e-12);
}

TEST_CASE("plain_solver: no contacts take no sweep, and too few sweeps are reported", "[core][plain_solver]") {
  std::vector<Mover> movers = {mass(1, {0, 0, -1}), mass(1, {0, 0, -1}), Mover{}};
  CHECK(solve(movers, {}, kTolerance, kMostSweeps).sweeps == 0);
  const PointLaw lower{.a = 2, .b = 0, .normal = Vec3::UnitZ()};
  const PointLaw upper{.a = 0, .b = 1, .normal = Vec3::UnitZ()};
  const Solution hasty = solve(movers, {lower, upper}, kTolerance, 2);
  CHECK(hasty.sweeps == 2);
  CHECK(hasty.residual > 0.1);
}

}  // namespace plain_solver_test
