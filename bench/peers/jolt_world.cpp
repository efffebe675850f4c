// Jolt.h comes first: the other headers of Jolt need it.
#include <Jolt/Jolt.h>

#include <Jolt/Core/Factory.h>
#include <Jolt/Core/JobSystemSingleThreaded.h>
#include <Jolt/Core/TempAllocator.h>
#include <Jolt/Physics/Body/BodyCreationSettings.h>
#include <Jolt/Physics/Collision/BroadPhase/BroadPhaseLayerInterfaceTable.h>
#include <Jolt/Physics/Collision/BroadPhase/ObjectVsBroadPhaseLayerFilterTable.h>
#include <Jolt/Physics/Collision/ObjectLayerPairFilterTable.h>
#include <Jolt/Physics/Collision/Shape/BoxShape.h>
#include <Jolt/Physics/Collision/Shape/OffsetCenterOfMassShape.h>
#include <Jolt/Physics/PhysicsSystem.h>
#include <Jolt/RegisterTypes.h>

#include "peer_options.hpp"

namespace holdfast::peers {

namespace {

/// Radius of the edges, m. Faces stay where they are. A larger one makes Jolt faster, and boxes that tip over an edge
/// stand on a rounded one; with 0, every overlap is found by the slower of Jolt's two methods.
constexpr float kConvexRadius = 1e-3F;

/// How far boxes may sink into each other where `JoltOptions::precise`, m.
constexpr float kPreciseSlop = 1e-4F;

constexpr JPH::ObjectLayer kFixedLayer = 0;
constexpr JPH::ObjectLayer kMovingLayer = 1;
constexpr JPH::uint kLayers = 2;

/// What is one per program.
struct JoltProgram {
  JoltProgram() {
    JPH::RegisterDefaultAllocator();
    JPH::Factory::sInstance = new JPH::Factory();
    JPH::RegisterTypes();
    memory = std::make_unique<JPH::TempAllocatorImplWithMallocFallback>(32U << 20U);
    jobs = std::make_unique<JPH::JobSystemSingleThreaded>(JPH::cMaxPhysicsJobs);
  }
  ~JoltProgram() {
    JPH::UnregisterTypes();
    delete JPH::Factory::sInstance;
    JPH::Factory::sInstance = nullptr;
  }

  std::unique_ptr<JPH::TempAllocator> memory;
  std::unique_ptr<JPH::JobSystemSingleThreaded> jobs;
};

JoltProgram& program() {
  static JoltProgram program;
  return program;
}

/// Which bodies may touch: all but two fixed ones.
struct PairTable : JPH::ObjectLayerPairFilterTable {
  PairTable() : ObjectLayerPairFilterTable(kLayers) {
    EnableCollision(kFixedLayer, kMovingLayer);
    EnableCollision(kMovingLayer, kMovingLayer);
  }
};

/// Fixed and moving bodies in trees of their own.
struct TreeTable : JPH::BroadPhaseLayerInterfaceTable {
  TreeTable() : BroadPhaseLayerInterfaceTable(kLayers, kLayers) {
    MapObjectToBroadPhaseLayer(kFixedLayer, JPH::BroadPhaseLayer(0));
    MapObjectToBroadPhaseLayer(kMovingLayer, JPH::BroadPhaseLayer(1));
  }
};

/// What Jolt asks about layers. The last one copies the others when it is made.
struct Layers {
  PairTable pairs;
  TreeTable trees;
  JPH::ObjectVsBroadPhaseLayerFilterTable against_trees{trees, kLayers, pairs, kLayers};
};

/// The friction of the world that takes a step: the callback of Jolt has no context.
const FrictionTable* friction_of_step = nullptr;

float friction_of_bodies(const JPH::Body& a, const JPH::SubShapeID& /*of_a*/, const JPH::Body& b,
                         const JPH::SubShapeID& /*of_b*/) {
  return static_cast<float>(friction_of_step->of(a.GetUserData(), b.GetUserData()));
}

JPH::Vec3 to_jolt(const Vector& v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}
Vector from_jolt(JPH::Vec3Arg v) { return {v.GetX(), v.GetY(), v.GetZ()}; }

class JoltWorld final : public PeerWorld {
 public:
  JoltWorld(const Scene& scene, const JoltOptions& options) : friction_(scene.friction) {
    // Limits that no load reaches: beyond them Jolt leaves contacts out.
    const auto bodies = static_cast<JPH::uint>(scene.boxes.size() + scene.sides.size());
    physics_.Init(bodies, 0, 64 * bodies + 1024, 32 * bodies + 1024, layers_.trees, layers_.against_trees,
                  layers_.pairs);
    JPH::PhysicsSettings settings;
    settings.mNumVelocitySteps = static_cast<JPH::uint>(options.velocity_iterations);
    settings.mNumPositionSteps = static_cast<JPH::uint>(options.position_iterations);
    settings.mAllowSleeping = options.sleeping;
    if (options.precise) settings.mPenetrationSlop = kPreciseSlop;
    physics_.SetPhysicsSettings(settings);
    physics_.SetCombineFriction(friction_of_bodies);
    for (const Body& side : scene.sides) add(side);
    for (const Body& box : scene.boxes) {
      boxes_.push_back(add(box));
      if (box.mass > 0.0) moving_.push_back(boxes_.back()->GetID());
    }
    physics_.OptimizeBroadPhase();
  }
  ~JoltWorld() override {
    JPH::BodyInterface& interface = physics_.GetBodyInterfaceNoLock();
    for (const JPH::BodyID& body : bodies_) {
      interface.RemoveBody(body);
      interface.DestroyBody(body);
    }
  }

