#include "core/model/world.hpp"

#include <limits>

#include "core/base/byte_hash.hpp"
#include "core/model/container_sides.hpp"

namespace holdfast::internal {

namespace {

/// A fixed box as boxes meet it. What is on it stands where it stands; beside it and beneath it is the least play.
Box with_play(Box fixed) {
  const Vec3 play = (0.25 * (fixed.corner_max - fixed.corner_min)).cwiseMin(kLeastPlay);
  fixed.corner_min += play;
  fixed.corner_max.head<2>() -= play.head<2>();
  return fixed;
}

void append_box(WorldBatch& batch, const Box& given, const Settings& settings) {
  const BoxProperties properties = properties_of(settings, given);
  const Box box = properties.fixed ? with_play(given) : given;
  const Vec3 size = box.corner_max - box.corner_min;
  const double mass = properties.fixed ? std::numeric_limits<double>::infinity() : properties.mass;
  const Vec3 square = size.cwiseProduct(size);
  const FrictionTable& pairs = settings.contact.materials;

  BoxColumns& boxes = batch.boxes;
  boxes.half_extents.push_back(0.5 * size);
  boxes.mass.push_back(mass);
  boxes.inertia.push_back(mass / 12.0 *
                          Vec3(square.y() + square.z(), square.z() + square.x(), square.x() + square.y()));
  boxes.centre_of_mass.push_back(properties.centre_of_mass);
  boxes.surface.push_back({.kind = SurfaceKind::box,
                           .friction = properties.friction,
                           .restitution = properties.restitution,
                           .material = pairs.empty() ? FrictionTable::kOther : pairs.index_of(box.material.text()),
                           .mat = box.mat});
  boxes.material.push_back(box.material.id());

  StateColumns& state = batch.state;
  state.position.emplace_back(0.5 * (box.corner_min + box.corner_max) + properties.centre_of_mass);
  state.orientation.emplace_back(Rotation::Identity());
  state.velocity.emplace_back(Vec3::Zero());
  state.angular_velocity.emplace_back(Vec3::Zero());
}

/// The numbers in one entry of a column.
std::span<const double, 3> numbers(const Vec3& v) { return std::span<const double, 3>(v.data(), 3); }
std::span<const double, 4> numbers(const Rotation& q) { return std::span<const double, 4>(q.coeffs().data(), 4); }

template <class Visit>
void for_each_number(const StateView& state, Visit visit) {
  for_each_state_column(
      [&](const char*, const auto& column) {
        for (const auto& entry : column)
          for (const double number : numbers(entry)) visit(number);
      },
      state);
}

}  // namespace

void append_world(WorldBatch& batch, const Layout& layout, const Acceleration& acceleration, const Settings& settings) {
  batch.worlds.push_back({&layout, &acceleration, batch.state.position.size(), layout.boxes.size(), settings.contact,
                          container_of(settings, layout)});
  for (const Box& box : layout.boxes) append_box(batch, box, settings);
}

WorldBatch make_batch(std::span<const Layout* const> layouts, std::span<const Acceleration* const> accelerations,
                      const Settings& settings) {
  WorldBatch batch;
  for (const Layout* layout : layouts)
    for (const Acceleration* acceleration : accelerations) append_world(batch, *layout, *acceleration, settings);
  return batch;
}

StateView view(const StateColumns& state, const World& world) {
  const auto part = [&](const auto& column) { return std::span(column).subspan(world.box_begin, world.box_count); };
  return {part(state.position), part(state.orientation), part(state.velocity), part(state.angular_velocity)};
}

BoxView view(const BoxColumns& boxes, const World& world) {
  const auto part = [&](const auto& column) { return std::span(column).subspan(world.box_begin, world.box_count); };
  return {part(boxes.half_extents),   part(boxes.mass),    part(boxes.inertia),
          part(boxes.centre_of_mass), part(boxes.surface), part(boxes.material)};
}

std::uint64_t state_hash(const StateView& state) {
  ByteHash hash;
  for_each_number(state, [&](double number) { hash.add(&number, sizeof number); });
  return hash.value();
}

bool is_finite(const StateView& state) {
  bool finite = true;
  for_each_number(state, [&](double number) { finite = finite && std::isfinite(number); });
  return finite;
}

}  // namespace holdfast::internal
