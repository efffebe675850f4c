#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "analyses/walls/wall_forces.hpp"
#include "core/model/container_sides.hpp"
#include "core/reference/plain_contacts.hpp"
#include "io/input/layout_reader.hpp"
#include "io/input/text_file.hpp"
#include "random.hpp"
#include "same_bits.hpp"
#include "scenes.hpp"

/// What tests of an engine's physics measure, from outside the engine, and the scenes that they measure it on.
namespace holdfast::internal::physics {

/// A number as messages of tests show it: also where it is small.
inline std::string text(double number) { return fmt::format("{:.4g}", number); }

/// Box `i` as a solid.
inline plain::Block block_of(const WorldBatch& batch, std::size_t i) {
  plain::Block block;
  block.axes = batch.state.orientation[i].toRotationMatrix();
  block.half_extents = batch.boxes.half_extents[i];
  block.centre = batch.state.position[i] - block.axes * batch.boxes.centre_of_mass[i];
  return block;
}

/// Moments of inertia in the container's frame, kg m².
inline Eigen::Matrix3d inertia_of(const WorldBatch& batch, std::size_t i) {
  const Eigen::Matrix3d axes = batch.state.orientation[i].toRotationMatrix();
  return axes * batch.boxes.inertia[i].asDiagonal() * axes.transpose();
}

/// Energy of all boxes that can move, relative to the container, in the field of gravity and of what the container's
/// acceleration feels like, J.
inline double energy_of(const WorldBatch& batch, const Vec3& pull) {
  double energy = 0.0;
  for (std::size_t i = 0; i < batch.boxes.mass.size(); ++i) {
    if (std::isinf(batch.boxes.mass[i])) continue;
    const Vec3& spin = batch.state.angular_velocity[i];
    energy += batch.boxes.mass[i] * (0.5 * batch.state.velocity[i].squaredNorm() - pull.dot(batch.state.position[i])) +
              0.5 * spin.dot(inertia_of(batch, i) * spin);
  }
  return energy;
}

/// Mass of all boxes that can move, kg.
inline double mass_of(const WorldBatch& batch) {
  double mass = 0.0;
  for (const double m : batch.boxes.mass)
    if (!std::isinf(m)) mass += m;
  return mass;
}

/// How far the impulses on all sides are from what weight and change of momentum call for, over the weight of the time.
/// The run was asked for wall forces.
inline double imbalance(const Layout& layout, const Acceleration& acceleration, const Settings& settings,
                        const scenes::Run& run) {
  const Acceleration* const accelerations[] = {&acceleration};
  const WorldBatch batch = scenes::batch_of(std::span(&layout, 1), accelerations, settings);
  Vec3 field = Vec3(0, 0, -scenes::kGravity) * run.record.row.end_time;
  for (const Segment& segment : acceleration.segments) field -= segment.duration * segment.acceleration;
  Vec3 missing = Vec3::Zero();
  for (std::size_t i = 0; i < batch.boxes.mass.size(); ++i)
    if (!std::isinf(batch.boxes.mass[i])) missing += batch.boxes.mass[i] * (field - run.state.velocity[i]);
  for (const Vec3& of_side : run.record.found.get<WallForces>()->impulse) missing -= of_side;
  return missing.norm() / (mass_of(batch) * scenes::kGravity * run.record.row.end_time);
}

/// Deepest overlap, m: of any two boxes, of a box and a closed side.
struct Overlap {
  double of_boxes = 0.0;
  double with_side = 0.0;
};

inline Overlap overlap_of(const WorldBatch& batch, const ContainerSettings& container) {
  Overlap overlap;
  const std::size_t count = batch.boxes.mass.size();
  std::vector<plain::Block> blocks;
  std::vector<Vec3> reach;
  for (std::size_t i = 0; i < count; ++i) {
    blocks.push_back(block_of(batch, i));
    reach.emplace_back(blocks[i].axes.cwiseAbs() * blocks[i].half_extents);
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (std::isinf(batch.boxes.mass[i])) continue;
    for (const ContainerSide& side : closed_sides(container)) {
      const double inside = side.far ? container.size[side.axis] - blocks[i].centre[side.axis] - reach[i][side.axis]
                                     : blocks[i].centre[side.axis] - reach[i][side.axis];
      overlap.with_side = std::max(overlap.with_side, -inside);
    }
    for (std::size_t j = 0; j < count; ++j) {
      const bool counted = j < i && !std::isinf(batch.boxes.mass[j]);
      if (j == i || counted) continue;
      if (((blocks[i].centre - blocks[j].centre).cwiseAbs() - reach[i] - reach[j]).maxCoeff() > 0.0) continue;
      for (const plain::ContactPoint& point : plain::contact_points(blocks[i], blocks[j], 0.0))
        overlap.of_boxes = std::max(overlap.of_boxes, -point.gap);
    }
  }
  return overlap;
}

/// Takes one world through its motion, with a look at every step's end.
inline void watch(const Engine& engine, const Layout& layout, const Acceleration& acceleration,
                  const Settings& settings, const std::function<void(WorldBatch&)>& prepare,
                  const std::function<void(const WorldBatch&, const Phase&)>& look,
                  const std::function<void(const WorldBatch&, const Phase&)>& begin = {}) {
  const Acceleration* const accelerations[] = {&acceleration};
  WorldBatch batch = scenes::batch_of(std::span(&layout, 1), accelerations, settings);
  if (prepare) prepare(batch);
  const std::unique_ptr<Simulation> simulation = engine.build(batch);
  for (const Phase& phase : phases_of(acceleration, acceleration.end_time())) {
    if (begin) begin(batch, phase);
    for (double time = phase.begin; time < phase.end;) {
      time = scenes::advance(*simulation, 0, phase);
      simulation->read_back(0, batch.state);
      look(batch, phase);
    }
  }
}

/// Makes a box part of the container.
inline void fix(WorldBatch& batch, std::size_t i) {
  batch.boxes.mass[i] = std::numeric_limits<double>::infinity();
  batch.boxes.inertia[i].setConstant(std::numeric_limits<double>::infinity());
}

/// Names of the layouts that come with the program.
inline constexpr const char* kLayouts[] = {"BR0_012_block",        "BR15_077_ep",
                                           "BR15_077_wall",        "BR1_001_ep",
                                           "BR2_015_brick",        "BR5_020_layer_h60",
                                           "BR5_020_wall_h60",     "BR8_009_ep",
                                           "BR8_009_layer",        "BR8_009_layer_h60",
                                           "BR8_009_wall",         "BR8_009_wall_h60",
                                           "seed_example",         "unstable_BR15_077_bpjs",
                                           "unstable_BR2_007_bpjs"};

inline Layout bundled_layout(const std::string& name, const Settings& settings) {
  const Result<TextFile> file = read_text_file(HOLDFAST_SOURCE_DIR "/configs/layouts/" + name + ".txt");
  REQUIRE(file);
  std::vector<Error> warnings;
  Result<Layout> layout = parse_layout(*file, settings, warnings);
  REQUIRE(layout);
  return std::move(*layout);
}

/// A small container for random scenes.
inline Settings small_container(Accuracy accuracy) {
  Settings settings = scenes::at_once();
  settings.container.size = {2.4, 1.6, 12};
  settings.native.accuracy = accuracy;
  return settings;
}

/// Boxes of 0.2 to 0.8 m for `small_container`: columns of boxes with gaps between and above some of them, so that they
/// fall a little.
inline Layout random_layout(Random& random, std::uint32_t least = 6, std::uint32_t most = 15) {
  Layout layout = scenes::layout_of({});
  const std::uint32_t count = least + random.below(most - least + 1);
  constexpr double kColumn = 0.8;
  double height[3][2] = {};
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t x = random.below(3);
    const std::uint32_t y = random.below(2);
    const Vec3 size = random.vector(0.2, 0.79);
    const double left = random.between(0, 1);
    const double front = random.between(0, 1);
    // Some stand on the one below, some fall onto it.
    if (random.below(2) == 0) height[x][y] += random.between(0, 0.2);
    const Vec3 corner(kColumn * x + left * (kColumn - size.x()), kColumn * y + front * (kColumn - size.y()),
                      height[x][y]);
    height[x][y] += size.z();
    layout.boxes.push_back(scenes::box(corner, size));
  }
  return layout;
}

/// Three phases of random accelerations.
inline Acceleration random_acceleration(Random& random, double phase) {
  std::vector<std::pair<double, Vec3>> segments;
  for (int i = 0; i < 3; ++i) {
    const Vec3 direction = random.vector(-1, 1);
    segments.emplace_back(phase, Vec3(8 * direction.x(), 6 * direction.y(), direction.z()));
  }
  return scenes::acceleration_of(segments);
}

}  // namespace holdfast::internal::physics
