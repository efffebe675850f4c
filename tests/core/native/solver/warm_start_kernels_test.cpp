#include "core/native/solver/warm_start_kernels.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "core/native/constants.hpp"
#include "core/native/solver/each_instruction_set.hpp"
#include "core/native/solver/random_contacts.hpp"
#include "same_bits.hpp"

namespace warm_start_kernels_test {

using namespace holdfast::internal;
using namespace holdfast::internal::native;

namespace {

constexpr StepScale kScale{.step = 0.02, .velocity_unit = 0.2, .lasting_slip = 0.4};

/// Constraints as `start_step` takes them, of bodies half of which turn.
struct Started {
  std::vector<ContactConstraint> constraints;
  std::vector<ContactStart> start = std::vector<ContactStart>(kConstraints);
  std::vector<BodyMotion> motion = std::vector<BodyMotion>(kBodies + 1);
  std::vector<Arms> mid_arms = std::vector<Arms>(kConstraints);
  std::vector<std::uint8_t> late = std::vector<std::uint8_t>(kBodies + 1, 0);
  bool any_late = false;

  explicit Started(std::uint32_t seed, double speed) : constraints(random_contacts(seed).constraints) {
    Random random(seed);
    const auto rotation = [&] {
      const Mat3 axes = random.rotation().toRotationMatrix();
      std::array<std::array<double, 3>, 3> rows{};
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
          rows.at(i).at(j) = axes(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      return rows;
    };
    for (std::size_t i = 0; i < kBodies; ++i) {
      for (double& v : motion[i].velocity) v = random.between(-speed, speed);
      for (double& w : motion[i].angular_velocity) w = random.between(-speed, speed);
      motion[i].turns = i % 2 == 0;
      if (!motion[i].turns) continue;
      motion[i].turn_mid = rotation();
      motion[i].turn_end = rotation();
    }
    for (std::size_t p = 0; p < kConstraints; ++p) {
      ContactConstraint& constraint = constraints[p];
      start[p] = {.force = constraint.impulse, .contact_velocity = constraint.contact_velocity};
      for (std::size_t lane = 0; lane < static_cast<std::size_t>(constraint.count); ++lane)
        start[p].gap[lane] = random.between(-1e-3, 1e-3);
    }
  }
  Started started() const {
    Started after = *this;
    after.any_late = start_step(kScale, start, motion, after.constraints, after.mid_arms, after.late);
    return after;
  }
};

Vec3 vector_of(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }
Vec3 direction_of(const ContactConstraint& constraint, std::size_t d) {
  return {constraint.directions[d][0], constraint.directions[d][1], constraint.directions[d][2]};
}
Vec3 turned(const std::array<std::array<double, 3>, 3>& turn, const Vec3& v) {
  return {vector_of(turn[0]).dot(v), vector_of(turn[1]).dot(v), vector_of(turn[2]).dot(v)};
}

/// The largest difference of a constraint's lane from what is expected of it.
double difference(const Started& before, const Started& after, std::size_t p, std::size_t lane, bool& late) {
  const ContactConstraint& from = before.constraints[p];
  const ContactConstraint& to = after.constraints[p];
  const BodyMotion& a = before.motion[static_cast<std::size_t>(from.a)];
  const BodyMotion& b = before.motion[static_cast<std::size_t>(from.b)];
  const Vec3 arm_a = arm_of(from.arms.a, lane);
  const Vec3 arm_b = arm_of(from.arms.b, lane);
  const Vec3 velocity = vector_of(b.velocity) + vector_of(b.angular_velocity).cross(arm_b) - vector_of(a.velocity) -
                        vector_of(a.angular_velocity).cross(arm_a);
  const Vec3 normal = direction_of(from, 0);
  const Vec3 slip = velocity - normal * normal.dot(velocity);
  const double gap = before.start[p].gap[lane];
  late = late ||
         std::max(0.0, gap) + kScale.step * normal.dot(velocity) < -kNoticeable * kScale.velocity_unit * kScale.step;
  double worst = 0.0;
  for (std::size_t d = 0; d < 3; ++d) {
    const Vec3 direction = direction_of(from, d);
    const bool lasts = slip.norm() > kScale.lasting_slip;
    const double bias = d == 0 ? std::max(0.0, gap) / kScale.step : lasts ? slip.dot(direction) : 0.0;
    const double force = arm_of(before.start[p].force.row, lane).dot(direction);
    const double z = arm_of(before.start[p].contact_velocity.row, lane).dot(direction) + (d > 0 ? bias : 0.0);
    const double impulse = kScale.step * (d == 0 ? std::max(0.0, force) : force);
    worst = std::max({worst, std::abs(to.velocity_bias.row[d][lane] - bias),
                      std::abs(to.impulse.row[d][lane] - impulse), std::abs(to.contact_velocity.row[d][lane] - z)});
    if (d == 0) worst = std::max(worst, std::abs(to.expected_impulse[lane] - kScale.step * force));
  }
  const auto check_turn = [&](const BodyMotion& body, const Vec3& arm, const std::array<Lanes, 3>& middle,
                              const std::array<Lanes, 3>& end) {
    worst = std::max(worst, (arm_of(middle, lane) - (body.turns ? turned(body.turn_mid, arm) : arm)).norm());
    worst = std::max(worst, (arm_of(end, lane) - (body.turns ? turned(body.turn_end, arm) : arm)).norm());
  };
  check_turn(a, arm_a, after.mid_arms[p].a, to.arms.a);
  check_turn(b, arm_b, after.mid_arms[p].b, to.arms.b);
  return worst;
}

}  // namespace

TEST_CASE("warm_start_kernels: a step starts with the impulses, biases and arms of its equations",
          "[core][warm_start_kernels]") {
  // Slow bodies slide for a part of the step; fast ones slide through it, and their impacts are late.
  for (const double speed : {0.002, 2.0}) {
    const Started before(3, speed);
    const Started after = before.started();
    bool any_late = false;
    for (std::size_t p = 0; p < kConstraints; ++p) {
      bool late = false;
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        if (lane < static_cast<std::size_t>(before.constraints[p].count)) {
          CHECK(difference(before, after, p, lane, late) < 1e-14);
          continue;
        }
        for (std::size_t d = 0; d < 3; ++d) {
          CHECK(after.constraints[p].impulse.row[d][lane] == 0.0);
          CHECK(after.constraints[p].velocity_bias.row[d][lane] == 0.0);
        }
      }
      if (late) {
        CHECK(after.late[static_cast<std::size_t>(before.constraints[p].a)] == 1);
        CHECK(after.late[static_cast<std::size_t>(before.constraints[p].b)] == 1);
      }
      any_late = any_late || late;
    }
    CHECK(after.any_late == any_late);
    CHECK(any_late == (speed > 1.0));
  }
}

TEST_CASE("warm_start_kernels: without turning bodies the arms stay", "[core][warm_start_kernels]") {
  Started start(5, 0.02);
  const std::vector<ContactConstraint> before = start.constraints;
  start_step(kScale, start.start, start.motion, start.constraints, {}, start.late);
  for (std::size_t p = 0; p < kConstraints; ++p) {
    CHECK(start.constraints[p].arms.a == before[p].arms.a);
    CHECK(start.constraints[p].arms.b == before[p].arms.b);
  }
}

TEST_CASE("warm_start_kernels: what is kept of a solution is what the next solve starts from",
          "[core][warm_start_kernels]") {
  std::vector<ContactConstraint> constraints = random_contacts(7).constraints;
  std::vector<ContactStart> next(kConstraints);
  to_container_frame(kScale.step, constraints, next);
  const std::vector<ContactConstraint> solved = constraints;
  for (ContactConstraint& constraint : constraints) constraint.impulse = constraint.contact_velocity = {};
  start_from_last(kScale.step, next, constraints);
  for (std::size_t p = 0; p < kConstraints; ++p) {
    for (std::size_t d = 0; d < 3; ++d) {
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        CHECK(constraints[p].impulse.row[d][lane] == Approx(solved[p].impulse.row[d][lane]).margin(1e-14));
        CHECK(constraints[p].contact_velocity.row[d][lane] ==
              Approx(solved[p].contact_velocity.row[d][lane]).margin(1e-14));
      }
    }
  }
}

TEST_CASE("warm_start_kernels: every instruction set computes the same bits", "[core][warm_start_kernels]") {
  std::vector<std::vector<double>> results;
  for_each_instruction_set([&](std::int64_t) {
    const Started after = Started(11, 2.0).started();
    std::vector<ContactStart> next(kConstraints);
    to_container_frame(kScale.step, after.constraints, next);
    std::vector<double> all;
    const auto add = [&](const std::array<Lanes, 3>& rows) {
      for (const Lanes& row : rows) all.insert(all.end(), row.begin(), row.end());
    };
    for (std::size_t p = 0; p < kConstraints; ++p) {
      const ContactConstraint& constraint = after.constraints[p];
      add(constraint.impulse.row);
      add(constraint.contact_velocity.row);
      add(constraint.velocity_bias.row);
      add(next[p].force.row);
      add(next[p].contact_velocity.row);
      for (const Arms* arms : {&constraint.arms, &after.mid_arms[p]}) {
        add(arms->a);
        add(arms->b);
      }
    }
    results.push_back(all);
  });
  for (const std::vector<double>& result : results) CHECK(same_bits(result, results.front()));
}

}  // namespace warm_start_kernels_test
