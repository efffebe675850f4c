#include "core/engine/series_recorder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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

RecordingPlan plan_for(RecordingPlan plan, const Acceleration& acceleration) {
  if (!acceleration.purpose.empty()) plan.stop_when = StopWhen::end;
  return plan;
}

void SeriesRecorder::start(const BoxView& boxes, const StateView& layout, double time) {
  boxes_ = boxes;
  layout_.position.assign(layout.position.begin(), layout.position.end());
  layout_.orientation.assign(layout.orientation.begin(), layout.orientation.end());
  BoxTable& table = record_.boxes;
  for (std::size_t box = 0; box < boxes.mass.size(); ++box) {
    table.id.push_back(static_cast<std::uint32_t>(box + 1));
    table.material.push_back(boxes.material[box]);
    // A fixed box counts in no weight.
    table.mass.push_back(std::isfinite(boxes.mass[box]) ? static_cast<float>(boxes.mass[box]) : 0.0F);
    table.size.push_back(to_float(2.0 * boxes.half_extents[box]));
    table.initial_position.push_back(to_float(layout.position[box]));
  }
  begin_at(time, layout, layout);
}

void SeriesRecorder::accelerate(const StateView& settled) {
  EndTable& end = record_.end;
  end.settling_peak_displacement = end.peak_displacement;
  end.settling_peak_drop = end.peak_drop;
  end.settling_peak_tilt = end.peak_tilt;
  for (std::size_t box = 0; box < boxes_.mass.size(); ++box)
    end.settling_displacement.push_back(to_float(settled.position[box] - layout_.position[box]));
  settles_ = false;
  StateView reference = settled;
  if (plan_.reference_pose == ReferencePose::layout) {
    reference.position = layout_.position;
    reference.orientation = layout_.orientation;
  }
  begin_at(0.0, settled, reference);
}

