#pragma once

#include <memory>
#include <vector>

#include <BulletDynamics/Dynamics/btDiscreteDynamicsWorld.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include "bullet/surface.hpp"
#include "core/model/settings.hpp"
#include "core/model/world.hpp"

namespace holdfast::internal {

/// The bodies of the container in a Bullet world.
class ContainerBody {
 public:
  ContainerBody() = default;
  ContainerBody(const ContainerBody&) = delete;
  ContainerBody& operator=(const ContainerBody&) = delete;
  virtual ~ContainerBody() = default;

  /// Sets the container's acceleration, m/s²; called at every change.
  /// @return acceleration by external forces on every box in Bullet's world, m/s²
  virtual btVector3 set_acceleration(const Vec3& acceleration) = 0;

  /// Called before every step, after the forces of Bullet's world are cleared.
  virtual void push() {}

  /// Pose and velocities of the container's frame in Bullet's world.
  struct Frame {
    btTransform world_from_container = btTransform::getIdentity();
    btVector3 velocity = {0, 0, 0};          ///< of the frame's origin, m/s
    btVector3 angular_velocity = {0, 0, 0};  ///< rad/s
  };
  virtual Frame frame() const { return {}; }
};

/// The container at rest in its own frame: a static box for each side that is not open and for the ground, with the
/// index in `kPushedNames` as its user index, thick enough that no box passes through it in a step. Boxes feel the
/// effective gravity g − a(t).
/// @param load has the friction of the container's surfaces; it must outlive the container
std::unique_ptr<ContainerBody> make_prescribed_container(btDiscreteDynamicsWorld& world, const Settings& settings,
                                                         const World& load);

/// The container of StableCargo (Ramos et al.): one free compound body of six panels on a ground with friction. The
/// force (container + cargo mass) a(t) acts at its centre of mass; no other force drives the boxes.
/// @param load       as above
/// @param cargo_mass of all boxes, kg
std::unique_ptr<ContainerBody> make_free_container(btDiscreteDynamicsWorld& world, const Settings& settings,
                                                   const World& load, double cargo_mass);

}  // namespace holdfast::internal
