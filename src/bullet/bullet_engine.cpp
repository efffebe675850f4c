#include "bullet/bullet_engine.hpp"

#include "bullet/bullet_world.hpp"
#include "bullet/surface.hpp"

namespace holdfast::internal {

namespace {

/// Worlds are built when they are first advanced and share nothing.
class BulletSimulation final : public SteppedSimulation {
 public:
  BulletSimulation(const WorldBatch& batch, const Settings& settings, const BulletPreset& preset) {
    for (const World& world : batch.worlds)
      worlds_.push_back(std::make_unique<BulletWorld>(batch, world, settings, preset));
  }

  void read_back(std::size_t world, StateColumns& state) const override { worlds_[world]->read_back(state); }
  SideImpulses side_impulses(std::size_t world) const override { return worlds_[world]->side_impulses(); }
  Counters counters(std::size_t world) const override { return worlds_[world]->counters(); }

 private:
  double step(std::size_t world, const Phase& phase) override { return worlds_[world]->advance(phase); }

  std::vector<std::unique_ptr<BulletWorld>> worlds_;
};

}  // namespace

BulletEngine::BulletEngine(std::string_view name, const Settings& settings)
    : settings_(settings), preset_(bullet_preset(name, settings)) {
  traits_.name = name;
  traits_.steps_per_second = preset_.steps_per_second;
  traits_.measures_walls = settings.container.motion == ContainerMotion::prescribed;
  install_contact_laws();
}

std::unique_ptr<Simulation> BulletEngine::build(const WorldBatch& batch) const {
  return std::make_unique<BulletSimulation>(batch, settings_, preset_);
}

std::vector<Error> unsupported_by_bullet(const Settings& settings) {
  std::vector<Error> errors;
  const ContactSettings& contact = settings.contact;
  if (settings.container.motion == ContainerMotion::free && contact.friction_model == FrictionModel::pairs &&
      contact.box_floor != contact.box_wall) {
    errors.push_back({.what = "a free container is one body in Bullet, with one friction coefficient",
                      .accepted = "BoxFloor and BoxWall must be equal, or Motion = prescribed"});
  }
  return errors;
}

}  // namespace holdfast::internal
