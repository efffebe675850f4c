#include "core/native/native_engine.hpp"

#include <exception>

#include "core/native/native_world.hpp"

namespace holdfast::internal {

namespace {

class NativeSimulation final : public SteppedSimulation {
 public:
  NativeSimulation(const WorldBatch& batch, const Settings& settings, const native::NativeOptions& options,
                   std::shared_ptr<native::WorldMemoryPool> pool)
      : pool_(std::move(pool)) {
    for (const World& world : batch.worlds)
      worlds_.push_back(std::make_unique<native::NativeWorld>(batch, world, settings, options, pool_->take()));
  }
  NativeSimulation(const NativeSimulation&) = delete;
  NativeSimulation& operator=(const NativeSimulation&) = delete;
  ~NativeSimulation() override {
    // What an exception has left half done is not kept.
    if (std::uncaught_exceptions() > exceptions_) return;
    for (const auto& world : worlds_) pool_->give_back(world->release_memory());
  }

  void mark(std::size_t world) override { worlds_[world]->mark(); }
  void rewind(std::size_t world) override { worlds_[world]->rewind(); }
  void set_force(std::size_t world, std::size_t box, const BoxForce& force) override {
    worlds_[world]->set_force(box, force);
  }
  void set_friction(std::size_t world, const ContactSettings& contact) override {
    worlds_[world]->set_friction(contact);
  }
  bool rests(std::size_t world) const override { return worlds_[world]->rests(); }
  void read_back(std::size_t world, StateColumns& state) const override { worlds_[world]->read_back(state); }
  SideImpulses side_impulses(std::size_t world) const override { return worlds_[world]->side_impulses(); }
  Counters counters(std::size_t world) const override { return worlds_[world]->counters(); }
  Status status(std::size_t world) const override { return worlds_[world]->status(); }

 private:
  double step(std::size_t world, const Phase& phase) override { return worlds_[world]->advance(phase); }

  std::shared_ptr<native::WorldMemoryPool> pool_;
  int exceptions_ = std::uncaught_exceptions();  ///< that were under way when the simulation was built
  std::vector<std::unique_ptr<native::NativeWorld>> worlds_;
};

}  // namespace

NativeEngine::NativeEngine(const Settings& settings)
    : settings_(settings),
      options_(native::native_options(settings)),
      pool_(std::make_shared<native::WorldMemoryPool>(options_)) {
  traits_.name = "native";
  traits_.rewinds = true;
  traits_.proves_rest = true;
  traits_.measures_walls = true;
  traits_.takes_changes = true;
  traits_.longest_step = 1.0 / options_.steps_per_second;
  traits_.steps_per_second = options_.steps_per_second;
  traits_.has_kinetic_friction = true;
  traits_.has_mats = true;
}

std::unique_ptr<Simulation> NativeEngine::build(const WorldBatch& batch) const {
  return std::make_unique<NativeSimulation>(batch, settings_, options_, pool_);
}

std::vector<Error> unsupported_by_native(const Settings& settings) {
  if (settings.container.motion == ContainerMotion::prescribed) return {};
  return {{.what = "native moves boxes in a container that goes as the acceleration file says, and has no free one",
           .accepted = "Engine = bullet or bullet-f64, or Motion = prescribed"}};
}

}  // namespace holdfast::internal
