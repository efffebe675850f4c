#include <box3d/box3d.h>

#include "peer_options.hpp"

namespace holdfast::peers {

namespace {

/// Box3D limits the stiffness of contacts to an eighth of the rate of its substeps: more than that asks for the limit.
constexpr float kStiffestContact = 1e6F;

/// The friction of the world that takes a step: the callback of Box3D has no context.
const FrictionTable* friction_of_step = nullptr;

float friction_of_surfaces(float /*of_a*/, std::uint64_t a, float /*of_b*/, std::uint64_t b) {
  return static_cast<float>(friction_of_step->of(a, b));
}

b3Vec3 to_box3d(const Vector& v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}
Vector from_box3d(const b3Vec3& v) { return {v.x, v.y, v.z}; }

class Box3dWorld final : public PeerWorld {
 public:
  Box3dWorld(const Scene& scene, const Box3dOptions& options)
      : friction_(scene.friction), substeps_(options.substeps), sleeping_(options.sleeping) {
    b3WorldDef definition = b3DefaultWorldDef();
    definition.frictionCallback = friction_of_surfaces;
    definition.restitutionCallback = [](float, std::uint64_t, float, std::uint64_t) { return 0.0F; };
    definition.enableSleep = options.sleeping;
    definition.workerCount = 1;
    if (options.stiff) definition.contactHertz = kStiffestContact;
    world_ = b3CreateWorld(&definition);
    for (const Body& side : scene.sides) add(side);
    boxes_.reserve(scene.boxes.size());
    for (const Body& box : scene.boxes) boxes_.push_back(add(box));
  }
  ~Box3dWorld() override { b3DestroyWorld(world_); }

  void set_gravity(const Vector& gravity) override {
    b3World_SetGravity(world_, to_box3d(gravity));
    // Wakes all boxes. Those that are awake have been still for some time, which Box3D would go on to count: a load at
    // rest for half a second would fall asleep in the step in which it is pushed. A step without sleeping counts from 0
    // again.
    b3World_EnableSleeping(world_, false);
  }

  bool step(double seconds) override {
    friction_of_step = &friction_;
    b3World_Step(world_, static_cast<float>(seconds), substeps_);
    if (sleeping_) b3World_EnableSleeping(world_, true);
    return true;
  }

  void read(std::span<Motion> motions) const override {
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      const b3WorldTransform pose = b3Body_GetTransform(boxes_[i]);
      motions[i] = {from_box3d(pose.p),
                    {pose.q.s, pose.q.v.x, pose.q.v.y, pose.q.v.z},
                    from_box3d(b3Body_GetLinearVelocity(boxes_[i])),
                    from_box3d(b3Body_GetAngularVelocity(boxes_[i]))};
    }
  }

 private:
  /// The origin of a body is its centre of mass.
  b3BodyId add(const Body& body) {
    b3BodyDef definition = b3DefaultBodyDef();
    definition.type = body.mass > 0.0 ? b3_dynamicBody : b3_staticBody;
    definition.position = to_box3d(body.start.position);
    const auto& [w, x, y, z] = body.start.container_from_body;
    definition.rotation = {to_box3d({x, y, z}), static_cast<float>(w)};
    definition.linearVelocity = to_box3d(body.start.velocity);
    definition.angularVelocity = to_box3d(body.start.angular_velocity);
    const b3BodyId id = b3CreateBody(world_, &definition);

    b3ShapeDef shape = b3DefaultShapeDef();
    shape.baseMaterial.userMaterialId = body.surface;
    shape.updateBodyMass = false;
    const b3Vec3 half = to_box3d(body.half_extents);
    const b3BoxHull hull = b3MakeOffsetBoxHull(half.x, half.y, half.z, to_box3d(body.centroid));
    b3CreateHullShape(id, &shape, &hull.base);
    if (body.mass > 0.0) {
      const b3Vec3 inertia = to_box3d(body.inertia);
      b3MassData mass{};
      mass.mass = static_cast<float>(body.mass);
      mass.inertia = {{inertia.x, 0.0F, 0.0F}, {0.0F, inertia.y, 0.0F}, {0.0F, 0.0F, inertia.z}};
      b3Body_SetMassData(id, mass);
    }
    return id;
  }

  const FrictionTable& friction_;
  int substeps_;
  bool sleeping_;
  b3WorldId world_{};
  std::vector<b3BodyId> boxes_;
};

}  // namespace

std::unique_ptr<PeerWorld> make_box3d_world(const Scene& scene, const Box3dOptions& options) {
  return std::make_unique<Box3dWorld>(scene, options);
}

}  // namespace holdfast::peers
