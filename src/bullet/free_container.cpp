#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btCompoundShape.h>

#include "bullet/bullet_number.hpp"
#include "bullet/container_body.hpp"
#include "core/model/container_panels.hpp"

namespace holdfast::internal {

namespace {

/// Thickness of the panels of a free container, m: thin enough for the inertia of a shell, thick enough for the speeds
/// of a pushed container. The paper does not give it.
constexpr double kPanelThickness = 0.1;

/// Half extent of the ground, m: a container pushed with 1 g for 15 s stays on it.
constexpr double kGroundReach = 2000.0;
constexpr double kGroundThickness = 10.0;

class FreeContainer final : public ContainerBody {
 public:
  FreeContainer(btDiscreteDynamicsWorld& world, const Settings& settings, const World& load, double cargo_mass)
      : world_(world),
        gravity_(0.0, 0.0, -settings.gravity),
        driven_mass_(load.container.mass + cargo_mass),
        surface_{{SurfaceKind::floor, load.container.friction, 0.0}, &load.contact},
        ground_surface_{{SurfaceKind::ground, load.container.ground_friction, 0.0}, &load.contact},
        ground_shape_(btVector3(to_bullet(kGroundReach), to_bullet(kGroundReach), to_bullet(0.5 * kGroundThickness))) {
    add_ground();
    add_shell(load.container);
  }
  ~FreeContainer() override {
    world_.removeRigidBody(body_.get());
    world_.removeRigidBody(ground_.get());
  }

  btVector3 set_acceleration(const Vec3& acceleration) override {
    force_ = to_bullet(Vec3(driven_mass_ * acceleration));
    body_->activate(true);
    return to_bullet(gravity_);
  }

  void push() override { body_->applyCentralForce(force_); }

  Frame frame() const override {
    Frame frame;
    frame.world_from_container = body_->getWorldTransform() * shell_from_container_;
    frame.angular_velocity = body_->getAngularVelocity();
    const btVector3 arm = frame.world_from_container.getOrigin() - body_->getWorldTransform().getOrigin();
    frame.velocity = body_->getLinearVelocity() + frame.angular_velocity.cross(arm);
    return frame;
  }

 private:
  void add_ground() {
    ground_ = std::make_unique<btRigidBody>(btScalar(0), nullptr, &ground_shape_);
    const Vec3 centre(0.0, 0.0, -kPanelThickness - 0.5 * kGroundThickness);
    ground_->setWorldTransform(btTransform(btQuaternion::getIdentity(), to_bullet(centre)));
    ground_->setUserPointer(&ground_surface_);
    world_.addRigidBody(ground_.get());
  }

  /// The mass of the container is distributed over the panels by volume; the frame of the compound body is that of its
  /// principal axes.
  void add_shell(const ContainerSettings& container) {
    btCompoundShape panels;
    std::vector<btScalar> masses;
    double volume = 0.0;
    ContainerSettings on_ground = container;
    on_ground.bed_height = kPanelThickness;
    std::vector<Panel> sides = container_panels(on_ground, kPanelThickness);
    std::erase_if(sides, [](const Panel& side) { return side.surface.kind == SurfaceKind::ground; });
    for (const Panel& side : sides) volume += side.half_extents.prod();
    for (const Panel& side : sides) {
      panel_shapes_.push_back(std::make_unique<btBoxShape>(to_bullet(side.half_extents)));
      panels.addChildShape(btTransform(btQuaternion::getIdentity(), to_bullet(side.centre)),
                           panel_shapes_.back().get());
      masses.push_back(to_bullet(container.mass * side.half_extents.prod() / volume));
    }
    btTransform container_from_shell;
    btVector3 inertia;
    panels.calculatePrincipalAxisTransform(masses.data(), container_from_shell, inertia);
    shell_from_container_ = container_from_shell.inverse();
    for (int i = 0; i < panels.getNumChildShapes(); ++i)
      shell_shape_.addChildShape(shell_from_container_ * panels.getChildTransform(i), panels.getChildShape(i));

    body_ = std::make_unique<btRigidBody>(to_bullet(container.mass), nullptr, &shell_shape_, inertia);
    body_->setWorldTransform(container_from_shell);
    body_->setUserPointer(&surface_);
    world_.addRigidBody(body_.get());
    body_->setGravity(to_bullet(gravity_));
    body_->setActivationState(DISABLE_DEACTIVATION);
  }

  btDiscreteDynamicsWorld& world_;
  Vec3 gravity_;
  double driven_mass_;
  BodySurface surface_;
  BodySurface ground_surface_;
  btBoxShape ground_shape_;
  btCompoundShape shell_shape_;
  std::vector<std::unique_ptr<btBoxShape>> panel_shapes_;
  std::unique_ptr<btRigidBody> ground_;
  std::unique_ptr<btRigidBody> body_;
  btTransform shell_from_container_;
  btVector3 force_ = {0, 0, 0};
};

}  // namespace

std::unique_ptr<ContainerBody> make_free_container(btDiscreteDynamicsWorld& world, const Settings& settings,
                                                   const World& load, double cargo_mass) {
  return std::make_unique<FreeContainer>(world, settings, load, cargo_mass);
}

}  // namespace holdfast::internal
