#include "outcomes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>

namespace py = pybind11;

namespace holdfast::python {

namespace {

/// A row of the table of verdicts.
struct WorldRow {
  std::uint64_t layout, acceleration;
  std::uint8_t verdict, stop_reason;
  std::uint32_t status, boxes, fallen, moved, tilted, unstable;
  float max_displacement, peak_displacement;
  double total_kinetic_energy, peak_kinetic_energy, end_time;
  std::uint64_t steps, steps_skipped;
  double max_residual, residual_scale, max_penetration, cpu_seconds;
  std::uint64_t state_hash;
  std::uint8_t replica_verdict;
  std::uint32_t replicas, replicas_failed;
  double wilson_low, wilson_high;
  double wall_floor, wall_front, wall_rear, wall_left, wall_right, wall_roof, wall_share;
  std::uint32_t boxes_beyond;
  float peak_acceleration, velocity_change;
};

/// A row of the table of a layout's boxes.
struct BoxRow {
  std::array<float, 3> displacement;
  float tilt, kinetic_energy, peak_displacement, peak_kinetic_energy;
  bool fallen, moved, tilted, unstable;
  float peak_acceleration, velocity_change;
  bool beyond;
};

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr float kUnknownFloat = std::numeric_limits<float>::quiet_NaN();

/// The lasting force on a side, N.
double force_on(const WorldOutcome& world, std::size_t side) {
  return side < world.walls.size() ? world.walls[side].lasting_force : kUnknown;
}

/// The largest share of a limit that a side has to bear.
double wall_share(const WorldOutcome& world) {
  double largest = kUnknown;
  for (const WallForce& wall : world.walls) largest = std::fmax(largest, wall.lasting_force / wall.limit);
  return largest;
}

WorldRow row_of(const WorldOutcome& world) {
  return {.layout = world.layout,
          .acceleration = world.acceleration,
          .verdict = static_cast<std::uint8_t>(world.verdict),
          .stop_reason = static_cast<std::uint8_t>(world.stop_reason),
          .status = world.status,
          .boxes = world.boxes,
          .fallen = world.fallen,
          .moved = world.moved,
          .tilted = world.tilted,
          .unstable = world.unstable,
          .max_displacement = world.max_displacement,
          .peak_displacement = world.peak_displacement,
          .total_kinetic_energy = world.total_kinetic_energy,
          .peak_kinetic_energy = world.peak_kinetic_energy,
          .end_time = world.end_time,
          .steps = world.steps,
          .steps_skipped = world.steps_skipped,
          .max_residual = world.max_residual,
          .residual_scale = world.residual_scale,
          .max_penetration = world.max_penetration,
          .cpu_seconds = world.cpu_seconds,
          .state_hash = world.state_hash,
          .replica_verdict = static_cast<std::uint8_t>(world.replicas.verdict),
          .replicas = world.replicas.count,
          .replicas_failed = world.replicas.failed,
          .wilson_low = world.replicas.wilson_low,
          .wilson_high = world.replicas.wilson_high,
          .wall_floor = force_on(world, 0),
          .wall_front = force_on(world, 1),
          .wall_rear = force_on(world, 2),
          .wall_left = force_on(world, 3),
          .wall_right = force_on(world, 4),
          .wall_roof = force_on(world, 5),
          .wall_share = wall_share(world),
          .boxes_beyond = world.damage.boxes_beyond,
          .peak_acceleration = world.damage.known ? world.damage.peak_acceleration : kUnknownFloat,
          .velocity_change = world.damage.known ? world.damage.velocity_change : kUnknownFloat};
}

BoxRow row_of(const WorldOutcome& world, std::size_t i) {
  const BoxOutcome& box = world.box_outcomes[i];
  const DamageOutcome& damage = world.damage;
  return {.displacement = box.displacement,
          .tilt = box.tilt,
          .kinetic_energy = box.kinetic_energy,
          .peak_displacement = box.peak_displacement,
          .peak_kinetic_energy = box.peak_kinetic_energy,
          .fallen = box.fallen,
          .moved = box.moved,
          .tilted = box.tilted,
          .unstable = box.unstable,
          .peak_acceleration = damage.known ? damage.box_peak_acceleration[i] : kUnknownFloat,
          .velocity_change = damage.known ? damage.box_velocity_change[i] : kUnknownFloat,
          .beyond = damage.known && damage.box_beyond[i] != 0};
}

/// An array in the memory of a vector, which lives as long as the array.
template <class Number, class Entry>
py::array_t<Number> array_in(std::vector<Entry>&& entries, std::vector<std::size_t> shape) {
  auto owner = std::make_unique<std::vector<Entry>>(std::move(entries));
  const auto* const data = reinterpret_cast<const Number*>(owner->data());
  const py::capsule capsule(owner.get(), [](void* vector) { delete static_cast<std::vector<Entry>*>(vector); });
  static_cast<void>(owner.release());  // is the capsule's now
  return py::array_t<Number>(std::move(shape), data, capsule);
}

}  // namespace

void declare_row_types() {
  PYBIND11_NUMPY_DTYPE(WorldRow, layout, acceleration, verdict, stop_reason, status, boxes, fallen, moved, tilted,
                       unstable, max_displacement, peak_displacement, total_kinetic_energy, peak_kinetic_energy,
                       end_time, steps, steps_skipped, max_residual, residual_scale, max_penetration, cpu_seconds,
                       state_hash, replica_verdict, replicas, replicas_failed, wilson_low, wilson_high, wall_floor,
                       wall_front, wall_rear, wall_left, wall_right, wall_roof, wall_share, boxes_beyond,
                       peak_acceleration, velocity_change);
  PYBIND11_NUMPY_DTYPE(BoxRow, displacement, tilt, kinetic_energy, peak_displacement, peak_kinetic_energy, fallen,
                       moved, tilted, unstable, peak_acceleration, velocity_change, beyond);
}

py::array table_of(std::span<const WorldOutcome> worlds, const std::vector<std::size_t>& shape) {
  py::array_t<WorldRow> table(shape);
  std::transform(worlds.begin(), worlds.end(), table.mutable_data(),
                 [](const WorldOutcome& world) { return row_of(world); });
  return table;
}

py::dict messages_of(std::span<const WorldOutcome> worlds) {
  py::dict messages;
  for (const WorldOutcome& world : worlds)
    if (!world.message.empty()) messages[py::make_tuple(world.layout, world.acceleration)] = world.message;
  return messages;
}

py::list boxes_of(std::span<const WorldOutcome> worlds, std::size_t accelerations) {
  py::list all;
  for (; worlds.size() >= accelerations; worlds = worlds.subspan(accelerations)) {
    const std::span<const WorldOutcome> of_layout = worlds.first(accelerations);
    std::size_t boxes = 0;  // the same in all that were simulated
    for (const WorldOutcome& world : of_layout) boxes = std::max(boxes, world.box_outcomes.size());
    py::array_t<BoxRow> table({accelerations, boxes});
    BoxRow* next = table.mutable_data();
    for (const WorldOutcome& world : of_layout) {
      for (std::size_t i = 0; i < boxes; ++i) *next++ = i < world.box_outcomes.size() ? row_of(world, i) : BoxRow{};
    }
    all.append(table);
  }
  return all;
}

py::tuple series_of(Series&& series, std::size_t boxes) {
  const std::size_t samples = series.time.size();
  return py::make_tuple(array_in<double>(std::move(series.time), {samples}),
                        array_in<float>(std::move(series.displacement), {samples, boxes, 3}),
                        array_in<float>(std::move(series.orientation), {samples, boxes, 4}),
                        array_in<float>(std::move(series.angular_velocity), {samples, boxes, 3}));
}

}  // namespace holdfast::python
