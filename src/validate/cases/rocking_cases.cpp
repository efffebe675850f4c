#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "validate/answers/rocking.hpp"
#include "validate/cases/rebound_cases.hpp"
#include "validate/laboratory/track.hpp"

namespace holdfast::internal {

namespace {

using enum ToleranceClass;

const Vec3 kContainer = {16, 8, 4};

/// Smaller tilts do not count as peaks, rad.
constexpr double kNoise = 1e-3;

/// Angle about y, rad, for a box that rotates about y only.
double tilt_of(const Snapshot& state) {
  const Rotation& q = state.orientation[0];
  const double angle = 2.0 * std::atan2(q.y(), q.w());
  return std::remainder(angle, 2.0 * M_PI);
}

/// The largest tilt of each half cycle, alternating between the sides.
std::vector<Peak> swings_of(const Track& track) {
  std::vector<Peak> swings;
  double side = 1.0;  // the motion begins on the positive side, at its largest tilt
  for (const Peak& peak : peaks_of(
           track, [](const Snapshot& state) { return std::abs(tilt_of(state)); }, kNoise)) {
    const auto at = std::find_if(track.begin(), track.end(), [&](const Snapshot& s) { return s.time >= peak.time; });
    const double now = std::copysign(1.0, tilt_of(*at));
    if (now != side)
      swings.push_back(peak);
    else if (!swings.empty() && peak.value > swings.back().value)
      swings.back() = peak;
    side = now;
  }
  return swings;
}

/// Time at which the box first stands flat, s: from the last end of a step before it, and then as a pendulum.
double first_impact(const Track& track, const RockingBlock& block) {
  const double acceleration = block.frequency * block.frequency * std::sin(block.slenderness);
  for (std::size_t i = 1; i < track.size(); ++i) {
    if (tilt_of(track[i]) > 0.0) continue;
    const double left = tilt_of(track[i - 1]);
    const double speed = -track[i - 1].angular_velocity[0].y();
    return track[i - 1].time + 2.0 * left / (speed + std::sqrt(speed * speed + 2.0 * acceleration * left));
  }
  return std::numeric_limits<double>::infinity();
}

/// A box released at rest from a tilt rocks on its edges without restitution or sliding (Housner 1963). Between impacts
/// it is a pendulum; each impact multiplies its angular velocity by 1 − (3/2) sin²α.
std::vector<Measurement> rocking(Laboratory& laboratory, double width, double height, double share) {
  Scene scene = empty_scene(kContainer, 1.0);
  const double gravity = scene.settings.gravity;
  const RockingBlock block = rocking_block(width, height, gravity);
  const double tilt = share * block.slenderness;
  SceneBox box;
  box.size = {width, 0.5, height};
  box.orientation = Rotation(Eigen::AngleAxisd(tilt, Eigen::Vector3d::UnitY()));
  // The lower edge, at +x, is on the floor.
  box.position = Vec3(8.0, 4.0, 0.0) - box.orientation * Vec3(0.5 * width, 0.0, -0.5 * height);
  scene.boxes.push_back(box);
  const int last = 5;
  scene.then(peak_time(block, tilt, last) + 0.1, Vec3::Zero());
  const Track track = track_of(laboratory, scene);
  const std::vector<Peak> peaks = swings_of(track);
  std::vector<Measurement> measurements = {
      relative("time of the first impact (s)", first_impact(track, block), quarter_period(block, tilt), good)};
  for (const int n : {1, 2, last}) {
    const auto i = static_cast<std::size_t>(n - 1);
    const Peak peak = i < peaks.size() ? peaks[i] : Peak{};
    measurements.push_back(
        relative(fmt::format("tilt of peak {} (rad)", n), peak.value, peak_tilt(block, tilt, n), good));
    measurements.push_back(relative(fmt::format("time of peak {} (s)", n), peak.time, peak_time(block, tilt, n), good));
  }
  const double lift = block.half_diagonal * (std::cos(block.slenderness - tilt) - std::cos(block.slenderness));
  const double energy = scene.batch().boxes.mass[0] * gravity * lift;
  measurements.push_back(scaled("energy gained (share)", energy_gain(scene, track) / energy, 0.0, 1.0, fine));
  return measurements;
}

/// A box slides without friction against a kerb lower than its centre of mass; kerb and floor are without friction. The
/// impact conserves the angular momentum about the upper edge of the kerb: there the kerb pushes, and it is vertically
/// above the lower front edge, where the floor pushes. With H = h/2 − k:
///   ω = v H / K,  K = l²/4 + H² + (l² + h²)/12
/// Both contacts remain (the front edge slides back on the floor, the face up and down the kerb) and do no work:
///   R cos(α − θ) = h/2 + ½ K ω² / g at the largest tilt θ; the box overturns if this exceeds R.
/// With enough friction the box would pivot about the edge of the kerb; this needs a friction coefficient above 3.
std::vector<Measurement> trip(Laboratory& laboratory, double kerb, double share) {
  const double length = 0.5;
  const double height = 1.0;
  Scene scene = empty_scene(kContainer, 0.0);
  const double gravity = scene.settings.gravity;
  const double lever = 0.5 * height - kerb;
  const double inertia = 0.25 * length * length + lever * lever + (length * length + height * height) / 12.0;  // K
  const double half_diagonal = 0.5 * std::hypot(length, height);
  const double slenderness = std::atan2(length, height);
  const double critical = std::sqrt(2.0 * gravity * (half_diagonal - 0.5 * height) * inertia) / lever;
  const double speed = share * critical;
  const double spin = speed * lever / inertia;

  const double gap = 0.1037;
  SceneBox obstacle = standing_box({1.0, 2.0, kerb}, {4.0, 3.0, 0});
  obstacle.mass = kFixed;
  SceneBox box = standing_box({length, 0.5, height}, {4.0 - gap - length, 3.75, 0});
  box.velocity = {speed, 0, 0};
  scene.boxes = {box, obstacle};
  scene.then(gap / speed + 1.5, Vec3::Zero());
  const Track track = track_of(laboratory, scene);
  double largest = 0.0;
  for (const Snapshot& state : track) largest = std::max(largest, turn_of(state.orientation[0]));
  const bool falls = share > 1.0;
  std::vector<Measurement> measurements = {
      holdfast::internal::verdict("falls over", largest > slenderness + 0.1, falls)};
  const double energy = 0.5 * scene.batch().boxes.mass[0] * speed * speed;
  if (!falls) {
    const std::vector<Peak> peaks = peaks_of(track, tilt_of, kNoise);
    const Peak peak = peaks.empty() ? Peak{} : peaks.front();
    const double expected =
        slenderness - std::acos((0.5 * height + 0.5 * inertia * spin * spin / gravity) / half_diagonal);
    measurements.push_back(relative("highest tilt (rad)", peak.value, expected, good));
  }
  measurements.push_back(scaled("energy gained (share)", energy_gain(scene, track) / energy, 0.0, 1.0, fine));
  return measurements;
}

}  // namespace

std::vector<Case> rocking_cases() {
  std::vector<Case> cases;
  struct Block {
    double width;
    double height;
    double share;
  };
  for (const Block b : {Block{0.25, 1.0, 0.5}, Block{0.25, 1.0, 0.9}, Block{0.4, 1.0, 0.5}})
    cases.push_back(
        {"rebound", fmt::format("rocking_{}_by_{}_from_{}", b.width, b.height, b.share),
         fmt::format("a box {} m wide and {} m high rocks from {} of its tipping angle", b.width, b.height, b.share),
         "impacts not located in time; energy of position correction", b.share == 0.5,
         [=](Laboratory& laboratory) { return rocking(laboratory, b.width, b.height, b.share); }});
  for (const double kerb : {0.1, 0.2})
    for (const double share : {0.5, 0.8, 0.95, 0.99, 1.01, 1.05})
      cases.push_back(
          {"rebound", fmt::format("kerb_{}_at_{}", kerb, share),
           fmt::format("a box slides against a kerb {} m high at {} of the speed that overturns it", kerb, share),
           "a kerb treated as a full wall", share == 0.8 || share == 1.05,
           [=](Laboratory& laboratory) { return trip(laboratory, kerb, share); }});
  return cases;
}

}  // namespace holdfast::internal
