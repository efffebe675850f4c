#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "api/apply_settings.hpp"
#include "api/convert.hpp"
#include "api/guarded.hpp"
#include "core/base/number_text.hpp"
#include "core/engine/engine_registry.hpp"
#include "core/engine/engine_support.hpp"
#include "core/engine/interpolation.hpp"
#include "core/engine/journey.hpp"
#include "core/model/acceleration_check.hpp"
#include "core/model/friction_pairs.hpp"
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

[[noreturn]] void refuse(std::string what, std::string value, std::string accepted) {
  throw internal::exception_of({{.what = std::move(what), .value = std::move(value), .accepted = std::move(accepted)}});
}

/// Largest force along an axis, N: the weight of a hundred thousand tonnes. More is a mistake.
constexpr double kLargestForce = 1e9;

/// Largest coordinate of a point where a force acts, m. More is a mistake.
constexpr double kLargestPlace = 1e3;

/// A vector of the caller, whose numbers are finite and none is beyond what can be meant.
internal::Vec3 finite(const std::array<double, 3>& numbers, const std::string& name, double most, const char* unit) {
  for (const double number : numbers)
    if (!(std::abs(number) <= most))
      refuse(name + " cannot be used", internal::number_text(number),
             "numbers from " + internal::number_text(-most) + " to " + internal::number_text(most) + " " + unit);
  return {numbers[0], numbers[1], numbers[2]};
}

}  // namespace

struct World::State {
  template <class AnyLayout>
  State(const AnyLayout& given, const Acceleration& given_acceleration, std::span<const Setting> given_settings,
        LengthUnit unit)
      : acceleration(value_or_throw(internal::read_acceleration(given_acceleration))) {
    internal::Config config;
    internal::apply_settings(config, given_settings);
    settings = std::move(config.settings);
    engine = engine_of(settings);
    std::vector<internal::Error> errors;
    layout = internal::read_layout(given, std::string(given.name), unit, settings, errors).layout;
    if (!errors.empty()) throw internal::exception_of(errors);
    const internal::Layout* const layouts[] = {&layout};
    const internal::Acceleration* const accelerations[] = {&acceleration};
    batch = internal::make_batch(layouts, accelerations, settings);
    before = batch.state;
    simulation = engine->build(batch);
    journey.emplace(*engine, acceleration, settings);
    while (journey->settles()) step();
    before = batch.state;
    begin = reached = journey->time();
    end = internal::latest_end(acceleration, settings);
    has_ended = journey->has_ended();
  }

  /// Takes a step, or several of those in which nothing moves.
  void step() {
    before = batch.state;
    internal::AdvanceRequest request{0, journey->phase()};
    simulation->advance({&request, 1});
    simulation->read_back(0, batch.state);
    if (measures_sides()) impulses = simulation->side_impulses(0);
    const internal::StateView now = internal::view(batch.state, batch.worlds.front());
    const bool quiet = internal::is_quiet(now, settings.sleeping_threshold);
    begin = journey->time();
    // Also where the world ends with the proof that nothing moves in the step.
    pressed = request.reached - begin;
    has_ended = journey->reach(request.reached, simulation->rests(0), quiet) == internal::Journey::Event::end;
    reached = journey->time();
    // The load was at rest before, as has been proved, and nothing was simulated.
    if (has_ended && reached == begin) batch.state = before;
  }

  /// Brings the engine and what is left of the journey to where a change begins.
  void cut() {
    // A world at rest goes to the end of its phase at once, and is on the way there as it is at the end; and one that
    // has ended at rest goes on from there.
    if ((time < reached && rests()) || (has_ended && reached < time)) begin = reached = time;
    journey->cut(reached);
    has_ended = journey->has_ended();
  }

  /// True when no box has moved in the last step, and none is moving.
  bool rests() const {
    const StateColumns& now = batch.state;
    const auto none = [](const std::vector<internal::Vec3>& vectors) {
      return std::all_of(vectors.begin(), vectors.end(), [](const auto& v) { return v == internal::Vec3::Zero(); });
    };
    const auto same = [](const internal::Rotation& a, const internal::Rotation& b) { return a.coeffs() == b.coeffs(); };
    return now.position == before.position && none(now.velocity) && none(now.angular_velocity) &&
           std::equal(now.orientation.begin(), now.orientation.end(), before.orientation.begin(), same);
  }

  /// Throws where the engine cannot change forces and friction of a world that goes.
  void require_changes() const {
    if (!engine->traits().takes_changes)
      refuse("this engine cannot change forces and friction of a world that goes", engine->traits().name, "native");
  }

  /// How far `time` is from the start of the last step to its end, where a world stays that has ended.
  double share() const { return time < reached ? (time - begin) / (reached - begin) : 1.0; }

