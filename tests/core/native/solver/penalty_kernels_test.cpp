#include "core/native/solver/penalty_kernels.hpp"

#include <catch2/catch.hpp>
#include <vector>

#include "core/native/solver/each_instruction_set.hpp"
#include "random.hpp"

namespace penalty_kernels_test {

using namespace holdfast::internal;
using namespace holdfast::internal::native;

namespace {

constexpr double kMass = 2.0;      // effective mass of the constraints, kg
constexpr double kFriction = 0.5;  // and their coefficient
constexpr PenaltyFit kFit{.sticking = 10.0, .sliding = 3.0, .idle = 0.1, .heaviest = 1e3, .impulse_per_mass = 0.5};

/// A constraint with one point that has this impulse, along the normal and a tangent, kg m/s.
ContactConstraint with_impulse(double normal, double tangential = 0.0) {
  ContactConstraint constraint;
  constraint.count = 1;
  constraint.friction = kFriction;
  constraint.effective_mass = kMass;
  constraint.impulse.row[0][0] = normal;
  constraint.impulse.row[2][0] = tangential;
  return constraint;
}

ContactConstraint fitted(ContactConstraint constraint, const PenaltyFit& fit = kFit) {
  std::vector<ContactConstraint> constraints(1, constraint);
  fit_penalty(fit, constraints);
  return constraints[0];
}

/// The mass that a point carries by its R along the normal, over the effective mass.
double carried(double mass) {
  return fitted(with_impulse(mass * kFit.impulse_per_mass)).penalty[0][0] / (kFit.sticking * kMass);
}

}  // namespace

TEST_CASE("penalty_kernels: the carried mass is rounded up to a power of 4 of the effective mass",
          "[core][penalty_kernels]") {
  CHECK(carried(0.01 * kMass) == 1.0);
  CHECK(carried(kMass) == 1.0);
  CHECK(carried(1.001 * kMass) == 4.0);
  CHECK(carried(2.0 * kMass) == 4.0);
  CHECK(carried(4.0 * kMass) == 4.0);
  CHECK(carried(4.001 * kMass) == 16.0);
  CHECK(carried(16.0 * kMass) == 16.0);
  CHECK(carried(100.0 * kMass) == 256.0);
  // No point carries more than all there is: 500 effective masses.
  CHECK(carried(1e6 * kMass) == 1024.0);
}

TEST_CASE("penalty_kernels: along the tangents it depends on whether the point sticks", "[core][penalty_kernels]") {
  const double normal = 4.0 * kMass * kFit.impulse_per_mass;
  const double sticks = fitted(with_impulse(normal, 0.99 * kFriction * normal)).penalty[1][0];
  const double slides = fitted(with_impulse(normal, kFriction * normal)).penalty[1][0];
  CHECK(sticks == kFit.sticking * 4.0 * kMass);
  CHECK(slides == kFit.sliding * 4.0 * kMass);
  ContactConstraint smooth = with_impulse(normal);
  smooth.friction = 0.0;
  CHECK(fitted(smooth).penalty[1][0] == 0.0);
  CHECK(fitted(smooth).inverse_penalty[1][0] == 0.0);
}

TEST_CASE("penalty_kernels: a point without impulse has little, unless one is expected when the solve begins",
          "[core][penalty_kernels]") {
  ContactConstraint idle = with_impulse(0.0);
  CHECK(fitted(idle).penalty[0][0] == Approx(kFit.sticking * kFit.idle * kMass));
  CHECK(fitted(idle).penalty[1][0] == Approx(kFit.sliding * kFit.idle * kMass));
  idle.expected_impulse[0] = 16.0 * kMass * kFit.impulse_per_mass;
  CHECK(fitted(idle).penalty[0][0] == kFit.sticking * 16.0 * kMass);
  PenaltyFit later = kFit;
  later.continues = true;
  CHECK(fitted(idle, later).penalty[0][0] == Approx(kFit.sticking * kFit.idle * kMass));
}

TEST_CASE("penalty_kernels: lanes without a point have none, and fit", "[core][penalty_kernels]") {
  std::vector<ContactConstraint> constraints(2, with_impulse(1.0));
  constraints[1].count = 3;
  CHECK(count_misfits(kFit, constraints) == 4.0);
  fit_penalty(kFit, constraints);
  for (std::size_t p = 0; p < 2; ++p) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const bool used = lane < static_cast<std::size_t>(constraints[p].count);
      for (std::size_t d = 0; d < 2; ++d) {
        CHECK((constraints[p].penalty[d][lane] > 0.0) == used);
        CHECK(constraints[p].inverse_penalty[d][lane] == (used ? 1.0 / constraints[p].penalty[d][lane] : 0.0));
      }
    }
  }
  CHECK(count_misfits(kFit, constraints) == 0.0);
  constraints[1].impulse.row[0][2] = 100.0;
  CHECK(count_misfits(kFit, constraints) == 1.0);
}

TEST_CASE("penalty_kernels: every instruction set computes the same bits", "[core][penalty_kernels]") {
  Random random(5);
  std::vector<ContactConstraint> constraints(40);
  for (ContactConstraint& constraint : constraints) {
    constraint = with_impulse(0.0);
    constraint.count = 1 + static_cast<std::int32_t>(random.between(0, 4));
    constraint.effective_mass = random.between(0.1, 30.0);
    for (std::size_t lane = 0; lane < static_cast<std::size_t>(constraint.count); ++lane)
      for (std::size_t d = 0; d < 3; ++d) constraint.impulse.row[d][lane] = random.between(-2.0, 20.0);
  }
  std::vector<std::vector<ContactConstraint>> outputs;
  for_each_instruction_set([&](std::int64_t) { fit_penalty(kFit, outputs.emplace_back(constraints)); });
  REQUIRE_FALSE(outputs.empty());
  for (const std::vector<ContactConstraint>& output : outputs) {
    for (std::size_t p = 0; p < output.size(); ++p) {
      CHECK(output[p].penalty == outputs[0][p].penalty);
      CHECK(output[p].inverse_penalty == outputs[0][p].inverse_penalty);
    }
  }
}

}  // namespace penalty_kernels_test
