#pragma once

#include <memory>
#include <vector>

#include <BulletDynamics/Dynamics/btDiscreteDynamicsWorld.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include "bullet/surface.hpp"
#include "core/model/settings.hpp"

namespace holdfast::internal {

/// The container inside a Bullet world: where the boxes are, and what holds them.
class ContainerBody {
 public:
  ContainerBody() = default;
  ContainerBody(const ContainerBody&) = delete;
  ContainerBody& operator=(const ContainerBody&) = delete;
  virtual ~ContainerBody() = default;

  /// Takes the container's acceleration, m/s²; called at every change.
  /// @return what every box feels, m/s² in Bullet's world
  virtual btVector3 set_acceleration(const Vec3& acceleration) = 0;

  /// Called before every step, with forces of Bullet's world cleared.
  virtual void push() {}

  /// Pose and velocities of the container's frame in Bullet's world.
  struct Frame {
    btTransform world_from_container = btTransform::getIdentity();
    btVector3 velocity = {0, 0, 0};          ///< of the frame's origin, m/s
    btVector3 angular_velocity = {0, 0, 0};  ///< rad/s
  };
  virtual Frame frame() const { return {}; }
};

/// The container at rest in its own frame: six static boxes (less the open sides), thick enough that nothing
/// passes through in a step. Boxes feel gravity minus a(t).
std::unique_ptr<ContainerBody> make_prescribed_container(btDiscreteDynamicsWorld& world, const Settings& settings);

/// The container as the tool of Ramos et al. had it: one free compound of six panels on a ground with friction,
/// pushed by the force (container + cargo mass) a(t) at its centre of mass; nothing else drives the boxes.
/// @param cargo_mass of all boxes, kg
std::unique_ptr<ContainerBody> make_free_container(btDiscreteDynamicsWorld& world, const Settings& settings,
                                                   double cargo_mass);

}  // namespace holdfast::internal
