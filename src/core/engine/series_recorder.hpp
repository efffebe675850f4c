#pragma once

#include <utility>
#include <vector>

#include "core/engine/recorder.hpp"
#include "core/engine/world_record.hpp"
#include "core/model/settings.hpp"
#include "core/model/verdict.hpp"

namespace holdfast::internal {

/// What a recorder needs to know of the run.
struct RecordingPlan {
  double interval = 0.1;  ///< between samples, s
  bool series = true;     ///< keep samples; peaks and ends are kept in any case
  ReferencePose reference_pose = ReferencePose::layout;
  std::size_t samples = 0;     ///< room that is made for samples at once; more come as they may
  bool external_force = true;  ///< −m a(t) acts on the boxes; false in a free container
  Thresholds thresholds;
};
RecordingPlan recording_plan(const Settings& settings, bool series);

/// Records what the results file keeps of a world: samples at 0, every interval and the end, interpolated
/// linearly between step ends; peaks over all steps; the ends of all boxes.
class SeriesRecorder final : public Recorder {
 public:
  explicit SeriesRecorder(const RecordingPlan& plan) : plan_(plan) {}

  void start(const BoxView& boxes, const StateView& layout, const StateView& settled) override;
  double output_time() const override;
  void step(const Step& step) override;
  void finish(const Outcome& outcome, const StateView& end) override;

  /// The record, after `finish`; the caller adds what only it knows (indices, times). Empties the recorder.
  WorldRecord take() { return std::move(record_); }

 private:
  /// A step seen at one instant: `share` is 0 at its begin and 1 at its end.
  struct Instant {
    double time;
    double share;
    const Step& step;
  };

  /// Growing as samples come, the largest series would need twice their memory.
  void reserve_series(std::size_t samples, std::size_t boxes);
  void add_sample(const Instant& instant);
  void update_peaks(const StateView& state);
  Float3 displacement(const Vec3& position, std::size_t box) const;
  double kinetic_energy(std::size_t box, const Vec3& velocity, const Vec3& angular_velocity,
                        const Rotation& container_from_body) const;
  float tilt(const Rotation& container_from_body, std::size_t box) const;

  RecordingPlan plan_;
  BoxView boxes_;
  std::vector<Vec3> reference_position_;         ///< that displacement is measured from, m
  std::vector<Rotation> reference_orientation_;  ///< that tilt is measured from
  std::size_t sample_count_ = 0;
  Vec3 last_acceleration_ = Vec3::Zero();       ///< of the container in the last step, m/s²
  std::vector<Vec3> last_linear_acceleration_;  ///< of the boxes in the last step, m/s²
  WorldRecord record_;
};

}  // namespace holdfast::internal
