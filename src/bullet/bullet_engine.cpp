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
  traits_.has_mats = true;
  traits_.measures_walls = settings.container.motion == ContainerMotion::prescribed;
  install_contact_laws();
}

std::unique_ptr<Simulation> BulletEngine::build(const WorldBatch& batch) const {
  return std::make_unique<BulletSimulation>(batch, settings_, preset_);
}

std::vector<Error> unsupported_by_bullet(const Settings& settings) {
  const ContactSettings& contact = settings.contact;
  if (settings.container.motion != ContainerMotion::free || contact.friction_model != FrictionModel::pairs) return {};
  const char* const what = "a free container is one body in Bullet, with one friction coefficient";
  if (contact.box_floor != contact.box_wall)
    return {{.what = what, .accepted = "BoxFloor and BoxWall must be equal, or Motion = prescribed"}};
  // Materials that are equal on both have the coefficients of any box there, or the same ones of their own.
  for (const FrictionTable::Row& row : contact.materials.rows()) {
    for (const std::string& name : {row.partners.first, row.partners.second}) {
      const int material = contact.materials.index_of(name);
      const double on_floor = contact.materials.on_floor(material).value_or(contact.box_floor);
      if (on_floor != contact.materials.on_wall(material).value_or(contact.box_wall))
        return {{.what = what,
                 .value = "[Friction] " + row.partners.text(),
                 .accepted = name + ", floor and " + name + ", wall must be equal, or Motion = prescribed"}};
    }
  }
  return {};
}

}  // namespace holdfast::internal
