#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/vector.hpp"
#include "core/model/acceleration.hpp"
#include "core/model/contact_law.hpp"
#include "core/model/layout.hpp"
#include "core/model/settings.hpp"

namespace holdfast::internal {

/// Constant properties of boxes: one column per quantity, one entry per box.
struct BoxColumns {
  std::vector<Vec3> half_extents;    ///< m, body axes (those of the container at the layout's pose)
  std::vector<double> mass;          ///< kg; infinite, with infinite moments: fixed to the container
  std::vector<Vec3> inertia;         ///< principal moments about the centre of mass, body axes, kg m²
  std::vector<Vec3> centre_of_mass;  ///< offset from the centroid, body axes, m
  std::vector<Surface> surface;
  std::vector<int> material;  ///< its number; -1 where it has a name
};

/// State of boxes in the container's frame: one column per quantity, one entry per box.
struct StateColumns {
  std::vector<Vec3> position;          ///< of the centre of mass, m
  std::vector<Rotation> orientation;   ///< container_from_body
  std::vector<Vec3> velocity;          ///< of the centre of mass, m/s
  std::vector<Vec3> angular_velocity;  ///< rad/s
};

/// Calls `visit(name, columns...)` for every column, with that column of each of the given structures. Resizing,
/// hashing, copying and uploading all use these functions, so that a new column is included everywhere.
template <class Visit, class... Columns>
void for_each_box_column(Visit&& visit, Columns&&... c) {
  visit("half_extents", c.half_extents...);
  visit("mass", c.mass...);
  visit("inertia", c.inertia...);
  visit("centre_of_mass", c.centre_of_mass...);
  visit("surface", c.surface...);
  visit("material", c.material...);
}
template <class Visit, class... Columns>
void for_each_state_column(Visit&& visit, Columns&&... c) {
  visit("position", c.position...);
  visit("orientation", c.orientation...);
  visit("velocity", c.velocity...);
  visit("angular_velocity", c.angular_velocity...);
}

/// A layout under an acceleration: a range of the columns of its batch. The layout and the acceleration belong to the
/// caller. Worlds of one batch may differ in everything that is here and in the columns; engines take it from here, and
/// only what all worlds share from the settings.
struct World {
  const Layout* layout = nullptr;
  const Acceleration* acceleration = nullptr;
  std::size_t box_begin = 0;
  std::size_t box_count = 0;
  ContactSettings contact;
  ContainerSettings container;
};

/// Worlds that an engine gets together: one set of columns; each world is a range of it.
struct WorldBatch {
  BoxColumns boxes;
  StateColumns state;
  std::vector<World> worlds;
};

/// Adds a world: all boxes are at rest in the layout's pose. Masses and surfaces come from `settings`; moments of
/// inertia are those of a uniform box, I = m/12 (b² + c²), about the centre of mass.
void append_world(WorldBatch& batch, const Layout& layout, const Acceleration& acceleration, const Settings& settings);

/// One world per pair of `layouts` and `accelerations`, with the acceleration as the faster index.
WorldBatch make_batch(std::span<const Layout* const> layouts, std::span<const Acceleration* const> accelerations,
                      const Settings& settings);

/// State of one world, a view of a batch's columns.
struct StateView {
  std::span<const Vec3> position;          ///< m
  std::span<const Rotation> orientation;   ///< container_from_body
  std::span<const Vec3> velocity;          ///< m/s
  std::span<const Vec3> angular_velocity;  ///< rad/s
};

/// Constant properties of one world's boxes, a view of a batch's columns.
struct BoxView {
  std::span<const Vec3> half_extents;
  std::span<const double> mass;
  std::span<const Vec3> inertia;
  std::span<const Vec3> centre_of_mass;
  std::span<const Surface> surface;
  std::span<const int> material;
};

StateView view(const StateColumns& state, const World& world);
BoxView view(const BoxColumns& boxes, const World& world);

/// Hash of a world's state: of the bits of every column in the order of the columns (64-bit FNV-1a).
/// Equal states have equal hashes on every machine of the same byte order; −0 and 0 differ.
std::uint64_t state_hash(const StateView& state);

/// True when every number of the state is finite.
bool is_finite(const StateView& state);

}  // namespace holdfast::internal
