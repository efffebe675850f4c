#pragma once

/// What `holdfast::Screen` says of worlds, boxes and layouts; part of <holdfast/holdfast.hpp>, whose frame, units and
/// promise of compatibility hold here too.

#include <holdfast/outcome_fields.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace holdfast {

// The members of the types below are made of the rows of outcome_fields.h, which say what each one means.
#define HOLDFAST_CPP_NAME(name, c_name, code, sentence) name = (code),
#define HOLDFAST_CPP_u32(name) std::uint32_t name = 0;
#define HOLDFAST_CPP_u64(name) std::uint64_t name = 0;
#define HOLDFAST_CPP_hash(name) std::uint64_t name = 0;
#define HOLDFAST_CPP_f32(name) float name = 0;
#define HOLDFAST_CPP_f64(name) double name = 0;
#define HOLDFAST_CPP_time(name) double name = std::numeric_limits<double>::quiet_NaN();
#define HOLDFAST_CPP_vec3(name) std::array<float, 3> name = {};
#define HOLDFAST_CPP_flag(name) bool name = false;
#define HOLDFAST_CPP_text(name) std::string name;
#define HOLDFAST_CPP_status(name) std::uint32_t name = 0;
#define HOLDFAST_CPP_caveat(name) std::uint32_t name = 0;
#define HOLDFAST_CPP_verdict(name) Verdict name = Verdict::failed;
#define HOLDFAST_CPP_stop_reason(name) StopReason name = StopReason::not_run;
#define HOLDFAST_CPP_MEMBER(scope, type, name, dataset, label, since, unit, sentence) \
  HOLDFAST_IF_PUBLIC_##scope(HOLDFAST_CPP_##type(name))

/// What became of a world as a whole, by the worst that happened in it: HOLDFAST_VERDICTS.
enum class Verdict : std::uint8_t { HOLDFAST_VERDICTS(HOLDFAST_CPP_NAME) };

/// Bits of `WorldOutcome::status`, what went wrong with a world: HOLDFAST_STATUS_BITS.
namespace status {
enum Bit : std::uint32_t { ok = 0, HOLDFAST_STATUS_BITS(HOLDFAST_CPP_NAME) };
}  // namespace status

/// Bits of `WorldOutcome::caveats`, what has to be known beside the verdict: HOLDFAST_CAVEAT_BITS.
namespace caveat {
enum Bit : std::uint32_t { none = 0, HOLDFAST_CAVEAT_BITS(HOLDFAST_CPP_NAME) };
}  // namespace caveat

/// Why a world ended: HOLDFAST_STOP_REASONS.
enum class StopReason : std::uint8_t { HOLDFAST_STOP_REASONS(HOLDFAST_CPP_NAME) };

/// What the replicas of a world say of it: HOLDFAST_REPLICA_VERDICTS.
enum class ReplicaVerdict : std::uint8_t { HOLDFAST_REPLICA_VERDICTS(HOLDFAST_CPP_NAME) };

/// What became of one box: HOLDFAST_BOX_FIELDS and HOLDFAST_BOX_VERDICT_FIELDS.
struct BoxOutcome {
  HOLDFAST_BOX_FIELDS(HOLDFAST_CPP_MEMBER)
  HOLDFAST_BOX_VERDICT_FIELDS(HOLDFAST_CPP_MEMBER)
};

/// Time series of a world, one sample every `ResultsIntervalInSeconds`, and at the end. Columns of boxes hold sample
/// after sample: entry = sample * number of boxes + box.
struct Series {
  std::vector<double> time;                            ///< one per sample, s
  std::vector<std::array<float, 3>> displacement;      ///< per sample and box, of the centre of mass, m
  std::vector<std::array<float, 4>> orientation;       ///< per sample and box, quaternion w x y z, container from body
  std::vector<std::array<float, 3>> angular_velocity;  ///< per sample and box, rad/s
};

