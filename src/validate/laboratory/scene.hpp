#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/model/acceleration.hpp"
#include "core/model/settings.hpp"
#include "core/model/world.hpp"

namespace holdfast::internal {

/// Mass of a box that is fixed to the container: a ledge, a kerb, an obstacle. Engines do not move it.
inline constexpr double kFixed = std::numeric_limits<double>::infinity();

/// A box of a scene, with any pose and velocities. Container frame, SI units.
struct SceneBox {
  Vec3 size = Vec3::Ones();                     ///< edge lengths, body axes, m
  Vec3 position = Vec3::Zero();                 ///< of the centroid, m
  Rotation orientation = Rotation::Identity();  ///< container_from_body
  Vec3 velocity = Vec3::Zero();                 ///< m/s
  Vec3 angular_velocity = Vec3::Zero();         ///< rad/s
  double mass = 0.0;                            ///< kg; 0: from the density in the scene's settings; kFixed: fixed
  std::optional<double> friction;     ///< of the surface, one factor of a product; absent: from the scene's settings
  std::optional<double> restitution;  ///< of the surface; absent: from the scene's settings
  std::string material;               ///< in the table of pairs of materials of the scene's settings
  std::optional<double> mat;          ///< coefficient of an anti-slip mat beneath it
};

/// An upright box on the floor of its scene's container, or at a height, from its size and its corner with the smallest
/// coordinates.
SceneBox standing_box(const Vec3& size, const Vec3& corner_min);

/// A world for cases with known answers, which a layout file could not describe. It does not change after it is made;
/// engines get only the columns that are made from it.
struct Scene {
  Settings settings;  ///< container, contact laws, gravity; the laboratory adds those of the solver
  std::vector<SceneBox> boxes;
  Acceleration acceleration;
  /// Factor for the step of the engine setting: for scaled scenes, whose time is scaled too, and to measure how a
  /// result depends on the step.
  double step_factor = 1.0;

  /// Appends an interval of constant acceleration of the container, m/s², at the end of the acceleration.
  Scene& then(double duration, const Vec3& value);

  /// A batch with one world: the boxes as columns, in their order. The scene must outlive the batch.
  WorldBatch batch() const;

  /// Appends the scene to a batch, as its last world.
  void append_to(WorldBatch& batch) const;
};

/// An empty container of the given inner size, m, in which every pair of surfaces has the friction coefficient
/// `friction` and the coefficient of restitution `restitution`.
Scene empty_scene(const Vec3& container_size, double friction, double restitution = 0.0);

/// An empty container with a friction coefficient for each kind of pair: box and floor, box and box, box and wall.
Scene scene_of_pairs(const Vec3& container_size, double box_floor, double box_box, double box_wall,
                     double restitution = 0.0);

}  // namespace holdfast::internal
