#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "core/model/acceleration.hpp"
#include "core/model/settings.hpp"
#include "core/model/world.hpp"

namespace holdfast::internal {

/// Mass of a box that is fixed to the container: a ledge, a kerb, a step, an obstacle. Engines hold it still.
inline constexpr double kFixed = std::numeric_limits<double>::infinity();

/// A box of a scene, with a pose and velocities of its own. Container frame, SI.
struct SceneBox {
  Vec3 size = Vec3::Ones();                     ///< edge lengths, body axes, m
  Vec3 position = Vec3::Zero();                 ///< of the centroid, m
  Rotation orientation = Rotation::Identity();  ///< container_from_body
  Vec3 velocity = Vec3::Zero();                 ///< m/s
  Vec3 angular_velocity = Vec3::Zero();         ///< rad/s
  double mass = 0.0;                            ///< kg; 0: by the density of the scene's settings; kFixed: fixed
  std::optional<double> friction;               ///< of the surface, one side of a product; absent: the scene's settings
  std::optional<double> restitution;            ///< of the surface; absent: the scene's settings
};

/// A box that stands on the floor of its scene's container, or on a height: its size, where its lower corner of
/// least coordinates is.
SceneBox standing_box(const Vec3& size, const Vec3& corner_min);

/// A world that no layout file can describe: what known answers are measured on. Constant once made; engines never see
/// it, only the columns made of it.
struct Scene {
  Settings settings;  ///< container, contact laws, gravity; the solver's part is filled in by whoever runs it
  std::vector<SceneBox> boxes;
  Acceleration acceleration;
  /// Multiplies the step that the engine setting names: for twins whose time runs at another rate, and to see how an
  /// answer depends on the step.
  double step_factor = 1.0;

  /// Appends a stretch of constant acceleration of the container, m/s², at the end of the acceleration.
  Scene& then(double duration, const Vec3& value);

  /// The boxes in their order as columns that an engine takes, one world. The scene must outlive the batch.
  WorldBatch batch() const;

  /// Appends the scene to a batch, as its last world.
  void append_to(WorldBatch& batch) const;
};

/// An empty container of the given inner size, m, where every pair of surfaces has the friction coefficient `friction`
/// and the restitution `restitution`.
Scene empty_scene(const Vec3& container_size, double friction, double restitution = 0.0);

/// An empty container with a friction coefficient for each kind of pair: box and floor, box and box, box and wall.
Scene scene_of_pairs(const Vec3& container_size, double box_floor, double box_box, double box_wall,
                     double restitution = 0.0);

}  // namespace holdfast::internal
