#include "io/results/results_schema.hpp"

#include <cassert>

namespace holdfast::internal {

namespace {

constexpr std::array<DatasetSpec, kDatasetCount> kTable = {{
    // inputs
    {"/inputs/layouts/name", ElementType::text, 1, Axis::layouts, "none", "file name of the layout"},
    {"/inputs/layouts/sha256", ElementType::text, 1, Axis::layouts, "none",
     "SHA-256 of the layout file's bytes, hexadecimal"},
    {"/inputs/layouts/header", ElementType::text, 1, Axis::layouts, "none", "first line of the layout file, as it is"},
    {"/inputs/layouts/box_begin", ElementType::u64, 1, Axis::layouts, "1",
     "first box of the layout: row of corner_min, corner_max and material"},
    {"/inputs/layouts/box_count", ElementType::u32, 1, Axis::layouts, "1",
     "boxes of the layout; 0 when it could not be used"},
    {"/inputs/layouts/corner_min", ElementType::f64, 3, Axis::layout_boxes, "m",
     "corner of the box with the smallest x, y, z as loaded, container frame (z up)"},
    {"/inputs/layouts/corner_max", ElementType::f64, 3, Axis::layout_boxes, "m",
     "corner of the box with the largest x, y, z as loaded"},
    {"/inputs/layouts/material", ElementType::i32, 1, Axis::layout_boxes, "1",
     "material id of the box in the layout file"},
    {"/inputs/accelerations/name", ElementType::text, 1, Axis::accelerations, "none",
     "file name of the acceleration, or norm, direction and size"},
    {"/inputs/accelerations/sha256", ElementType::text, 1, Axis::accelerations, "none",
     "SHA-256, hexadecimal, of the acceleration file's bytes; without a file, of its numbers"},
    {"/inputs/accelerations/segment_begin", ElementType::u64, 1, Axis::accelerations, "1",
     "first segment: row of start, duration and value"},
    {"/inputs/accelerations/segment_count", ElementType::u32, 1, Axis::accelerations, "1",
     "segments of the acceleration; 0 when it could not be used"},
    {"/inputs/accelerations/start", ElementType::f64, 1, Axis::segments, "s", "start of the segment"},
    {"/inputs/accelerations/duration", ElementType::f64, 1, Axis::segments, "s", "duration of the segment"},
    {"/inputs/accelerations/value", ElementType::f64, 3, Axis::segments, "m/s2",
     "acceleration of the container x, y, z in the segment; zero outside all segments"},
    // margins: one row per layout, one column per direction in which the load is pushed
    {"/margins/margin", ElementType::f64, kDirectionCount, Axis::layouts, "g",
     "largest constant acceleration that the layout stands, towards the front, the rear, the left and the right; "
     "negative: it does not stand under gravity alone; NaN if it is not known",
     Origin::recorded, Analysis::margins},
    {"/margins/critical_box", ElementType::u32, kDirectionCount, Axis::layouts, "1",
     "box that goes first above the margin: position in the layout file, from 1; 0: none up to 1.5 g", Origin::recorded,
     Analysis::margins},
    {"/margins/trials", ElementType::u32, 1, Axis::layouts, "1", "accelerations that were tried to find the margins",
     Origin::recorded, Analysis::margins},
    {"/margins/cpu_seconds", ElementType::f64, 1, Axis::layouts, "s", "processor time to find the margins",
     Origin::recorded, Analysis::margins},
    // margin_spread: one row per layout, one column per direction in which the load is pushed
    {"/margin_spread/low", ElementType::f64, kDirectionCount, Axis::layouts, "g",
     "margin in each direction that 5 % of the layout's replicas do not reach; NaN if it is not known, as the next two",
     Origin::recorded, Analysis::margin_spread},
    {"/margin_spread/median", ElementType::f64, kDirectionCount, Axis::layouts, "g", "margin that half of them reach",
     Origin::recorded, Analysis::margin_spread},
    {"/margin_spread/high", ElementType::f64, kDirectionCount, Axis::layouts, "g", "margin that 5 % of them reach",
     Origin::recorded, Analysis::margin_spread},
    {"/margin_spread/cpu_seconds", ElementType::f64, 1, Axis::layouts, "s", "processor time to find them",
     Origin::recorded, Analysis::margin_spread},
    // indicators: one row per layout, and one per box of a layout
    {"/indicators/centre_of_gravity", ElementType::f64, 3, Axis::layouts, "m",
     "x, y, z of the load's centre of gravity as loaded, container frame; NaN if the layout could not be used, as all",
     Origin::recorded, Analysis::indicators},
    {"/indicators/centre_offset", ElementType::f64, 3, Axis::layouts, "1",
     "from the middle of the container to the centre of gravity, over the container's inner size: -0.5 to 0.5",
     Origin::recorded, Analysis::indicators},
    {"/indicators/fill", ElementType::f64, 1, Axis::layouts, "1", "volume of the boxes over that of the container",
     Origin::recorded, Analysis::indicators},
    {"/indicators/badly_based", ElementType::f64, 1, Axis::layouts, "1",
     "share of the boxes with base_support below 0.75", Origin::recorded, Analysis::indicators},
    {"/indicators/badly_braced", ElementType::f64, 1, Axis::layouts, "1",
     "share of the boxes with fewer than 3 supported_sides", Origin::recorded, Analysis::indicators},
    {"/indicators/base_support", ElementType::f32, 1, Axis::layout_boxes, "1",
     "share of the box's bottom face on the floor or on other boxes, within 1 mm; rows as in /inputs/layouts/material",
     Origin::recorded, Analysis::indicators},
    {"/indicators/supported_sides", ElementType::u8, 1, Axis::layout_boxes, "1",
     "how many of its four sides touch a wall or another box, within 1 cm", Origin::recorded, Analysis::indicators},
    // replicas: one row per world, and one per box
    {"/replicas/count", ElementType::u32, 1, Axis::worlds, "1",
     "replicas of the world whose end is known; 0 when it was not simulated", Origin::recorded, Analysis::replicas},
    {"/replicas/failed", ElementType::u32, 1, Axis::worlds, "1",
     "those of them in which a box fell, moved or tilted, or was unstable", Origin::recorded, Analysis::replicas},
    {"/replicas/share", ElementType::f64, 1, Axis::worlds, "1", "failed / count; NaN without replicas, as the next two",
     Origin::recorded, Analysis::replicas},
    {"/replicas/wilson_low", ElementType::f64, 1, Axis::worlds, "1", "low end of the share's Wilson interval of 95 %",
     Origin::recorded, Analysis::replicas},
    {"/replicas/wilson_high", ElementType::f64, 1, Axis::worlds, "1", "high end of the interval", Origin::recorded,
     Analysis::replicas},
    {"/replicas/verdict", ElementType::u8, 1, Axis::worlds, "1",
     "0 none (no replicas), 1 holds (wilson_high is below 0.125), 2 fails (wilson_low is above 0.5), 3 uncertain",
     Origin::recorded, Analysis::replicas},
    {"/replicas/simulated", ElementType::u32, 1, Axis::worlds, "1",
     "worlds that were simulated for this: 1 where the load rests with the least friction of all replicas",
     Origin::recorded, Analysis::replicas},
    {"/replicas/cpu_seconds", ElementType::f64, 1, Axis::worlds, "s", "processor time to simulate them",
     Origin::recorded, Analysis::replicas},
    {"/replicas/box_share", ElementType::f32, 1, Axis::boxes, "1",
     "share of the replicas in which the box fell, moved or tilted, or was unstable; rows as in /boxes",
     Origin::recorded, Analysis::replicas},
    // worlds: one row per (layout, acceleration) pair
    {"/worlds/layout", ElementType::u64, 1, Axis::worlds, "1", "index of the layout: row of /inputs/layouts"},
    {"/worlds/acceleration", ElementType::u64, 1, Axis::worlds, "1",
     "index of the acceleration: row of /inputs/accelerations"},
    {"/worlds/status", ElementType::u32, 1, Axis::worlds, "1",
     "what went wrong, one bit per cause; 0: nothing; the bits are listed in docs/results_file.md"},
    {"/worlds/status_text", ElementType::text, 1, Axis::worlds, "none", "an explanation if the status is not 0"},
    {"/worlds/stop_reason", ElementType::u8, 1, Axis::worlds, "1",
     "why the world ended: 0 not run, 1 timeout, 2 sleeping, 3 failed, 4 decided (by StopWhen)"},
    {"/worlds/box_begin", ElementType::u64, 1, Axis::worlds, "1",
     "first box of the world: row of /boxes and /summary/boxes"},
    {"/worlds/box_count", ElementType::u32, 1, Axis::worlds, "1", "boxes of the world; 0 when it was not run"},
    {"/worlds/sample_begin", ElementType::u64, 1, Axis::worlds, "1",
     "first sample of the world: entry of /series/time and the other datasets with one entry per sample"},
    {"/worlds/sample_count", ElementType::u32, 1, Axis::worlds, "1", "samples of the world; 0 without series"},
    {"/worlds/row_begin", ElementType::u64, 1, Axis::worlds, "1",
     "first row of the world in /series/displacement and the other datasets with one entry per sample and box: "
     "row = row_begin + sample * box_count + box"},
    {"/worlds/end_time", ElementType::f64, 1, Axis::worlds, "s", "simulated time at which the world ended"},
    {"/worlds/steps", ElementType::u64, 1, Axis::worlds, "1", "steps that the simulated time is divided into"},
    {"/worlds/steps_skipped", ElementType::u64, 1, Axis::worlds, "1",
     "those of them that were not computed, because all islands were in static equilibrium"},
    {"/worlds/solve_iterations", ElementType::u64, 1, Axis::worlds, "1",
     "iterations of the contact solver over all steps"},
    {"/worlds/max_residual", ElementType::f64, 1, Axis::worlds, "m/s",
     "largest change of a contact's velocity in the last iteration of a step, in the step in which it is largest "
     "relative to residual_scale"},
    {"/worlds/residual_scale", ElementType::f64, 1, Axis::worlds, "m/s",
     "velocity added in that step: the norm of g - a (native) or g (others), times the step; 0 if there is no "
     "residual"},
    {"/worlds/max_penetration", ElementType::f64, 1, Axis::worlds, "m",
     "largest penetration of a box into another or a side, over all steps; 0 if the engine does not measure it"},
    {"/worlds/peak_total_kinetic_energy", ElementType::f64, 1, Axis::worlds, "J",
     "largest kinetic energy of all boxes together, over all steps"},
    {"/worlds/cpu_seconds", ElementType::f64, 1, Axis::worlds, "s", "processor time to build and simulate the world"},
    {"/worlds/state_hash", ElementType::u64, 1, Axis::worlds, "1",
     "hash of the bits of the final state: equal results have equal hashes"},
    {"/worlds/engine", ElementType::text, 1, Axis::worlds, "none", "name of the engine"},
    // boxes: one row per box, world by world
    {"/boxes/world", ElementType::u64, 1, Axis::boxes, "1", "world of the box: row of /worlds"},
    {"/boxes/id", ElementType::u32, 1, Axis::boxes, "1", "position among the boxes of the layout file, from 1"},
    {"/boxes/material", ElementType::i32, 1, Axis::boxes, "1", "material id of the layout file"},
    {"/boxes/mass", ElementType::f32, 1, Axis::boxes, "kg", "mass"},
    {"/boxes/size", ElementType::f32, 3, Axis::boxes, "m", "edge lengths along x, y, z as loaded"},
    {"/boxes/initial_position", ElementType::f32, 3, Axis::boxes, "m",
     "centre of mass as loaded, container frame (z up)"},
    {"/boxes/end_displacement", ElementType::f32, 3, Axis::boxes, "m",
     "displacement x, y, z of the centre of mass from the reference pose, at the end"},
    {"/boxes/end_tilt", ElementType::f32, 1, Axis::boxes, "degree",
     "angle of the rotation from the reference pose, at the end"},
    {"/boxes/end_kinetic_energy", ElementType::f32, 1, Axis::boxes, "J",
     "kinetic energy in the container's frame, at the end"},
    {"/boxes/peak_displacement", ElementType::f32, 1, Axis::boxes, "m",
     "largest length of the displacement, over all steps"},
    {"/boxes/peak_kinetic_energy", ElementType::f32, 1, Axis::boxes, "J", "largest kinetic energy, over all steps"},
    {"/boxes/settling_displacement", ElementType::f32, 3, Axis::boxes, "m",
     "displacement x, y, z while settling under gravity alone, before t = 0"},
    // series: world by world; within a world sample by sample, and within a sample box by box
    {"/series/time", ElementType::f64, 1, Axis::samples, "s", "time of the sample"},
    {"/series/container_acceleration", ElementType::f32, 3, Axis::samples, "m/s2",
     "acceleration of the container; at a breakpoint the value before it, and the mean of a step where resampled"},
    {"/series/total_kinetic_energy", ElementType::f32, 1, Axis::samples, "J", "kinetic energy of all boxes together"},
    {"/series/fallen_count", ElementType::u32, 1, Axis::samples, "1",
     "boxes lower than in the reference pose by more than the drop threshold of the run"},
    {"/series/displacement", ElementType::f32, 3, Axis::rows, "m",
     "displacement x, y, z of the centre of mass from the reference pose"},
    {"/series/orientation", ElementType::f32, 4, Axis::rows, "1",
     "unit quaternion w, x, y, z that rotates from the box's axes to the container's"},
    {"/series/angular_velocity", ElementType::f32, 3, Axis::rows, "rad/s", "angular velocity x, y, z"},
    {"/series/linear_acceleration", ElementType::f32, 3, Axis::rows, "m/s2",
     "acceleration x, y, z in the container's frame, mean over the last step"},
    {"/series/force", ElementType::f32, 3, Axis::rows, "N",
     "external force x, y, z: minus mass times the container's acceleration; zero in a free container"},
    {"/series/kinetic_energy", ElementType::f32, 1, Axis::rows, "J", "kinetic energy in the container's frame"},
    // walls: one row per world or sample; one column or vector per side
    {"/walls/peak_force", ElementType::f64, kSideCount, Axis::worlds, "N",
     "largest outward force of the boxes on the floor, front, rear, left, right and roof, mean over a step; NaN in a "
     "world that was not simulated",
     Origin::recorded, Analysis::wall_forces},
    {"/walls/peak_time", ElementType::f64, kSideCount, Axis::worlds, "s", "start of the step with that force",
     Origin::recorded, Analysis::wall_forces},
    {"/walls/peak_point", ElementType::f64, 3 * kSideCount, Axis::worlds, "m",
     "x, y, z of the centre of pressure in that step, side by side; NaN where nothing pressed the side",
     Origin::recorded, Analysis::wall_forces},
    {"/walls/lasting_force", ElementType::f64, kSideCount, Axis::worlds, "N",
     "largest outward force, mean over 0.05 s: what counts against a limit", Origin::recorded, Analysis::wall_forces},
    {"/walls/limit", ElementType::f64, kSideCount, Axis::worlds, "N",
     "test force of the norm that the run was asked for; NaN where there is none", Origin::recorded,
     Analysis::wall_forces},
    {"/walls/impulse", ElementType::f64, 3 * kSideCount, Axis::worlds, "N*s",
     "x, y, z of the impulse of the boxes on the side from t = 0 to the end, side by side", Origin::recorded,
     Analysis::wall_forces},
    {"/walls/force", ElementType::f32, kSideCount, Axis::samples, "N",
     "outward force, mean over the step that the sample lies in; 0 at t = 0", Origin::recorded, Analysis::wall_forces},
    // damage: one row per world, and one per box
    {"/damage/boxes_beyond", ElementType::u32, 1, Axis::worlds, "1",
     "boxes beyond the damage boundary of the settings; 4294967295 in a world that was not simulated", Origin::recorded,
     Analysis::damage},
    {"/damage/peak_acceleration", ElementType::f32, 1, Axis::boxes, "m/s2",
     "largest acceleration of the centre of mass in a frame at rest, mean over DamageWindow; rows as in /boxes",
     Origin::recorded, Analysis::damage},
    {"/damage/velocity_change", ElementType::f32, 1, Axis::boxes, "m/s",
     "largest change of its velocity in an impact; 0: no impact", Origin::recorded, Analysis::damage},
    {"/damage/beyond", ElementType::u8, 1, Axis::boxes, "1",
     "1 when peak_acceleration and velocity_change are both above the damage boundary, else 0", Origin::recorded,
     Analysis::damage},
    // summary: derived from the tables above with the thresholds in the attributes of /summary
    {"/summary/worlds/verdict", ElementType::u8, 1, Axis::worlds, "1",
     "the worst that happened: 0 stayed, 1 moved, 2 fell, 3 unstable (before any acceleration), 4 failed, 5 gave_way "
     "(ended early by StopWhen), 6 not_needed (left out by FirstFailure)",
     Origin::derived},
    {"/summary/worlds/fallen_boxes", ElementType::u32, 1, Axis::worlds, "1", "boxes that had fallen at the end",
     Origin::derived},
    {"/summary/worlds/unstable_boxes", ElementType::u32, 1, Axis::worlds, "1",
     "boxes that fell or moved while settling, before any acceleration", Origin::derived},
    {"/summary/worlds/moved_boxes", ElementType::u32, 1, Axis::worlds, "1",
     "boxes displaced by more than the move threshold at the end", Origin::derived},
    {"/summary/worlds/tilted_boxes", ElementType::u32, 1, Axis::worlds, "1",
     "boxes rotated by more than the tilt threshold at the end", Origin::derived},
    {"/summary/worlds/total_kinetic_energy", ElementType::f64, 1, Axis::worlds, "J",
     "kinetic energy of all boxes together at the end", Origin::derived},
    {"/summary/worlds/peak_kinetic_energy", ElementType::f64, 1, Axis::worlds, "J",
     "largest kinetic energy of all boxes together, over all steps", Origin::derived},
    {"/summary/worlds/max_displacement", ElementType::f32, 1, Axis::worlds, "m",
     "largest displacement of a box at the end", Origin::derived},
    {"/summary/worlds/peak_displacement", ElementType::f32, 1, Axis::worlds, "m",
     "largest displacement of a box, over all steps", Origin::derived},
    {"/summary/boxes/displacement", ElementType::f32, 3, Axis::boxes, "m",
     "displacement x, y, z of the centre of mass at the end", Origin::derived},
    {"/summary/boxes/max_displacement", ElementType::f32, 1, Axis::boxes, "m",
     "largest length of the displacement, over all steps", Origin::derived},
    {"/summary/boxes/drop", ElementType::f32, 1, Axis::boxes, "m",
     "how much lower the centre of mass is at the end; negative: higher", Origin::derived},
    {"/summary/boxes/tilt", ElementType::f32, 1, Axis::boxes, "degree", "angle of the rotation at the end",
     Origin::derived},
    {"/summary/boxes/kinetic_energy", ElementType::f32, 1, Axis::boxes, "J", "kinetic energy at the end",
     Origin::derived},
    {"/summary/boxes/peak_kinetic_energy", ElementType::f32, 1, Axis::boxes, "J",
     "largest kinetic energy, over all steps", Origin::derived},
    {"/summary/boxes/fallen", ElementType::u8, 1, Axis::boxes, "1", "1 when drop exceeds the drop threshold, else 0",
     Origin::derived},
    {"/summary/boxes/moved", ElementType::u8, 1, Axis::boxes, "1",
     "1 when the displacement at the end is longer than the move threshold, else 0", Origin::derived},
    {"/summary/boxes/tilted", ElementType::u8, 1, Axis::boxes, "1", "1 when tilt exceeds the tilt threshold, else 0",
     Origin::derived},
    {"/summary/boxes/unstable", ElementType::u8, 1, Axis::boxes, "1",
     "1 when the box fell or moved while settling, else 0", Origin::derived},
    {"/summary/boxes/first_move_time", ElementType::f32, 1, Axis::boxes, "s",
     "time of the first sample with a displacement longer than the move threshold; NaN if there is none, or without "
     "series",
     Origin::derived},
}};

}  // namespace

constexpr std::array<DatasetSpec, kDatasetCount> kSchema = kTable;

std::string_view to_string(Axis axis) {
  constexpr std::array<std::string_view, kAxisCount> kNames = {"worlds",  "boxes",        "samples",       "rows",
                                                               "layouts", "layout_boxes", "accelerations", "segments"};
  return kNames.at(static_cast<std::size_t>(axis));
}

std::size_t size_of(ElementType type) {
  constexpr std::array<std::size_t, 7> kSizes = {1, 4, 8, 4, 4, 8, 0};
  return kSizes.at(static_cast<std::size_t>(type));
}

std::string_view to_string(ElementType type) {
  constexpr std::array<std::string_view, 7> kNames = {"uint8",   "uint32",  "uint64", "int32",
                                                      "float32", "float64", "text"};
  return kNames.at(static_cast<std::size_t>(type));
}

std::size_t dataset_index(std::string_view path) {
  for (std::size_t i = 0; i < kSchema.size(); ++i)
    if (kSchema[i].path == path) return i;
  assert(false && "the path is in the schema");
  return 0;
}

const DatasetSpec& representative(Axis axis) {
  return *std::find_if(kSchema.begin(), kSchema.end(), [&](const DatasetSpec& spec) {
    return spec.axis == axis && spec.analysis == Analysis::verdicts;
  });
}

const std::array<std::size_t, kLongDatasets>& long_datasets() {
  static const std::array<std::size_t, kLongDatasets> kPlaces = [] {
    std::array<std::size_t, kLongDatasets> places{};
    std::size_t count = 0;
    for (std::size_t i = 0; i < kSchema.size(); ++i)
      if (is_long(kSchema[i])) places.at(count++) = i;
    assert(count == kLongDatasets);
    return places;
  }();
  return kPlaces;
}

}  // namespace holdfast::internal
