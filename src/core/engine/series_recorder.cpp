#include "core/engine/series_recorder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/engine/interpolation.hpp"

namespace holdfast::internal {

namespace {

/// Adding 0 turns −0 into 0, which is easier to read.
float to_float(double number) { return static_cast<float>(number) + 0.0F; }
Float3 to_float(const Vec3& v) { return {to_float(v.x()), to_float(v.y()), to_float(v.z())}; }
Float4 to_float(const Rotation& q) { return {to_float(q.w()), to_float(q.x()), to_float(q.y()), to_float(q.z())}; }

}  // namespace

RecordingPlan recording_plan(const Settings& settings, bool series, const AnalysisMethods& analyses) {
  const ScreeningSettings& screening = settings.screening;
  RecordingPlan plan{.interval = settings.results_interval,
                     .series = series,
                     .reference_pose = screening.reference_pose,
                     .external_force = settings.container.motion == ContainerMotion::prescribed,
                     .thresholds = {screening.drop_threshold, screening.move_threshold, screening.tilt_threshold},
                     .stop_when = screening.stop_when};
  for (const AnalysisMethod* analysis : analyses)
    if (analysis->recorder != nullptr)
      plan.analyses.emplace_back(
          [&settings, make = analysis->recorder](const BoxView& boxes, const StateView& settled) {
            return make(settings, boxes, settled);
          });
  return plan;
}

void SeriesRecorder::start(const BoxView& boxes, const StateView& layout, const StateView& settled) {
  boxes_ = boxes;
  const std::size_t count = boxes.mass.size();
  const StateView& reference = plan_.reference_pose == ReferencePose::layout ? layout : settled;
  reference_position_.assign(reference.position.begin(), reference.position.end());
  reference_orientation_.assign(reference.orientation.begin(), reference.orientation.end());
  last_linear_acceleration_.assign(count, Vec3::Zero());

  for (const auto& make : plan_.analyses) analyses_.push_back(make(boxes, settled));

  BoxTable& table = record_.boxes;
  EndTable& end = record_.end;
  for (std::size_t box = 0; box < count; ++box) {
    table.id.push_back(static_cast<std::uint32_t>(box + 1));
    table.material.push_back(boxes.material[box]);
    table.mass.push_back(static_cast<float>(boxes.mass[box]));
    table.size.push_back(to_float(2.0 * boxes.half_extents[box]));
    table.initial_position.push_back(to_float(layout.position[box]));
    end.settling_displacement.push_back(to_float(settled.position[box] - layout.position[box]));
  }
  if (plan_.series) reserve_series(plan_.samples, count);
  end.peak_displacement.assign(count, 0.0F);
  end.peak_kinetic_energy.assign(count, 0.0F);
  end.peak_speed.assign(count, 0.0F);
  update_peaks(settled);
  add_sample({0.0, 1.0, {0.0, 0.0, Vec3::Zero(), settled, settled}});
}

void SeriesRecorder::reserve_series(std::size_t samples, std::size_t boxes) {
  Series& series = record_.series;
  series.time.reserve(samples);
  series.container_acceleration.reserve(samples);
  series.total_kinetic_energy.reserve(samples);
  series.fallen_count.reserve(samples);
  const std::size_t rows = samples * boxes;
  series.displacement.reserve(rows);
  series.orientation.reserve(rows);
  series.angular_velocity.reserve(rows);
  series.linear_acceleration.reserve(rows);
  series.force.reserve(rows);
  series.kinetic_energy.reserve(rows);
}

double SeriesRecorder::output_time() const {
  if (!plan_.series && plan_.stop_when == StopWhen::end) return std::numeric_limits<double>::infinity();
  return static_cast<double>(sample_count_) * plan_.interval;
}

void SeriesRecorder::step(const Step& step) {
  const double duration = step.end - step.begin;
  last_acceleration_ = step.acceleration;
  for (std::size_t box = 0; box < boxes_.mass.size(); ++box)
    last_linear_acceleration_[box] = (step.after.velocity[box] - step.before.velocity[box]) / duration;
  update_peaks(step.after);
  for (const auto& analysis : analyses_) analysis->step(step);
  decided_ = decides(step.after);
  while (output_time() <= step.end + kSameInstant) {
    const bool at_end = std::abs(output_time() - step.end) <= kSameInstant;
    add_sample({output_time(), at_end ? 1.0 : (output_time() - step.begin) / duration, step});
  }
}

void SeriesRecorder::finish(const Outcome& outcome, const StateView& end) {
  const Series& series = record_.series;
  if (plan_.series && outcome.end_time - series.time.back() > kSameInstant)
    add_sample({outcome.end_time, 1.0, {outcome.end_time, outcome.end_time, last_acceleration_, end, end}});

  for (std::size_t box = 0; box < boxes_.mass.size(); ++box) {
    record_.end.displacement.push_back(displacement(end.position[box], box));
    record_.end.tilt.push_back(tilt(end.orientation[box], box));
    record_.end.kinetic_energy.push_back(
        static_cast<float>(kinetic_energy(box, end.velocity[box], end.angular_velocity[box], end.orientation[box])));
  }
  for (const auto& analysis : analyses_) analysis->finish(record_.found);
  WorldRow& row = record_.row;
  row.status = outcome.status;
  row.stop_reason = outcome.stop_reason;
  row.end_time = outcome.end_time;
  row.boxes = static_cast<std::uint32_t>(boxes_.mass.size());
  row.state_hash = state_hash(end);
  row.cpu_seconds = outcome.counters.device_seconds;
  visit_counters<WorldRow, Counters>(
      [&](const OutcomeField&, auto to, auto from) { row.*to = outcome.counters.*from; });
}

void SeriesRecorder::add_sample(const Instant& instant) {
  ++sample_count_;
  if (!plan_.series) return;
  const Step& step = instant.step;
  Series& series = record_.series;
  double total_energy = 0.0;
  std::uint32_t fallen = 0;
  for (std::size_t box = 0; box < boxes_.mass.size(); ++box) {
    const auto at_instant = [&](const auto& before, const auto& after) {
      return between(before[box], after[box], instant.share);
    };
    const Rotation orientation = at_instant(step.before.orientation, step.after.orientation);
    const Vec3 angular_velocity = at_instant(step.before.angular_velocity, step.after.angular_velocity);
    const Vec3 velocity = at_instant(step.before.velocity, step.after.velocity);
    const double energy = kinetic_energy(box, velocity, angular_velocity, orientation);
    const Vec3 force = plan_.external_force ? Vec3(-boxes_.mass[box] * step.acceleration) : Vec3::Zero();

    series.displacement.push_back(displacement(at_instant(step.before.position, step.after.position), box));
    series.orientation.push_back(to_float(orientation));
    series.angular_velocity.push_back(to_float(angular_velocity));
    series.linear_acceleration.push_back(to_float(last_linear_acceleration_[box]));
    series.force.push_back(to_float(force));
    series.kinetic_energy.push_back(static_cast<float>(energy));
    total_energy += energy;
    fallen += is_fallen(series.displacement.back(), plan_.thresholds) ? 1U : 0U;
  }
  series.time.push_back(instant.time);
  series.container_acceleration.push_back(to_float(step.acceleration));
  series.total_kinetic_energy.push_back(static_cast<float>(total_energy));
  series.fallen_count.push_back(fallen);
  for (const auto& analysis : analyses_) analysis->sample();
}

void SeriesRecorder::update_peaks(const StateView& state) {
  EndTable& end = record_.end;
  double total_energy = 0.0;
  for (std::size_t box = 0; box < boxes_.mass.size(); ++box) {
    const double energy = kinetic_energy(box, state.velocity[box], state.angular_velocity[box], state.orientation[box]);
    total_energy += energy;
    end.peak_kinetic_energy[box] = std::max(end.peak_kinetic_energy[box], static_cast<float>(energy));
    end.peak_speed[box] = std::max(end.peak_speed[box], static_cast<float>(state.velocity[box].norm()));
    end.peak_displacement[box] = std::max(end.peak_displacement[box], length(displacement(state.position[box], box)));
  }
  record_.row.peak_total_kinetic_energy = std::max(record_.row.peak_total_kinetic_energy, total_energy);
}

bool SeriesRecorder::decides(const StateView& state) const {
  if (plan_.stop_when == StopWhen::end) return false;
  for (std::size_t box = 0; box < boxes_.mass.size(); ++box) {
    const Float3 moved_by = displacement(state.position[box], box);
    if (is_fallen(moved_by, plan_.thresholds)) return true;
    if (plan_.stop_when == StopWhen::fallen) continue;
    if (is_moved(moved_by, plan_.thresholds) || is_tilted(tilt(state.orientation[box], box), plan_.thresholds))
      return true;
  }
  return false;
}

Float3 SeriesRecorder::displacement(const Vec3& position, std::size_t box) const {
  return to_float(position - reference_position_[box]);
}

/// ½ m v² + ½ ω·Iω with ω in body axes, J.
double SeriesRecorder::kinetic_energy(std::size_t box, const Vec3& velocity, const Vec3& angular_velocity,
                                      const Rotation& container_from_body) const {
  const Vec3 spin = container_from_body.conjugate() * angular_velocity;
  return 0.5 * boxes_.mass[box] * velocity.squaredNorm() + 0.5 * spin.dot(boxes_.inertia[box].cwiseProduct(spin));
}

/// Angle of the rotation since the reference pose, degrees: 2 atan2(|vector part|, |scalar part|).
float SeriesRecorder::tilt(const Rotation& container_from_body, std::size_t box) const {
  const Rotation turn = container_from_body * reference_orientation_[box].conjugate();
  return static_cast<float>(2.0 * std::atan2(turn.vec().norm(), std::abs(turn.w())) * 180.0 / std::numbers::pi);
}

}  // namespace holdfast::internal
