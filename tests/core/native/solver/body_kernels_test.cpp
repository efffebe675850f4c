#include "core/native/solver/body_kernels.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "core/native/solver/each_instruction_set.hpp"
#include "random.hpp"
#include "same_bits.hpp"

namespace body_kernels_test {

using namespace holdfast::internal;
using namespace holdfast::internal::native;

namespace {

/// Bodies with random velocities and wrenches.
struct Moved {
  std::vector<ProblemBody> bodies;
  std::vector<BodyVector> free_velocity, velocity;
  std::vector<LaneWrench> wrench;

  Moved(std::uint32_t seed, std::size_t count) : free_velocity(count), velocity(count + 1), wrench(count + 1) {
    Random random(seed);
    for (std::size_t i = 0; i < count; ++i) {
      const Mat3 axes = random.rotation().toRotationMatrix();
      const Vec3 moments(random.between(1, 2), random.between(1, 2), random.between(1, 2));
      bodies.push_back({random.between(1, 5), Mat3(axes * moments.asDiagonal() * axes.transpose()), 0.5});
      for (int k = 0; k < kBodyRows; ++k) {
        free_velocity[i].row[padded_row(k)] = random.between(-1, 1);
        velocity[i].row[padded_row(k)] = random.between(-1, 1);
        for (double& lane : wrench[i].row[k]) lane = random.between(-1, 1);
      }
    }
  }
  std::vector<BodyVector> residual(bool at_rest) const {
    std::vector<BodyVector> out(bodies.size());
    momentum_residual(bodies, free_velocity, at_rest ? nullptr : velocity.data(), wrench, out);
    return out;
  }
};

Vec3 totals(const LaneWrench& wrench, int first) {
  const auto total = [&](int row) {
    const double* lane = wrench.row[row];
    return lane[0] + lane[1] + lane[2] + lane[3];
  };
  return {total(first), total(first + 1), total(first + 2)};
}

}  // namespace

TEST_CASE("body_kernels: the residual is what the momentum equation leaves", "[core][body_kernels]") {
  const Moved moved(3, 5);
  for (const bool at_rest : {false, true}) {
    const std::vector<BodyVector> left = moved.residual(at_rest);
    for (std::size_t i = 0; i < left.size(); ++i) {
      const BodyVector v = at_rest ? BodyVector{} : moved.velocity[i];
      const BodyVector& free = moved.free_velocity[i];
      const Vec3 force = moved.bodies[i].mass * (linear(free) - linear(v)) + totals(moved.wrench[i], 0);
      const Vec3 torque = moved.bodies[i].inertia * (angular(free) - angular(v)) + totals(moved.wrench[i], 3);
      CHECK((linear(left[i]) - force).norm() < 1e-14);
      CHECK((angular(left[i]) - torque).norm() < 1e-14);
      CHECK((left[i].row[3] == 0.0 && left[i].row[7] == 0.0));
    }
  }
}

TEST_CASE("body_kernels: changes are added, and the largest is found, for any number of bodies",
          "[core][body_kernels]") {
  for (std::size_t count = 1; count <= 9; ++count) {
    const Moved moved(5, count);
    std::vector<BodyVector> after = moved.velocity;
    const double largest = add_velocity_changes(moved.bodies, moved.free_velocity, after);
    double expected = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      const BodyVector& change = moved.free_velocity[i];
      CHECK(linear(after[i]) == linear(moved.velocity[i]) + linear(change));
      CHECK(angular(after[i]) == angular(moved.velocity[i]) + angular(change));
      expected = std::max(expected, linear(change).norm() + moved.bodies[i].radius * angular(change).norm());
    }
    CHECK(largest == Approx(expected).epsilon(1e-14));
  }
}

TEST_CASE("body_kernels: a change that is not a number is never lost", "[core][body_kernels]") {
  for (std::size_t body = 0; body < 6; ++body) {
    Moved moved(1, 6);
    moved.free_velocity[body].row[kAngularRow] = std::numeric_limits<double>::quiet_NaN();
    CHECK(std::isnan(add_velocity_changes(moved.bodies, moved.free_velocity, moved.velocity)));
  }
}

TEST_CASE("body_kernels: every instruction set computes the same bits", "[core][body_kernels]") {
  std::vector<std::vector<double>> results;
  for_each_instruction_set([&](std::int64_t) {
    Moved moved(7, 6);
    std::vector<double> all{add_velocity_changes(moved.bodies, moved.free_velocity, moved.velocity)};
    for (const std::vector<BodyVector>& vectors : {moved.residual(false), moved.residual(true), moved.velocity})
      for (const BodyVector& vector : vectors) all.insert(all.end(), std::begin(vector.row), std::end(vector.row));
    results.push_back(std::move(all));
  });
  for (const std::vector<double>& result : results) CHECK(same_bits(result, results.front()));
}

}  // namespace body_kernels_test