void SeriesRecorder::begin_at(double time, const StateView& now, const StateView& reference) {
  const std::size_t count = boxes_.mass.size();
  reference_position_.assign(reference.position.begin(), reference.position.end());
  reference_orientation_.assign(reference.orientation.begin(), reference.orientation.end());
  last_linear_acceleration_.assign(count, Vec3::Zero());
  largest_tilt_sine_.assign(count, 0.0);
  analyses_.clear();
  for (const auto& make : plan_.analyses) analyses_.push_back(make(boxes_, now));
  begin_ = time;
  sample_count_ = 0;
  record_.series = {};
  if (plan_.series) reserve_series(plan_.samples, count);
  EndTable& end = record_.end;
  for (std::vector<float>* peak :
       {&end.peak_displacement, &end.peak_drop, &end.peak_tilt, &end.peak_kinetic_energy, &end.peak_speed})
    peak->assign(count, 0.0F);
  end.first_beyond.assign(count, std::numeric_limits<float>::quiet_NaN());
  record_.row.peak_total_kinetic_energy = 0.0;
  // Where the solver has failed while the load settled, nothing that follows can be trusted.
  if (std::isnan(record_.row.status_time)) update_peaks(now, time);
  add_sample({time, 1.0, {time, time, Vec3::Zero(), now, now}});
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

void SeriesRecorder::step(const Step& step) {
  const double duration = step.end - step.begin;
  last_acceleration_ = step.acceleration;
  for (std::size_t box = 0; box < boxes_.mass.size(); ++box)
    last_linear_acceleration_[box] = (step.after.velocity[box] - step.before.velocity[box]) / duration;
  if (step.status != Status::ok && std::isnan(record_.row.status_time)) record_.row.status_time = step.begin;
  if (std::isnan(record_.row.status_time)) update_peaks(step.after, step.end);
  for (const auto& analysis : analyses_) analysis->step(step);
  while (next_sample() <= step.end + kSameInstant) {
    const bool at_end = std::abs(next_sample() - step.end) <= kSameInstant;
    add_sample({next_sample(), at_end ? 1.0 : (next_sample() - step.begin) / duration, step});
  }
}

bool SeriesRecorder::decided() const {
  switch (plan_.stop_when) {
    case StopWhen::end:
      return false;
    case StopWhen::moved:
      return beyond_;
    case StopWhen::fallen:
      return settles_ ? beyond_ : fallen_;
  }
  return false;
}

void SeriesRecorder::finish(const Outcome& outcome, const StateView& end) {
  const Series& series = record_.series;
  if (plan_.series && outcome.end_time - series.time.back() > kSameInstant)
    add_sample({outcome.end_time, 1.0, {outcome.end_time, outcome.end_time, last_acceleration_, end, end}});
  EndTable& table = record_.end;
  for (std::size_t box = 0; box < boxes_.mass.size(); ++box) {
    table.end_displacement.push_back(displacement(end.position[box], box));
    table.end_tilt.push_back(tilt_of(turn(end.orientation[box], box)));
    table.end_kinetic_energy.push_back(
        static_cast<float>(kinetic_energy(box, end.velocity[box], end.angular_velocity[box], end.orientation[box])));
  }
  if (settles_) {
    table.settling_peak_displacement = table.peak_displacement;
    table.settling_peak_drop = table.peak_drop;
    table.settling_peak_tilt = table.peak_tilt;
    table.settling_displacement = table.end_displacement;
  }
  for (const auto& analysis : analyses_) analysis->finish(record_.found);
  WorldRow& row = record_.row;
  row.status = outcome.status;
  if (row.status != Status::ok && std::isnan(row.status_time)) row.status_time = outcome.end_time;
  row.caveats = outcome.caveats;
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
    const Vec3 force = plan_.external_force && std::isfinite(boxes_.mass[box])
                           ? Vec3(-boxes_.mass[box] * step.acceleration)
                           : Vec3::Zero();

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

void SeriesRecorder::update_peaks(const StateView& state, double time) {
  EndTable& end = record_.end;
  double total_energy = 0.0;
  for (std::size_t box = 0; box < boxes_.mass.size(); ++box) {
    const double energy = kinetic_energy(box, state.velocity[box], state.angular_velocity[box], state.orientation[box]);
    total_energy += energy;
    end.peak_kinetic_energy[box] = std::max(end.peak_kinetic_energy[box], static_cast<float>(energy));
    end.peak_speed[box] = std::max(end.peak_speed[box], static_cast<float>(state.velocity[box].norm()));

    Excursion peak{end.peak_displacement[box], end.peak_drop[box], end.peak_tilt[box]};
    const Float3 moved_by = displacement(state.position[box], box);
    peak.extend({length(moved_by), -moved_by.z, peak.tilt});
    // sin² of half the angle grows with it, and costs less.
    const Rotation turned_by = turn(state.orientation[box], box);
    if (const double sine = turned_by.vec().squaredNorm(); sine > largest_tilt_sine_[box]) {
      largest_tilt_sine_[box] = sine;
      peak.tilt = std::max(peak.tilt, tilt_of(turned_by));
    }
    end.peak_displacement[box] = peak.displacement;
    end.peak_drop[box] = peak.drop;
    end.peak_tilt[box] = peak.tilt;
    if (std::isnan(end.first_beyond[box]) && is_beyond(peak, plan_.thresholds)) {
      end.first_beyond[box] = static_cast<float>(time);
      beyond_ = true;
    }
    fallen_ = fallen_ || has_fallen(peak, plan_.thresholds);
  }
  record_.row.peak_total_kinetic_energy = std::max(record_.row.peak_total_kinetic_energy, total_energy);
}

Float3 SeriesRecorder::displacement(const Vec3& position, std::size_t box) const {
  return to_float(position - reference_position_[box]);
}

/// ½ m v² + ½ ω·Iω with ω in body axes, J.
double SeriesRecorder::kinetic_energy(std::size_t box, const Vec3& velocity, const Vec3& angular_velocity,
                                      const Rotation& container_from_body) const {
  if (std::isinf(boxes_.mass[box])) return 0.0;
  const Vec3 spin = container_from_body.conjugate() * angular_velocity;
  return 0.5 * boxes_.mass[box] * velocity.squaredNorm() + 0.5 * spin.dot(boxes_.inertia[box].cwiseProduct(spin));
}

Rotation SeriesRecorder::turn(const Rotation& container_from_body, std::size_t box) const {
  return container_from_body * reference_orientation_[box].conjugate();
}

}  // namespace holdfast::internal
