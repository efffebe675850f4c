#pragma once

#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btDefaultCollisionConfiguration.h>
#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletDynamics/Dynamics/btDiscreteDynamicsWorld.h>

#include <memory>
#include <vector>

#include "bullet/bullet_preset.hpp"
#include "bullet/container_body.hpp"
#include "bullet/measuring_solver.hpp"
#include "core/engine/engine.hpp"
#include "core/model/world.hpp"

namespace holdfast::internal {

/// One container world as bodies of Bullet, with all objects of Bullet that worlds must not share.
class BulletWorld {
 public:
  /// The columns of the batch give the poses at the start.
  BulletWorld(const WorldBatch& batch, const World& world, const Settings& settings, const BulletPreset& preset);
  ~BulletWorld();
  BulletWorld(const BulletWorld&) = delete;
  BulletWorld& operator=(const BulletWorld&) = delete;

  /// Takes the next step within the phase. Returns the time reached, s.
  double advance(const Phase& phase);

  /// Writes the world's range of the columns. A body that Bullet has not moved has exactly its given position, in
  /// either precision.
  void read_back(StateColumns& state) const;

  const Counters& counters() const { return counters_; }

  /// Of the boxes on the sides in the last step, where the settings ask for wall forces and the container does not
  /// move.
  const SideImpulses& side_impulses() const { return side_impulses_; }

 private:
  struct BoxBody {
    BodySurface surface;
    std::unique_ptr<btBoxShape> shape;
    std::unique_ptr<btCompoundShape> offset_shape;  ///< only when the centre of mass is not the centroid
    std::unique_ptr<btRigidBody> body;
    Vec3 start_position;         ///< as given, m
    Vec3 bullet_start_position;  ///< as Bullet rounded it, m
  };

  void add_box(const WorldBatch& batch, std::size_t box);
  void measure_sides();
  void set_acceleration(const Vec3& acceleration);

  const World& world_;
  const Settings& settings_;
  BulletPreset preset_;

  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  btDbvtBroadphase broadphase_;
  MeasuringSolver solver_;
  btDiscreteDynamicsWorld dynamics_;
  std::unique_ptr<ContainerBody> container_;
  std::vector<BoxBody> boxes_;

  double phase_begin_;            ///< start of the phase whose acceleration is set, s
  std::uint64_t phase_step_ = 0;  ///< steps taken in that phase
  bool phase_set_ = false;
  Vec3 acceleration_ = Vec3::Zero();
  SideImpulses side_impulses_;
  Counters counters_;
};

}  // namespace holdfast::internal
