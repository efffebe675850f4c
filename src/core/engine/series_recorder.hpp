#pragma once

#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "core/engine/analysis_method.hpp"
#include "core/engine/recorder.hpp"
#include "core/engine/world_record.hpp"
#include "core/model/settings.hpp"
#include "core/model/verdict.hpp"

namespace holdfast::internal {

/// Options of a recorder.
struct RecordingPlan {
  double interval = 0.1;  ///< between samples, s
  bool series = true;     ///< record samples; peaks and end values are always recorded
  ReferencePose reference_pose = ReferencePose::layout;
  std::size_t samples = 0;     ///< number of samples to reserve memory for; more may follow
  bool external_force = true;  ///< −m a(t) acts on the boxes; false in a free container
  Thresholds thresholds;
  StopWhen stop_when = StopWhen::end;  ///< what decides the world
  /// Makes the recorders of analyses; empty: none.
  std::vector<std::function<std::unique_ptr<AnalysisRecorder>(const BoxView& boxes, const StateView& settled)>>
      analyses;
};
/// @param settings kept by reference where there are analyses
RecordingPlan recording_plan(const Settings& settings, bool series, const AnalysisMethods& analyses = {});

/// Records what the results file contains of a world: samples at 0, after every interval and at the end, interpolated
/// linearly between the ends of steps; peaks over all steps; end values of all boxes.
class SeriesRecorder final : public Recorder {
 public:
  explicit SeriesRecorder(const RecordingPlan& plan) : plan_(plan) {}

  void start(const BoxView& boxes, const StateView& layout, const StateView& settled) override;
  /// The next sample. Where something may decide the world also without series, so that an engine that takes many steps
  /// at once shows the same states with and without them.
  double output_time() const override;
  void step(const Step& step) override;
  bool decided() const override { return decided_; }
  void finish(const Outcome& outcome, const StateView& end) override;

  /// Returns the record, after `finish`, and empties the recorder. The caller adds indices and times to the record.
  WorldRecord take() { return std::move(record_); }

 private:
  /// A point in time within a step: `share` is 0 at the start of the step and 1 at its end.
  struct Instant {
    double time;
    double share;
    const Step& step;
  };

  /// Reserves memory. If vectors grew sample by sample, the largest series would need twice their memory.
  void reserve_series(std::size_t samples, std::size_t boxes);
  void add_sample(const Instant& instant);
  void update_peaks(const StateView& state);
  /// True when a box is beyond a threshold that `stop_when` watches.
  bool decides(const StateView& state) const;
  Float3 displacement(const Vec3& position, std::size_t box) const;
  double kinetic_energy(std::size_t box, const Vec3& velocity, const Vec3& angular_velocity,
                        const Rotation& container_from_body) const;
  float tilt(const Rotation& container_from_body, std::size_t box) const;

  RecordingPlan plan_;
  BoxView boxes_;
  std::vector<Vec3> reference_position_;         ///< from which displacement is measured, m
  std::vector<Rotation> reference_orientation_;  ///< from which tilt is measured
  std::size_t sample_count_ = 0;                 ///< that were due, recorded or not
  bool decided_ = false;
  Vec3 last_acceleration_ = Vec3::Zero();       ///< of the container in the last step, m/s²
  std::vector<Vec3> last_linear_acceleration_;  ///< of the boxes in the last step, m/s²
  std::vector<std::unique_ptr<AnalysisRecorder>> analyses_;
  WorldRecord record_;
};

}  // namespace holdfast::internal