  internal::Vec3 position(std::size_t box) const {
    return internal::between(before.position[box], batch.state.position[box], share());
  }
  internal::Rotation orientation(std::size_t box) const {
    return internal::between(before.orientation[box], batch.state.orientation[box], share());
  }

  bool measures_sides() const { return settings.screening.measures_walls() && engine->traits().measures_walls; }

  void advance(double wanted) {
    if (!(wanted > time)) return;
    wanted = std::min(wanted, end);
    while (reached < wanted && !has_ended) step();
    time = wanted;
  }

  internal::Settings settings;
  internal::Acceleration acceleration;
  std::unique_ptr<internal::Engine> engine;
  internal::Layout layout;
  internal::WorldBatch batch;  ///< of this world alone; its state is that at `reached`
  StateColumns before;         ///< at `begin`
  std::unique_ptr<internal::Simulation> simulation;
  std::optional<internal::Journey> journey;
  bool has_ended = false;             ///< nothing happens after `reached`
  double begin = 0.0, reached = 0.0;  ///< of the last step, s
  internal::SideImpulses impulses;    ///< of the last step
  double pressed = 0.0;               ///< for how long they acted, s
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
  std::vector<Pose> poses;
  for (std::size_t box = 0; box < state_->layout.boxes.size(); ++box) {
    const internal::Vec3 p = state_->position(box);
    const internal::Rotation q = state_->orientation(box);
    poses.push_back({{p.x(), p.y(), p.z()}, {q.w(), q.x(), q.y(), q.z()}});
  }
  return poses;
}

std::vector<Velocity> World::velocities() const {
  const StateColumns& before = state_->before;
  const StateColumns& after = state_->batch.state;
  std::vector<Velocity> velocities;
  for (std::size_t box = 0; box < state_->layout.boxes.size(); ++box) {
    const internal::Vec3 v = internal::between(before.velocity[box], after.velocity[box], state_->share());
    const internal::Vec3 w =
        internal::between(before.angular_velocity[box], after.angular_velocity[box], state_->share());
    velocities.push_back({{v.x(), v.y(), v.z()}, {w.x(), w.y(), w.z()}});
  }
  return velocities;
}

void World::set_acceleration(const std::array<double, 3>& acceleration) {
  internal::guarded([&] {
    const internal::Vec3 wanted = finite(acceleration, "the acceleration", internal::kLargestAcceleration, "m/s²");
    State& state = *state_;
    state.cut();
    state.journey->set_acceleration(wanted);
  });
}

void World::set_friction(double box_box, double box_floor, double box_wall) {
  internal::guarded([&] {
    State& state = *state_;
    state.require_changes();
    for (const double coefficient : {box_box, box_floor, box_wall})
      if (!(coefficient >= 0.0 && coefficient <= internal::kLargestFriction))
        refuse("not a coefficient of friction", internal::number_text(coefficient), "numbers from 0 to 10");
    internal::ContactSettings& contact = state.batch.worlds.front().contact;
    contact.friction_model = internal::FrictionModel::pairs;
    contact.materials = {};
    contact.box_box = box_box;
    contact.box_floor = box_floor;
    contact.box_wall = box_wall;
    state.cut();
    state.simulation->set_friction(0, contact);
  });
}

void World::set_force(std::size_t box, const std::array<double, 3>& force,
                      const std::optional<std::array<double, 3>>& point) {
  internal::guarded([&] {
    State& state = *state_;
    state.require_changes();
    const std::size_t count = state.layout.boxes.size();
    if (box >= count) refuse("no such box", std::to_string(box), "a number below " + std::to_string(count));
    internal::BoxForce push{.force = finite(force, "the force", kLargestForce, "N")};
    if (point) {
      const internal::Vec3 where = finite(*point, "the point", kLargestPlace, "m");
      push.at = state.orientation(box).conjugate() * (where - state.position(box));
    }
    state.cut();
    state.simulation->set_force(0, box, push);
  });
}

std::vector<std::array<double, 3>> World::side_forces() const {
  const State& state = *state_;
  std::vector<std::array<double, 3>> forces;
  if (!state.measures_sides()) return forces;
  for (const internal::SideImpulse& side : state.impulses) {
    const internal::Vec3 force =
        state.pressed > 0.0 ? internal::Vec3(side.impulse / state.pressed) : internal::Vec3::Zero();
    forces.push_back({force.x(), force.y(), force.z()});
  }
  return forces;
}

std::uint64_t World::state_hash() const {
  return internal::state_hash(internal::view(state_->batch.state, state_->batch.worlds.front()));
}

}  // namespace holdfast
