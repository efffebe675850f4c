#pragma once

#include <cstdint>

#include "core/model/acceleration.hpp"

namespace holdfast::internal {

/// Divides a phase into equal steps, none longer than requested, so that no step crosses a boundary of the phase.
class StepPlan {
 public:
  /// @param phase            interval of constant acceleration, s
  /// @param steps_per_second requested steps per second, 1/s; the longest step is its inverse
  StepPlan(const Phase& phase, double steps_per_second);

  std::uint64_t step_count() const { return step_count_; }

  /// Length of every step, s.
  double step() const;

  /// End of step `i`, counted from 0, s; exactly the phase's end for the last one.
  double end_of(std::uint64_t i) const;

  /// Number of steps that end at or before `time`, s: the index of the next step at that time.
  std::uint64_t steps_before(double time) const;

 private:
  Phase phase_;
  std::uint64_t step_count_;
};

}  // namespace holdfast::internal
