#include <BulletCollision/CollisionShapes/btBoxShape.h>

#include "bullet/bullet_number.hpp"
#include "bullet/container_body.hpp"
#include "core/model/container_panels.hpp"

namespace holdfast::internal {

namespace {

/// Thickness of what boxes cannot get round, m. A box of 2 cm at 10 m/s can tunnel through a wall of 10 cm within a
/// step of 1/240 s; no box tunnels through a metre.
constexpr double kClosedThickness = 1.0;

class PrescribedContainer final : public ContainerBody {
 public:
  PrescribedContainer(btDiscreteDynamicsWorld& world, const Settings& settings, const World& load)
      : world_(world), gravity_(0.0, 0.0, -settings.gravity) {
    const std::vector<Panel> panels = container_panels(load.container, kClosedThickness);
    sides_.reserve(panels.size());
    for (const Panel& panel : panels) {
      Side& side = sides_.emplace_back();
      side.surface = {panel.surface, &load.contact};
      side.shape = std::make_unique<btBoxShape>(to_bullet(panel.half_extents));
      side.body = std::make_unique<btRigidBody>(btScalar(0), nullptr, side.shape.get());
      side.body->setWorldTransform(btTransform(btQuaternion::getIdentity(), to_bullet(panel.centre)));
      side.body->setUserPointer(&side.surface);
      side.body->setUserIndex(static_cast<int>(panel.side));
      world_.addRigidBody(side.body.get());
    }
  }
  ~PrescribedContainer() override {
    for (Side& side : sides_) world_.removeRigidBody(side.body.get());
  }

  btVector3 set_acceleration(const Vec3& acceleration) override { return to_bullet(Vec3(gravity_ - acceleration)); }

 private:
  struct Side {
    BodySurface surface;
    std::unique_ptr<btBoxShape> shape;
    std::unique_ptr<btRigidBody> body;
  };
  btDiscreteDynamicsWorld& world_;
  Vec3 gravity_;
  std::vector<Side> sides_;
};

}  // namespace

std::unique_ptr<ContainerBody> make_prescribed_container(btDiscreteDynamicsWorld& world, const Settings& settings,
                                                         const World& load) {
  return std::make_unique<PrescribedContainer>(world, settings, load);
}

}  // namespace holdfast::internal
