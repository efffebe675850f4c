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
  ReferencePose reference_pose = ReferencePose::settled;
  std::size_t samples = 0;     ///< number of samples to reserve memory for; more may follow
  bool external_force = true;  ///< −m a(t) acts on the boxes; false in a free container
  Thresholds thresholds;
  StopWhen stop_when = StopWhen::end;  ///< what ends the world
  /// Makes the recorders of analyses; empty: none.
  std::vector<std::function<std::unique_ptr<AnalysisRecorder>(const BoxView& boxes, const StateView& settled)>>
      analyses;
};
/// @param settings kept by reference where there are analyses
RecordingPlan recording_plan(const Settings& settings, bool series, const AnalysisMethods& analyses = {});

/// The plan for a world under that acceleration: one that a norm states for sliding or tipping alone does not end early
/// by what else happens.
RecordingPlan plan_for(RecordingPlan plan, const Acceleration& acceleration);

/// Records what the results file contains of a world: samples at t = 0, after every interval and at the end,
/// interpolated linearly between the ends of steps; peaks over all steps up to the first bit of the status; end values
/// of all boxes. What settling did is recorded likewise, from its begin on; it makes room for the rest at t = 0, unless
/// the world is unstable and ends there.
class SeriesRecorder final : public Recorder {
 public:
  explicit SeriesRecorder(const RecordingPlan& plan) : plan_(plan) {}

  void start(const BoxView& boxes, const StateView& layout, double time) override;
  void accelerate(const StateView& settled) override;
  void step(const Step& step) override;
  bool decided() const override;
  bool is_unstable() const override { return settles_ && beyond_; }
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

  /// Forgets what was recorded, and begins to record at a time.
  /// @param reference pose from which displacement and tilt are measured
  void begin_at(double time, const StateView& now, const StateView& reference);
  /// Reserves memory. If vectors grew sample by sample, the largest series would need twice their memory.
  void reserve_series(std::size_t samples, std::size_t boxes);
  /// Time of the next sample, s.
  double next_sample() const { return begin_ + static_cast<double>(sample_count_) * plan_.interval; }
  void add_sample(const Instant& instant);
  void update_peaks(const StateView& state, double time);
  Float3 displacement(const Vec3& position, std::size_t box) const;
  double kinetic_energy(std::size_t box, const Vec3& velocity, const Vec3& angular_velocity,
                        const Rotation& container_from_body) const;
  /// Rotation since the reference pose.
  Rotation turn(const Rotation& container_from_body, std::size_t box) const;

  RecordingPlan plan_;
  BoxView boxes_;
  StateColumns layout_;                          ///< the layout's pose, while the load settles
  std::vector<Vec3> reference_position_;         ///< from which displacement is measured, m
  std::vector<Rotation> reference_orientation_;  ///< from which tilt is measured
  bool settles_ = true;                          ///< t = 0 is not reached yet
  double begin_ = 0.0;                           ///< time of the first sample, s
  std::size_t sample_count_ = 0;                 ///< that were due, recorded or not
  bool beyond_ = false;                          ///< a box has been beyond a limit
  bool fallen_ = false;                          ///< a box has fallen
  std::vector<double> largest_tilt_sine_;        ///< sin² of half the largest tilt of the boxes
  Vec3 last_acceleration_ = Vec3::Zero();        ///< of the container in the last step, m/s²
  std::vector<Vec3> last_linear_acceleration_;   ///< of the boxes in the last step, m/s²
  std::vector<std::unique_ptr<AnalysisRecorder>> analyses_;
  WorldRecord record_;
};

}  // namespace holdfast::internal
