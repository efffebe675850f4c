#include "bullet/bullet_world.hpp"

#include <cmath>

#include "bullet/bullet_number.hpp"
#include "core/engine/step_plan.hpp"

namespace holdfast::internal {

namespace {

/// Memory pools sized for the number of boxes: Bullet's default takes megabytes per world. When a pool is full, Bullet
/// uses the heap, with the same results.
btDefaultCollisionConstructionInfo pool_sizes(std::size_t box_count) {
  btDefaultCollisionConstructionInfo info;
  const int manifolds = static_cast<int>(16 * box_count + 64);
  info.m_defaultMaxPersistentManifoldPoolSize = manifolds;
  info.m_defaultMaxCollisionAlgorithmPoolSize = manifolds;
  return info;
}

void apply(const BulletPreset& preset, btContactSolverInfo& info) {
  info.m_numIterations = preset.iterations;
  if (preset.friction_directions == 2) info.m_solverMode |= SOLVER_USE_2_FRICTION_DIRECTIONS;
  if (preset.random_order) info.m_solverMode |= SOLVER_RANDMIZE_ORDER;
  info.m_splitImpulse = preset.split_impulse ? 1 : 0;
  info.m_splitImpulsePenetrationThreshold = to_bullet(preset.split_impulse_threshold);
  info.m_erp = to_bullet(preset.erp);
  info.m_erp2 = to_bullet(preset.erp2);
  info.m_warmstartingFactor = to_bullet(preset.warm_start);
  info.m_linearSlop = to_bullet(preset.linear_slop);
  info.m_restitutionVelocityThreshold = to_bullet(preset.restitution_velocity);
}

}  // namespace

BulletWorld::BulletWorld(const WorldBatch& batch, const World& world, const Settings& settings,
                         const BulletPreset& preset)
    : world_(world),
      settings_(settings),
      preset_(preset),
      configuration_(pool_sizes(world.box_count)),
      dispatcher_(&configuration_),
      dynamics_(&dispatcher_, &broadphase_, &solver_, &configuration_),
      phase_begin_(0.0) {
  apply(preset, dynamics_.getSolverInfo());
  double cargo_mass = 0.0;
  for (const double mass : view(batch.boxes, world).mass)
    if (std::isfinite(mass)) cargo_mass += mass;
  container_ = settings.container.motion == ContainerMotion::free
                   ? make_free_container(dynamics_, settings, world, cargo_mass)
                   : make_prescribed_container(dynamics_, settings, world);
  boxes_.reserve(world.box_count);
  for (std::size_t i = 0; i < world.box_count; ++i) add_box(batch, world.box_begin + i);
}

BulletWorld::~BulletWorld() {
  for (BoxBody& box : boxes_) dynamics_.removeRigidBody(box.body.get());
}

void BulletWorld::add_box(const WorldBatch& batch, std::size_t i) {
  BoxBody& box = boxes_.emplace_back();
  box.surface = {batch.boxes.surface[i], &world_.contact};
  box.shape = std::make_unique<btBoxShape>(to_bullet(batch.boxes.half_extents[i]));
  btCollisionShape* shape = box.shape.get();
  const Vec3& centre_of_mass = batch.boxes.centre_of_mass[i];
  if (!centre_of_mass.isZero(0.0)) {
    box.offset_shape = std::make_unique<btCompoundShape>(false, 1);
    box.offset_shape->addChildShape(btTransform(btQuaternion::getIdentity(), to_bullet(Vec3(-centre_of_mass))), shape);
    shape = box.offset_shape.get();
  }
  // In Bullet a mass of zero means a fixed body.
  const bool fixed = !std::isfinite(batch.boxes.mass[i]);
  box.body = std::make_unique<btRigidBody>(to_bullet(fixed ? 0.0 : batch.boxes.mass[i]), nullptr, shape,
                                           to_bullet(fixed ? Vec3(Vec3::Zero()) : batch.boxes.inertia[i]));

  const Rotation& q = batch.state.orientation[i];
  box.start_position = batch.state.position[i];
  box.body->setWorldTransform(
      btTransform(btQuaternion(to_bullet(q.x()), to_bullet(q.y()), to_bullet(q.z()), to_bullet(q.w())),
                  to_bullet(box.start_position)));
  box.bullet_start_position = from_bullet(box.body->getWorldTransform().getOrigin());
  box.body->setLinearVelocity(to_bullet(batch.state.velocity[i]));
  box.body->setAngularVelocity(to_bullet(batch.state.angular_velocity[i]));
  box.body->setUserPointer(&box.surface);
  if (box.surface.mat) notice_mat(*box.body);
  if (fixed) box.body->setUserIndex(static_cast<int>(kFixedBoxes));
  if (preset_.sleeping == BulletSleeping::off && !fixed) box.body->setActivationState(DISABLE_DEACTIVATION);
  dynamics_.addRigidBody(box.body.get());
}

void BulletWorld::set_acceleration(const Vec3& acceleration) {
  const btVector3 field = container_->set_acceleration(acceleration);
  for (BoxBody& box : boxes_) {
    // The change would not wake a sleeping body.
    box.body->activate(true);
    box.body->setGravity(field);
  }
}

/// Sums the impulses that the solver has applied in the step, as it leaves them at the contact points. Those that push
/// bodies apart without changing velocities are not among them.
void BulletWorld::measure_sides() {
  side_impulses_ = {};
  for (int i = 0; i < dispatcher_.getNumManifolds(); ++i) {
    const btPersistentManifold& manifold = *dispatcher_.getManifoldByIndexInternal(i);
    const bool side_is_first = manifold.getBody0()->getUserIndex() >= 0;
    const btCollisionObject& side = side_is_first ? *manifold.getBody0() : *manifold.getBody1();
    if (side.getUserIndex() < 0) continue;
    for (int j = 0; j < manifold.getNumContacts(); ++j) {
      const btManifoldPoint& point = manifold.getContactPoint(j);
      const btVector3 on_first = point.m_appliedImpulse * point.m_normalWorldOnB +
                                 point.m_appliedImpulseLateral1 * point.m_lateralFrictionDir1 +
                                 point.m_appliedImpulseLateral2 * point.m_lateralFrictionDir2;
      add_contact(side_impulses_, static_cast<std::size_t>(side.getUserIndex()),
                  from_bullet(side_is_first ? on_first : -on_first),
                  from_bullet(side_is_first ? point.getPositionWorldOnA() : point.getPositionWorldOnB()));
    }
  }
}

double BulletWorld::advance(const Phase& phase) {
  if (!phase_set_ || phase.begin != phase_begin_) {
    if (!phase_set_ || phase.acceleration != acceleration_) set_acceleration(phase.acceleration);
    acceleration_ = phase.acceleration;
    phase_begin_ = phase.begin;
    phase_step_ = 0;
    phase_set_ = true;
  }
  const StepPlan plan(phase, preset_.steps_per_second);
  container_->push();
  dynamics_.stepSimulation(to_bullet(plan.step()), 0);

  if (settings_.screening.measures_walls()) measure_sides();

  ++counters_.steps;
  counters_.solve_iterations = solver_.iterations();
  const double residual = solver_.take_residual();
  const double gained = settings_.gravity * plan.step();
  if (gained > 0.0) counters_.note_residual(residual, gained);
  return plan.end_of(phase_step_++);
}

void BulletWorld::read_back(StateColumns& state) const {
  const bool moving_container = settings_.container.motion == ContainerMotion::free;
  const ContainerBody::Frame frame = container_->frame();
  const btMatrix3x3 container_from_world = frame.world_from_container.getBasis().transpose();
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    const BoxBody& box = boxes_[i];
    const std::size_t row = world_.box_begin + i;
    btTransform pose = box.body->getWorldTransform();
    btVector3 velocity = box.body->getLinearVelocity();
    btVector3 angular_velocity = box.body->getAngularVelocity();
    if (moving_container) {
      const btVector3 arm = pose.getOrigin() - frame.world_from_container.getOrigin();
      velocity = container_from_world * (velocity - frame.velocity - frame.angular_velocity.cross(arm));
      angular_velocity = container_from_world * (angular_velocity - frame.angular_velocity);
      pose = frame.world_from_container.inverse() * pose;
    }
    state.position[row] = box.start_position + (from_bullet(pose.getOrigin()) - box.bullet_start_position);
    state.orientation[row] = from_bullet(pose.getRotation());
    state.velocity[row] = from_bullet(velocity);
    state.angular_velocity[row] = from_bullet(angular_velocity);
  }
}

}  // namespace holdfast::internal
