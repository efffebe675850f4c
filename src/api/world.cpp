#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "api/apply_settings.hpp"
#include "api/convert.hpp"
#include "api/guarded.hpp"
#include "core/engine/engine_registry.hpp"
#include "core/engine/interpolation.hpp"
#include "core/engine/simulate.hpp"
#include "holdfast/holdfast.hpp"

namespace holdfast {

using internal::StateColumns;
using internal::value_or_throw;

namespace {

std::unique_ptr<internal::Engine> engine_of(const internal::Settings& settings) {
  const internal::EngineEntry* entry = internal::find_engine(settings.screening.engine);
  if (entry == nullptr) throw internal::exception_of({internal::unknown_engine(settings.screening.engine)});
  if (entry->make == nullptr)
    throw internal::exception_of({{.what = "a single world cannot be simulated by a plug-in",
                                   .value = settings.screening.engine,
                                   .accepted = "native or native-plain"}});
  std::unique_ptr<internal::Engine> engine = value_or_throw(entry->make(settings));
  if (const auto error = internal::why_unsupported(*engine, settings)) throw internal::exception_of({*error});
  return engine;
}

}  // namespace

struct World::State {
  template <class AnyLayout>
  State(const AnyLayout& given, const Acceleration& given_acceleration, std::span<const Setting> given_settings,
        LengthUnit unit)
      : acceleration(value_or_throw(internal::read_acceleration(given_acceleration))) {
    internal::apply_settings(settings, given_settings);
    engine = engine_of(settings);
    std::vector<internal::Error> errors;
    layout = internal::read_layout(given, std::string(given.name), unit, settings, errors).layout;
    if (!errors.empty()) throw internal::exception_of(errors);
    const internal::Layout* const layouts[] = {&layout};
    const internal::Acceleration* const accelerations[] = {&acceleration};
    batch = internal::make_batch(layouts, accelerations, settings);
    before = batch.state;
    simulation = engine->build(batch);
    settle();
    end = internal::latest_end(acceleration, settings);
    phases = internal::phases_of(acceleration, end);
  }

  /// Gravity alone until t = 0.
  void settle() {
    const internal::Phase gravity_alone{0.0 - settings.screening.settle_seconds, 0.0, internal::Vec3::Zero()};
    double settled = gravity_alone.begin;
    while (settled < gravity_alone.end) settled = step(gravity_alone, gravity_alone.end);
    before = batch.state;
  }

  /// Takes a step, or several of those that nothing is seen of; returns the time reached, s.
  double step(const internal::Phase& now, double output_time) {
    before = batch.state;
    internal::AdvanceRequest request{0, now, output_time};
    simulation->advance({&request, 1});
    simulation->read_back(0, batch.state);
    if (measures_sides()) impulses = simulation->side_impulses(0);
    return request.reached;
  }

  bool measures_sides() const { return settings.screening.measures_walls() && engine->traits().measures_walls; }

  void advance(double wanted) {
    if (!(wanted > time)) return;
    wanted = std::min(wanted, end);
    while (reached < wanted && phase < phases.size()) {
      begin = reached;
      reached = step(phases[phase], wanted);
      if (reached >= phases[phase].end) ++phase;
    }
    time = wanted;
  }

  internal::Settings settings;
  internal::Acceleration acceleration;
  std::unique_ptr<internal::Engine> engine;
  internal::Layout layout;
  internal::WorldBatch batch;  ///< of this world alone; its state is that at `reached`
  StateColumns before;         ///< at `begin`
  std::unique_ptr<internal::Simulation> simulation;
  std::vector<internal::Phase> phases;
  std::size_t phase = 0;              ///< index of the phase that the next step is in
  double begin = 0.0, reached = 0.0;  ///< of the last step, s
  internal::SideImpulses impulses;    ///< of the last step
  double time = 0.0, end = 0.0;       ///< that the caller sees, and at which all ends, s
};

World::World(const Layout& layout, const Acceleration& acceleration, std::span<const Setting> settings,
             LengthUnit unit) {
  internal::guarded([&] { state_ = std::make_unique<State>(layout, acceleration, settings, unit); });
}

World::World(const LayoutView& layout, const Acceleration& acceleration, std::span<const Setting> settings,
             LengthUnit unit) {
  internal::guarded([&] { state_ = std::make_unique<State>(layout, acceleration, settings, unit); });
}

World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

void World::advance(double time) {
  internal::guarded([&] { state_->advance(time); });
}

double World::time() const noexcept { return state_->time; }
double World::end_time() const noexcept { return state_->end; }

std::vector<Pose> World::poses() const {
  const State& state = *state_;
  const double duration = state.reached - state.begin;
  const double share = duration > 0.0 ? (state.time - state.begin) / duration : 1.0;
  std::vector<Pose> poses;
  for (std::size_t box = 0; box < state.layout.boxes.size(); ++box) {
    const StateColumns& after = state.batch.state;
    const internal::Vec3 p = internal::between(state.before.position[box], after.position[box], share);
    const internal::Rotation q = internal::between(state.before.orientation[box], after.orientation[box], share);
    poses.push_back({{p.x(), p.y(), p.z()}, {q.w(), q.x(), q.y(), q.z()}});
  }
  return poses;
}

std::vector<std::array<double, 3>> World::side_forces() const {
  const State& state = *state_;
  std::vector<std::array<double, 3>> forces;
  if (!state.measures_sides()) return forces;
  const double duration = state.reached - state.begin;
  for (const internal::SideImpulse& side : state.impulses) {
    const internal::Vec3 force = duration > 0.0 ? internal::Vec3(side.impulse / duration) : internal::Vec3::Zero();
    forces.push_back({force.x(), force.y(), force.z()});
  }
  return forces;
}

std::uint64_t World::state_hash() const {
  return internal::state_hash(internal::view(state_->batch.state, state_->batch.worlds.front()));
}

}  // namespace holdfast
