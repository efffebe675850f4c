#include "validate/laboratory/track.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace holdfast::internal {

namespace {

Snapshot snapshot_of(double time, const StateView& state) {
  return {time,
          {state.position.begin(), state.position.end()},
          {state.orientation.begin(), state.orientation.end()},
          {state.velocity.begin(), state.velocity.end()},
          {state.angular_velocity.begin(), state.angular_velocity.end()}};
}

Peak parabola_peak(const std::array<double, 3>& time, const std::array<double, 3>& value) {
  // Newton's divided differences about the middle sample.
  const double first = (value[1] - value[0]) / (time[1] - time[0]);
  const double second = (value[2] - value[1]) / (time[2] - time[1]);
  const double bend = (second - first) / (time[2] - time[0]);
  const double slope = first + bend * (time[1] - time[0]);
  if (!(bend < 0.0)) return {time[1], value[1]};
  return {time[1] - 0.5 * slope / bend, value[1] - 0.25 * slope * slope / bend};
}

Vec3 acceleration_at(const Acceleration& acceleration, double time) {
  for (const Segment& segment : acceleration.segments)
    if (time >= segment.start && time < segment.start + segment.duration) return segment.acceleration;
  return Vec3::Zero();
}

}  // namespace

Track track_of(Laboratory& laboratory, const Scene& scene) {
  Track track;
  laboratory.run(scene, [&](const Moment& moment) {
    track.push_back(snapshot_of(moment.time, moment.state));
    return true;
  });
  if (track.empty()) {
    const WorldBatch start = scene.batch();
    track.push_back(snapshot_of(0.0, view(start.state, start.worlds.front())));
  }
  return track;
}

std::vector<Peak> peaks_of(const Track& track, const Quantity& quantity, double least) {
  std::vector<Peak> peaks;
  for (std::size_t i = 1; i + 1 < track.size(); ++i) {
    const std::array<double, 3> value = {quantity(track[i - 1]), quantity(track[i]), quantity(track[i + 1])};
    if (value[1] > least && value[0] < value[1] && value[1] >= value[2])
      peaks.push_back(parabola_peak({track[i - 1].time, track[i].time, track[i + 1].time}, value));
  }
  return peaks;
}

Arrival arrival_of(const Track& track, const Quantity& gap, const Quantity& speed, double acceleration) {
  for (std::size_t i = 1; i < track.size(); ++i) {
    const double before = speed(track[i - 1]);
    if (speed(track[i]) >= 0.99 * before) continue;
    const double left = gap(track[i - 1]);
    const double arrival_speed = std::sqrt(std::max(0.0, before * before + 2.0 * acceleration * left));
    return {track[i - 1].time + 2.0 * left / (before + arrival_speed), arrival_speed};
  }
  return {std::numeric_limits<double>::infinity(), 0.0};
}

double stop_time(const Track& track, std::size_t i, double deceleration) {
  constexpr double kMoving = 0.01;
  for (auto state = track.rbegin(); state != track.rend(); ++state) {
    const double speed = state->velocity[i].norm();
    if (speed > kMoving) return state->time + speed / deceleration;
  }
  return 0.0;
}

double kinetic_energy(const Scene& scene, const Snapshot& state) {
  const BoxColumns boxes = scene.batch().boxes;
  double energy = 0.0;
  for (std::size_t i = 0; i < boxes.mass.size(); ++i) {
    if (!std::isfinite(boxes.mass[i])) continue;
    const Vec3 spin = state.orientation[i].conjugate() * state.angular_velocity[i];  // body axes
    energy += 0.5 * boxes.mass[i] * state.velocity[i].squaredNorm();
    energy += 0.5 * boxes.inertia[i].dot(spin.cwiseProduct(spin));
  }
  return energy;
}

double energy_gain(const Scene& scene, const Track& track) {
  const BoxColumns boxes = scene.batch().boxes;
  const double start = kinetic_energy(scene, track.front());
  double work = 0.0;
  double gain = 0.0;
  for (std::size_t i = 1; i < track.size(); ++i) {
    const Snapshot& before = track[i - 1];
    const Snapshot& after = track[i];
    // No step crosses a change of the acceleration: the value at its middle applies to the whole step.
    const Vec3 field =
        Vec3(0, 0, -scene.settings.gravity) - acceleration_at(scene.acceleration, 0.5 * (before.time + after.time));
    for (std::size_t k = 0; k < boxes.mass.size(); ++k)
      if (std::isfinite(boxes.mass[k])) work += boxes.mass[k] * field.dot(after.position[k] - before.position[k]);
    gain = std::max(gain, kinetic_energy(scene, after) - start - work);
  }
  return gain;
}

}  // namespace holdfast::internal
