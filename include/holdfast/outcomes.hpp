#pragma once

/// What `holdfast::Screen` says of worlds, boxes and layouts; part of <holdfast/holdfast.hpp>, whose frame, units and
/// promise of compatibility hold here too.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace holdfast {

/// What became of a world as a whole, by the worst that happened in it.
enum class Verdict : std::uint8_t {
  stayed = 0,      ///< no box fell, moved or tilted, nor was any unstable
  moved = 1,       ///< a box moved or tilted at the end, and none fell
  fell = 2,        ///< a box had fallen at the end
  unstable = 3,    ///< a box fell or moved while settling, before any acceleration, and all stayed since
  failed = 4,      ///< `WorldOutcome::status` is not 0: nothing can be said
  gave_way = 5,    ///< with `ScreenOptions::stop_when`: a box left its place, and the world ended there
  not_needed = 6,  ///< with `ScreenOptions::first_failure`: the layout failed another acceleration; not simulated
};

/// Bits of `WorldOutcome::status`: what went wrong with a world.
namespace status {
enum Bit : std::uint32_t {
  ok = 0,
  bad_layout = 1,        ///< the layout cannot be used; not simulated
  bad_acceleration = 2,  ///< the acceleration cannot be used; not simulated
  non_finite = 4,        ///< a state became infinite or undefined
  not_converged = 8,     ///< the solver's residual stayed above its bound
  capacity = 16,         ///< a device had no room for all contacts, or failed
  too_large = 32,        ///< its series would take too much memory; not simulated
  not_needed = 64,       ///< with `ScreenOptions::first_failure`: no problem, see `Verdict::not_needed`
};
}  // namespace status

/// Why a world ended.
enum class StopReason : std::uint8_t {
  not_run = 0,   ///< it was not simulated: a bad input, or `Screen::cancel`
  timeout = 1,   ///< the simulated time was up
  sleeping = 2,  ///< all boxes had come to rest
  failed = 3,    ///< the status says why
  decided = 4,   ///< with `ScreenOptions::stop_when`: the verdict is `Verdict::gave_way`
};

/// How one box ended. The reference pose is that of the layout, or by `ReferencePose` the one after settling.
struct BoxOutcome {
  std::array<float, 3> displacement = {};  ///< of the centre of mass, from the reference pose, at the end, m
  float tilt = 0;                          ///< angle of the rotation from the reference pose, at the end, degrees
  float kinetic_energy = 0;                ///< at the end, J
  float peak_displacement = 0;             ///< largest over all steps, m
  float peak_kinetic_energy = 0;           ///< largest over all steps, J
  bool fallen = false;                     ///< its centre of mass sank by more than `DropThreshold`
  bool moved = false;                      ///< displaced by more than `MoveThreshold`
  bool tilted = false;                     ///< rotated by more than `TiltThreshold`
  bool unstable = false;                   ///< fell or moved while settling
};

/// Time series of a world, one sample every `ResultsIntervalInSeconds`, and at the end. Columns of boxes hold sample
/// after sample: entry = sample * number of boxes + box.
struct Series {
  std::vector<double> time;                            ///< one per sample, s
  std::vector<std::array<float, 3>> displacement;      ///< per sample and box, of the centre of mass, m
  std::vector<std::array<float, 4>> orientation;       ///< per sample and box, quaternion w x y z, container from body
  std::vector<std::array<float, 3>> angular_velocity;  ///< per sample and box, rad/s
};

/// What the boxes did to a side of the container: docs/walls.md. Forces are outwards.
struct WallForce {
  double peak_force = 0;                  ///< largest mean over a step, N
  double peak_time = 0;                   ///< start of that step, s
  std::array<double, 3> peak_point = {};  ///< centre of pressure then, m; not a number where nothing presses
  double lasting_force = 0;               ///< largest mean over 0.05 s, N
  double limit = 0;                       ///< test force of the norm `Walls`, N; not a number where there is none
  std::array<double, 3> impulse = {};     ///< from t = 0 to the end, N s
};

/// What the replicas of a world say of it.
enum class ReplicaVerdict : std::uint8_t {
  none = 0,       ///< there are no replicas
  holds = 1,      ///< the share that fails is surely below 1/8
  fails = 2,      ///< it is surely above 1/2
  uncertain = 3,  ///< neither
};

/// What became of the replicas of a world, with [Screening] Replicas: docs/confidence.md.
struct ReplicaOutcome {
  ReplicaVerdict verdict = ReplicaVerdict::none;
  std::uint32_t count = 0;   ///< of the replicas whose end is known
  std::uint32_t failed = 0;  ///< of these, those in which a box fell, moved or tilted, or was unstable
  double share = 0;          ///< failed / count; not a number without replicas, as the next two
  double wilson_low = 0;     ///< ends of the interval in which the share is at 95 %
  double wilson_high = 0;
  double cpu_seconds = 0;        ///< processor time for all of them, s
  std::vector<float> box_share;  ///< per box, share of the replicas in which it did, with `ScreenOptions::keep_boxes`
};