  void set_gravity(const Vector& gravity) override {
    physics_.SetGravity(to_jolt(gravity));
    physics_.GetBodyInterfaceNoLock().ActivateBodies(moving_.data(), static_cast<int>(moving_.size()));
  }

  bool step(double seconds) override {
    friction_of_step = &friction_;
    return physics_.Update(static_cast<float>(seconds), 1, program().memory.get(), program().jobs.get()) ==
           JPH::EPhysicsUpdateError::None;
  }

  void read(std::span<Motion> motions) const override {
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      const JPH::Body& box = *boxes_[i];
      const JPH::Quat q = box.GetRotation();
      motions[i] = {from_jolt(box.GetCenterOfMassPosition()),
                    {q.GetW(), q.GetX(), q.GetY(), q.GetZ()},
                    from_jolt(box.GetLinearVelocity()),
                    from_jolt(box.GetAngularVelocity())};
    }
  }

 private:
  const JPH::Body* add(const Body& body) {
    const bool moves = body.mass > 0.0;
    JPH::RefConst<JPH::Shape> shape = new JPH::BoxShape(to_jolt(body.half_extents), kConvexRadius);
    // The origin of the body is the centroid; Jolt's own centre of mass is moved away from it.
    const JPH::Vec3 centroid = to_jolt(body.centroid);
    if (!(centroid == JPH::Vec3::sZero())) shape = new JPH::OffsetCenterOfMassShape(shape, -centroid);
    const auto& [w, x, y, z] = body.start.container_from_body;
    const JPH::Quat rotation{static_cast<float>(x), static_cast<float>(y), static_cast<float>(z),
                             static_cast<float>(w)};
    JPH::BodyCreationSettings definition(shape, to_jolt(body.start.position) + rotation * centroid, rotation,
                                         moves ? JPH::EMotionType::Dynamic : JPH::EMotionType::Static,
                                         moves ? kMovingLayer : kFixedLayer);
    definition.mUserData = body.surface;
    if (moves) {
      definition.mLinearVelocity = to_jolt(body.start.velocity);
      definition.mAngularVelocity = to_jolt(body.start.angular_velocity);
      definition.mLinearDamping = 0.0F;
      definition.mAngularDamping = 0.0F;
      definition.mApplyGyroscopicForce = true;
      definition.mOverrideMassProperties = JPH::EOverrideMassProperties::MassAndInertiaProvided;
      definition.mMassPropertiesOverride.mMass = static_cast<float>(body.mass);
      definition.mMassPropertiesOverride.mInertia = JPH::Mat44::sScale(to_jolt(body.inertia));
    }
    JPH::BodyInterface& interface = physics_.GetBodyInterfaceNoLock();
    const JPH::Body* made = interface.CreateBody(definition);
    interface.AddBody(made->GetID(), moves ? JPH::EActivation::Activate : JPH::EActivation::DontActivate);
    bodies_.push_back(made->GetID());
    return made;
  }

  const FrictionTable& friction_;
  Layers layers_;
  JPH::PhysicsSystem physics_;
  std::vector<const JPH::Body*> boxes_;
  std::vector<JPH::BodyID> moving_;
  std::vector<JPH::BodyID> bodies_;  ///< boxes and sides
};

}  // namespace

std::unique_ptr<PeerWorld> make_jolt_world(const Scene& scene, const JoltOptions& options) {
  program();
  return std::make_unique<JoltWorld>(scene, options);
}

}  // namespace holdfast::peers
