#include "core/engine/step_plan.hpp"

#include <algorithm>
#include <cmath>

namespace holdfast::internal {

namespace {

/// Fraction of a step by which a phase may exceed a whole number of steps through rounding without an additional step.
constexpr double kStepSlack = 1e-6;

}  // namespace

StepPlan::StepPlan(const Phase& phase, double steps_per_second) : phase_(phase) {
  const double wanted = (phase.end - phase.begin) * steps_per_second;
  step_count_ = static_cast<std::uint64_t>(std::max(1.0, std::ceil(wanted - kStepSlack)));
}

double StepPlan::step() const { return (phase_.end - phase_.begin) / static_cast<double>(step_count_); }

double StepPlan::end_of(std::uint64_t i) const {
  if (i + 1 >= step_count_) return phase_.end;
  const double share = static_cast<double>(i + 1) / static_cast<double>(step_count_);
  return phase_.begin + (phase_.end - phase_.begin) * share;
}

std::uint64_t StepPlan::steps_before(double time) const {
  const double share = (time - phase_.begin) / step();
  return static_cast<std::uint64_t>(std::max(0.0, std::floor(share + 0.5)));
}

}  // namespace holdfast::internal
