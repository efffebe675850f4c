#pragma once

#include <cstdint>
#include <vector>

#include "core/engine/engine.hpp"
#include "core/model/contact_law.hpp"
#include "core/model/world.hpp"
#include "core/native/collision/oriented_box.hpp"

namespace holdfast::internal::native {

/// What a body does in a step.
enum class Activity : std::uint8_t {
  fixed,    ///< is fixed to the container
  asleep,   ///< stays where it is as if it were fixed, see `SleepingBodies`
  resting,  ///< is proved to rest under the present g − a
  moving,   ///< is stepped
  ahead,    ///< has taken the whole step, of which others take halves
};

/// What a body's last step leaves for the next.
struct LastStep {
  Vec3 acceleration = Vec3::Zero();          ///< a guess for the next, m/s²
  Vec3 angular_acceleration = Vec3::Zero();  ///< likewise, rad/s²
  /// What the velocity that its solve has found lacks of the one that the impulses give the body, m/s and rad/s. The
  /// next step adds it. So momentum changes by impulses of Coulomb's law alone, over steps, and the residuals of solves
  /// do not add up: what slides comes as far as a friction of exactly μ times the normal force lets it.
  Vec3 missing_velocity = Vec3::Zero();
  Vec3 missing_angular_velocity = Vec3::Zero();
};

/// The boxes of one world: one column per quantity, one entry per box, in the container's frame. They are in the order
/// of their first positions, so that results do not depend on the order in which a layout lists them.
struct Bodies {
  std::vector<std::uint32_t> world_box;  ///< index of the body among the world's boxes
  std::vector<double> mass;              ///< kg; infinite: fixed to the container
  std::vector<Vec3> principal_inertia;   ///< about the centre of mass, body axes, kg m²
  std::vector<Vec3> centre_of_mass;      ///< from the centroid, body axes, m
  std::vector<double> radius;            ///< from the centre of mass to the farthest corner, m
  std::vector<Surface> surface;
  std::vector<Activity> activity;
  std::vector<BoxForce> pushed;  ///< from outside
  StateColumns state;
  std::vector<OrientedBox> shape;  ///< the box at `state`
  std::vector<LastStep> last_step;

  std::size_t count() const { return mass.size(); }

  /// Whether a body does this, by body: 1 or 0.
  std::vector<std::uint8_t> marked(Activity what) const;
  bool any(Activity what) const;

  /// Torque of the force from outside about the centre of mass, container frame, N m.
  Vec3 torque(std::size_t body) const { return Vec3(shape[body].axes * pushed[body].at).cross(pushed[body].force); }

  /// Inertia in the container's frame, kg m².
  Mat3 inertia(std::size_t body) const;

  /// No point of the body moves faster than this about its centre of mass, m/s.
  double largest_rotational_speed(std::size_t body) const { return radius[body] * state.angular_velocity[body].norm(); }

  /// No point of the body moves faster than this, m/s.
  double largest_speed(std::size_t body) const { return state.velocity[body].norm() + largest_rotational_speed(body); }

  /// Takes its velocity from a body, and what its last step leaves.
  void stop(std::size_t body);

  /// Brings the shape to the state's position and orientation.
  void update_shape(std::size_t body);
};

/// The bodies of a world, at the state of the batch.
Bodies bodies_of(const WorldBatch& batch, const World& world);

}  // namespace holdfast::internal::native