/// What the boxes did to a side of the container: docs/guide/walls.md. Forces are outwards; on fixed boxes the length.
struct WallForce {
  double peak_force = 0;                  ///< largest mean over a step, N
  double peak_time = 0;                   ///< start of that step, s
  std::array<double, 3> peak_point = {};  ///< centre of pressure then, m; not a number where nothing presses
  double lasting_force = 0;               ///< largest mean over 0.05 s, N
  double limit = 0;                       ///< test force of the norm `Walls`, N; not a number where there is none
  std::array<double, 3> impulse = {};     ///< from t = 0 to the end, N s
};

/// What became of the replicas of a world, with [Screening] Replicas: docs/guide/confidence.md.
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

/// What impacts did to the boxes of a world, with [Screening] Damage: docs/guide/damage.md.
struct DamageOutcome {
  bool known = false;              ///< it was asked for, and the world was accelerated
  std::uint32_t boxes_beyond = 0;  ///< boxes beyond the damage boundary
  float peak_acceleration = 0;     ///< largest of all boxes, mean over `DamageWindow`, m/s²
  float velocity_change = 0;       ///< largest of all boxes in an impact, m/s
  /// The same two per box, and whether both are above the damage boundary; with `ScreenOptions::keep_boxes`.
  std::vector<float> box_peak_acceleration;
  std::vector<float> box_velocity_change;
  std::vector<std::uint8_t> box_beyond;
};

/// A number that an analysis of [Screening] finds of a world, such as "boxes_beyond".
struct AnalysisNumber {
  std::string name;
  std::string type;      ///< as numpy names it: "u1", "u4", "f4", "f8"
  std::string sentence;  ///< its meaning and unit, and what it is where the analysis was not asked for
};

/// What became of a world, one layout under one acceleration: HOLDFAST_WORLD_FIELDS, and what the screen was asked for.
/// `layout` and `acceleration` are indices into the layouts of the call and the accelerations of the screen. In a world
/// that was not simulated, counts and measures are 0.
struct WorldOutcome {
  HOLDFAST_WORLD_FIELDS(HOLDFAST_CPP_MEMBER)
  std::vector<BoxOutcome> box_outcomes;  ///< one per box with `ScreenOptions::keep_boxes`, else empty
  /// Of floor, front, rear, left, right, roof, ground and the fixed boxes together; with `WallForces` or `Walls` of
  /// [Screening], else empty, also in a world that was not accelerated.
  std::vector<WallForce> walls;
  Series series;  ///< with `ScreenOptions::keep_series`, else empty
  ReplicaOutcome replicas;
  DamageOutcome damage;
  std::vector<double> numbers;  ///< of all analyses, in the order of `analysis_numbers`
};

/// Margins within the limits of the replicas of a layout, g, in the directions of `LayoutMargins`; not numbers without
/// replicas.
struct MarginSpread {
  std::array<double, 4> low = {};     ///< 5 % of the replicas stand less
  std::array<double, 4> median = {};  ///< half of them stand less
  std::array<double, 4> high = {};    ///< 95 % of them stand less
};

/// How many g a layout stands: docs/guide/margins.md. Entries are for the load pushed to the front, the rear, the left
/// and the right. A critical box is a position in the layout, from 1; 0: none goes beyond up to 1.5 g.
struct LayoutMargins {
  /// Largest constant acceleration, for as long as anything moves, under which every box stays in its place, within
  /// 5 mm, up to 1.5 g; negative where the layout is unstable under gravity alone, not a number where `Screen::cancel`
  /// came before.
  std::array<double, 4> margin = {};
  /// The box that leaves its place first above the margin.
  std::array<std::uint32_t, 4> critical_box = {};
  /// The same where every box stays within the limits of the verdict.
  std::array<double, 4> margin_within_limits = {};
  /// The box that is beyond a limit first above that margin.
  std::array<std::uint32_t, 4> critical_box_within_limits = {};
  std::uint32_t trials = 0;  ///< accelerations that were tried
  double cpu_seconds = 0;    ///< processor time, s; of the spread too
  MarginSpread spread;       ///< with `[Screening] Replicas`
};

/// What geometry alone says of a layout: docs/guide/indicators.md.
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
