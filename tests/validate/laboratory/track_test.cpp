#include "validate/laboratory/track.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

namespace track_test {

using namespace holdfast::internal;

namespace {

constexpr double kGravity = 9.81;

Scene one_box() {
  Scene scene = empty_scene({8, 8, 8}, 0.5);
  scene.boxes.push_back(standing_box({1, 1, 1}, {3, 3, 1}));
  scene.then(10.0, Vec3::Zero());
  return scene;
}

/// A box thrown upwards with `speed`, sampled at unequal intervals.
Track thrown(const Scene& scene, double speed) {
  Track track;
  for (int i = 0; i < 20; ++i) {
    const double t = 0.03 * i + 0.004 * (i % 3);
    track.push_back({t,
                     {scene.boxes[0].position + Vec3(0, 0, speed * t - 0.5 * kGravity * t * t)},
                     {Rotation::Identity()},
                     {Vec3(0, 0, speed - kGravity * t)},
                     {Vec3::Zero()}});
  }
  return track;
}

}  // namespace

TEST_CASE("track: the peak of a flight is exact", "[validate]") {
  const Scene scene = one_box();
  const auto peaks = peaks_of(
      thrown(scene, 2.0), [](const Snapshot& s) { return s.position[0].z(); }, 0.0);
  REQUIRE(peaks.size() == 1);
  CHECK(peaks[0].time == Approx(2.0 / kGravity).epsilon(1e-12));
  CHECK(peaks[0].value == Approx(1.5 + 2.0 / kGravity).epsilon(1e-12));
}

TEST_CASE("track: free flight gains no energy, a velocity jump does", "[validate]") {
  const Scene scene = one_box();
  Track track = thrown(scene, 2.0);
  const double energy = kinetic_energy(scene, track.front());
  CHECK(energy == Approx(0.5 * 250.0 * 4.0).epsilon(1e-12));
  CHECK(energy_gain(scene, track) == Approx(0.0).margin(1e-9 * energy));
  const double height = track.back().position[0].z() - track.front().position[0].z();
  track.back().velocity[0] = {9, 0, 0};
  CHECK(energy_gain(scene, track) == Approx(0.5 * 250.0 * (81.0 - 4.0) + 250.0 * kGravity * height).epsilon(1e-12));
}

TEST_CASE("track: an arrival within a step is found from the remaining distance", "[validate]") {
  Track track;
  for (const double t : {0.0, 0.3, 0.6, 0.9}) {
    // Falls from 2 m; lands at √(4/g) = 0.6386 s.
    const bool landed = t > 0.6386;
    track.push_back({t,
                     {Vec3(0, 0, landed ? 0.0 : 2.0 - 0.5 * kGravity * t * t)},
                     {Rotation::Identity()},
                     {Vec3(0, 0, landed ? 0.0 : -kGravity * t)},
                     {Vec3::Zero()}});
  }
  const Arrival arrival = arrival_of(
      track, [](const Snapshot& s) { return s.position[0].z(); }, [](const Snapshot& s) { return -s.velocity[0].z(); },
      kGravity);
  CHECK(arrival.time == Approx(std::sqrt(4.0 / kGravity)).epsilon(1e-12));
  CHECK(arrival.speed == Approx(std::sqrt(4.0 * kGravity)).epsilon(1e-12));
}

TEST_CASE("track: the stop is found by constant deceleration from the last motion", "[validate]") {
  Track track;
  for (const double t : {0.0, 0.4, 0.8, 1.2}) {
    const double speed = std::max(0.0, 2.0 - 2.0 * t);
    track.push_back({t, {Vec3::Zero()}, {Rotation::Identity()}, {Vec3(speed, 0, 0)}, {Vec3::Zero()}});
  }
  CHECK(stop_time(track, 0, 2.0) == Approx(1.0).epsilon(1e-12));
}

}  // namespace track_test
