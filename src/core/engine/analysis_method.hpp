#pragma once

#include <atomic>
#include <memory>
#include <vector>

#include "core/engine/engine.hpp"
#include "core/engine/findings.hpp"
#include "core/engine/recorder.hpp"
#include "core/engine/result_sink.hpp"
#include "core/model/layout.hpp"
#include "core/model/settings.hpp"

namespace holdfast::internal {

/// Follows a world while it is simulated, beside what is recorded of every world.
class AnalysisRecorder {
 public:
  AnalysisRecorder() = default;
  AnalysisRecorder(const AnalysisRecorder&) = delete;
  AnalysisRecorder& operator=(const AnalysisRecorder&) = delete;
  virtual ~AnalysisRecorder() = default;

  /// Called for every step, in order. Those before t = 0 are of settling; at t = 0 recorders are made anew.
  virtual void step(const Step& step) = 0;
  /// Called for every sample of a series, after the step that it lies in.
  virtual void sample() {}
  /// Called once, last: puts what was found.
  virtual void finish(Findings& found) = 0;
};

/// What analyses that simulate on their own work with.
struct AnalysisInputs {
  const Engine& engine;
  const Settings& settings;
  const std::atomic<bool>& abort;  ///< checked after every step
  double (*processor_seconds)();   ///< processor time of the calling thread, s
};

/// How an analysis finds what it finds; each of these may be absent. All settings that ask for it are at hand.
struct AnalysisMethod {
  /// Made for every world at t = 0.
  std::unique_ptr<AnalysisRecorder> (*recorder)(const Settings& settings, const BoxView& boxes,
                                                const StateView& settled) = nullptr;
  /// Called once for every layout, also for one that cannot be used and has no boxes. False when aborted.
  bool (*of_layout)(const AnalysisInputs& inputs, LayoutRecord& layout) = nullptr;
  /// Called once for every world that was simulated. False when aborted.
  bool (*of_world)(const AnalysisInputs& inputs, const Layout& layout, const Acceleration& acceleration,
                   WorldRecord& world) = nullptr;
};

/// Those of a run.
using AnalysisMethods = std::vector<const AnalysisMethod*>;

}  // namespace holdfast::internal
