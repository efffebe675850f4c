#pragma once

#include <array>
#include <atomic>

#include "parallel/schedulers/processor_time.hpp"

namespace holdfast::internal {

/// Where a run's processor time goes.
enum class Stage { read, build, simulate, compress, write, assemble };

inline constexpr std::array<const char*, 6> kStageNames = {"read",     "build", "simulate",
                                                           "compress", "write", "assemble"};

/// Processor seconds by stage, as one table of numbers.
using StageSeconds = std::array<double, kStageNames.size()>;

/// Adds up processor time by stage, from all threads.
class StageCosts {
 public:
  void add(Stage stage, double seconds) { seconds_[static_cast<std::size_t>(stage)] += seconds; }

  /// The sums so far. What was added to `simulate` holds what was added to `build` meanwhile, which is taken out.
  StageSeconds seconds() const;

 private:
  std::array<std::atomic<double>, kStageNames.size()> seconds_{};
};

/// Adds the processor time of its thread, from its making to its end, to a stage.
class StageTimer {
 public:
  StageTimer(StageCosts& costs, Stage stage) : costs_(costs), stage_(stage) {}
  StageTimer(const StageTimer&) = delete;
  StageTimer& operator=(const StageTimer&) = delete;
  ~StageTimer() { costs_.add(stage_, processor_seconds() - begin_); }

 private:
  StageCosts& costs_;
  Stage stage_;
  double begin_ = processor_seconds();
};

}  // namespace holdfast::internal
