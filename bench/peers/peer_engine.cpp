#include "peer_engine.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include "core/engine/step_plan.hpp"
#include "core/model/contact_law.hpp"
#include "core/model/container_panels.hpp"

namespace holdfast::peers {

namespace {

using internal::Surface;
using internal::Vec3;

/// Thickness of the sides, m: as for Bullet.
constexpr double kSideThickness = 1.0;

Vector plain(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
Vec3 vec3(const Vector& v) { return {v[0], v[1], v[2]}; }

/// Numbers the surfaces that differ, and finds the friction of their pairs. Mats are not modelled.
class Surfaces {
 public:
  std::size_t number_of(const Surface& surface) {
    for (std::size_t i = 0; i < known_.size(); ++i) {
      const Surface& known = known_[i];
      if (known.kind == surface.kind && known.friction == surface.friction && known.material == surface.material)
        return i;
    }
    known_.push_back({.kind = surface.kind, .friction = surface.friction, .material = surface.material});
    return known_.size() - 1;
  }

  FrictionTable table(const internal::ContactSettings& contact) const {
    FrictionTable table{known_.size(), {}};
    for (const Surface& a : known_)
      for (const Surface& b : known_) table.coefficients.push_back(friction_of_pair(contact, a, b, 0.0));
    return table;
  }

 private:
  std::vector<Surface> known_;
};

Scene scene_of(const internal::WorldBatch& batch, const internal::World& world) {
  Scene scene;
  Surfaces surfaces;
  const internal::BoxView boxes = view(batch.boxes, world);
  const internal::StateView state = view(batch.state, world);
  for (std::size_t i = 0; i < world.box_count; ++i) {
    Body& body = scene.boxes.emplace_back();
    const internal::Rotation& q = state.orientation[i];
    body.start = {plain(state.position[i]),
                  {q.w(), q.x(), q.y(), q.z()},
                  plain(state.velocity[i]),
                  plain(state.angular_velocity[i])};
    body.half_extents = plain(boxes.half_extents[i]);
    body.centroid = plain(-boxes.centre_of_mass[i]);
    if (std::isfinite(boxes.mass[i])) {
      body.mass = boxes.mass[i];
      body.inertia = plain(boxes.inertia[i]);
    }
    body.surface = surfaces.number_of(boxes.surface[i]);
  }
  for (const internal::Panel& panel : container_panels(world.container, kSideThickness)) {
    Body& body = scene.sides.emplace_back();
    body.start.position = plain(panel.centre);
    body.half_extents = plain(panel.half_extents);
    body.surface = surfaces.number_of(panel.surface);
  }
  scene.friction = surfaces.table(world.contact);
  return scene;
}

/// One world of a peer on the way through its phases.
class SteppedWorld {
 public:
  SteppedWorld(const internal::WorldBatch& batch, const internal::World& world, const internal::Settings& settings,
               double steps_per_second, const MakePeerWorld& make)
      : world_(&world),
        gravity_(0.0, 0.0, -settings.gravity),
        steps_per_second_(steps_per_second),
        scene_(std::make_unique<Scene>(scene_of(batch, world))),
        peer_(make(*scene_)),
        rounded_(scene_->boxes.size()),
        motions_(scene_->boxes.size()) {
    peer_->read(rounded_);
  }

  double advance(const internal::Phase& phase) {
    if (!phase_set_ || phase.begin != phase_begin_) {
      if (!phase_set_ || phase.acceleration != acceleration_) peer_->set_gravity(plain(gravity_ - phase.acceleration));
      acceleration_ = phase.acceleration;
      phase_begin_ = phase.begin;
      phase_step_ = 0;
      phase_set_ = true;
    }
    const internal::StepPlan plan(phase, steps_per_second_);
    if (!peer_->step(plan.step())) status_ = internal::Status::capacity;
    ++counters_.steps;
    return plan.end_of(phase_step_++);
  }

  /// A box that the peer has not moved has exactly its given position, although peers compute in float.
  void read_back(internal::StateColumns& state) const {
    peer_->read(motions_);
    for (std::size_t i = 0; i < motions_.size(); ++i) {
      const std::size_t row = world_->box_begin + i;
      const Motion& now = motions_[i];
      const auto& [w, x, y, z] = now.container_from_body;
      state.position[row] = vec3(scene_->boxes[i].start.position) + (vec3(now.position) - vec3(rounded_[i].position));
      state.orientation[row] = internal::Rotation(w, x, y, z);
      state.velocity[row] = vec3(now.velocity);
      state.angular_velocity[row] = vec3(now.angular_velocity);
    }
  }

  const internal::Counters& counters() const { return counters_; }
  internal::Status status() const { return status_; }

 private:
  const internal::World* world_;
  Vec3 gravity_;
  double steps_per_second_;
  std::unique_ptr<Scene> scene_;
  std::unique_ptr<PeerWorld> peer_;
  std::vector<Motion> rounded_;  ///< of the start, as the peer rounded it
  mutable std::vector<Motion> motions_;
  bool phase_set_ = false;
  double phase_begin_ = 0.0;  ///< s
  std::uint64_t phase_step_ = 0;
  Vec3 acceleration_ = Vec3::Zero();
  internal::Counters counters_;
  internal::Status status_ = internal::Status::ok;
};

class PeerSimulation final : public internal::SteppedSimulation {
 public:
  explicit PeerSimulation(std::vector<SteppedWorld> worlds) : worlds_(std::move(worlds)) {}

  void read_back(std::size_t world, internal::StateColumns& state) const override { worlds_[world].read_back(state); }
  internal::Counters counters(std::size_t world) const override { return worlds_[world].counters(); }
  internal::Status status(std::size_t world) const override { return worlds_[world].status(); }

 private:
  double step(std::size_t world, const internal::Phase& phase) override { return worlds_[world].advance(phase); }

  std::vector<SteppedWorld> worlds_;
};

}  // namespace

PeerEngine::PeerEngine(std::string name, const internal::Settings& settings, double steps_per_second,
                       MakePeerWorld make)
    : settings_(settings), steps_per_second_(steps_per_second), make_(std::move(make)) {
  traits_.name = std::move(name);
}

std::unique_ptr<internal::Simulation> PeerEngine::build(const internal::WorldBatch& batch) const {
  std::vector<SteppedWorld> worlds;
  for (const internal::World& world : batch.worlds)
    worlds.emplace_back(batch, world, settings_, steps_per_second_, make_);
  return std::make_unique<PeerSimulation>(std::move(worlds));
}

}  // namespace holdfast::peers
