#include "core/reference/plain_engine.hpp"

#include "core/reference/plain_world.hpp"

namespace holdfast::internal {

namespace {

class PlainSimulation final : public SteppedSimulation {
 public:
  PlainSimulation(const WorldBatch& batch, const Settings& settings) {
    for (const World& world : batch.worlds) worlds_.emplace_back(batch, world, settings);
  }

  void read_back(std::size_t world, StateColumns& state) const override { worlds_[world].read_back(state); }
  Counters counters(std::size_t world) const override { return worlds_[world].counters(); }
  Status status(std::size_t world) const override { return worlds_[world].status(); }

 private:
  double step(std::size_t world, const Phase& phase) override { return worlds_[world].advance(phase); }

  std::vector<plain::PlainWorld> worlds_;
};

}  // namespace

PlainEngine::PlainEngine(const Settings& settings) : settings_(settings) {
  traits_.name = "native-plain";
  traits_.steps_per_second = plain::steps_per_second(settings);
  traits_.has_mats = true;
}

std::unique_ptr<Simulation> PlainEngine::build(const WorldBatch& batch) const {
  return std::make_unique<PlainSimulation>(batch, settings_);
}

std::vector<Error> unsupported_by_plain(const Settings& settings) {
  std::vector<Error> errors;
  if (settings.container.motion == ContainerMotion::free) {
    errors.push_back({.what = "native-plain moves boxes in the container's own frame and has no free container",
                      .accepted = "Motion = prescribed"});
  }
  return errors;
}

}  // namespace holdfast::internal