/// What impacts did to the boxes of a world, with [Screening] Damage: docs/damage.md.
struct DamageOutcome {
  bool known = false;              ///< it was asked for, and the world was simulated
  std::uint32_t boxes_beyond = 0;  ///< boxes beyond the damage boundary
  float peak_acceleration = 0;     ///< largest of all boxes, mean over `DamageWindow`, m/s²
  float velocity_change = 0;       ///< largest of all boxes in an impact, m/s
  /// The same two per box, and whether both are above the damage boundary; with `ScreenOptions::keep_boxes`.
  std::vector<float> box_peak_acceleration;
  std::vector<float> box_velocity_change;
  std::vector<std::uint8_t> box_beyond;
};

/// What became of a world: one layout under one acceleration.
struct WorldOutcome {
  std::size_t layout = 0;        ///< index into the layouts of the call
  std::size_t acceleration = 0;  ///< index into the accelerations of the screen
  Verdict verdict = Verdict::failed;
  std::uint32_t status = status::ok;  ///< bits, see `status`
  std::string message;                ///< what the status means here, and what to do; empty when it is `ok`
  StopReason stop_reason = StopReason::not_run;
  std::uint32_t boxes = 0;   ///< number of boxes; 0 in a world that was not simulated, as are all that follow
  std::uint32_t fallen = 0;  ///< number of boxes, as are the next three
  std::uint32_t moved = 0;
  std::uint32_t tilted = 0;
  std::uint32_t unstable = 0;
  float max_displacement = 0;            ///< largest of all boxes at the end, m
  float peak_displacement = 0;           ///< largest of all boxes and steps, m
  double total_kinetic_energy = 0;       ///< at the end, J
  double peak_kinetic_energy = 0;        ///< of all boxes together, largest over all steps, J
  double end_time = 0;                   ///< s
  std::uint64_t steps = 0;               ///< steps that the simulated time was cut into
  std::uint64_t steps_skipped = 0;       ///< of these, those in which nothing moves, which are not computed
  double max_residual = 0;               ///< change of a contact velocity in a last iteration, worst step, m/s
  double residual_scale = 0;             ///< velocity that the effective gravity adds in that step, m/s
  double max_penetration = 0;            ///< deepest overlap of any step, m; 0 where the engine does not measure it
  double cpu_seconds = 0;                ///< processor time of building and simulating, s
  std::uint64_t state_hash = 0;          ///< of the final poses and velocities: equal bits, equal hash
  std::vector<BoxOutcome> box_outcomes;  ///< one per box with `ScreenOptions::keep_boxes`, else empty
  /// Of floor, front, rear, left, right, roof; with `WallForces` or `Walls` of [Screening], else empty.
  std::vector<WallForce> walls;
  Series series;  ///< with `ScreenOptions::keep_series`, else empty
  ReplicaOutcome replicas;
  DamageOutcome damage;
};

/// Margins of the replicas of a layout, g, in the directions of `LayoutMargins`; not numbers without replicas.
struct MarginSpread {
  std::array<double, 4> low = {};     ///< 5 % of the replicas stand less
  std::array<double, 4> median = {};  ///< half of them stand less
  std::array<double, 4> high = {};    ///< 95 % of them stand less
};

/// How many g a layout stands: docs/margins.md. Entries are for the load pushed to the front, the rear, the left and
/// the right.
struct LayoutMargins {
  /// Largest constant acceleration under which all boxes come to rest displaced by less than 5 mm, up to 1.5 g;
  /// negative where the layout does not stand under gravity alone, not a number where `Screen::cancel` came before.
  std::array<double, 4> margin = {};
  /// Index of the box that goes first above the margin; -1: none up to 1.5 g.
  std::array<std::ptrdiff_t, 4> critical_box = {-1, -1, -1, -1};
  std::uint32_t trials = 0;  ///< accelerations that were tried
  double cpu_seconds = 0;    ///< processor time, s; of the spread too
  MarginSpread spread;       ///< with `[Screening] Replicas`
};

/// What geometry alone says of a layout: docs/indicators.md.
struct LayoutIndicators {
  std::array<double, 3> centre_of_gravity = {};  ///< m
  /// From the middle of the container to the centre of gravity, over the container's inner size: -0.5 to 0.5.
  std::array<double, 3> centre_offset = {};
  double fill = 0;                            ///< volume of the boxes over that of the container
  double badly_based = 0;                     ///< share of the boxes with `base_support` below 0.75
  double badly_braced = 0;                    ///< share of the boxes with fewer than 3 `supported_sides`
  std::vector<float> base_support;            ///< per box, share of its bottom face on the floor or on other boxes
  std::vector<std::uint8_t> supported_sides;  ///< per box, how many of its four sides touch a wall or a box
};

}  // namespace holdfast
