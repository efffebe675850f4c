#include "core/native/step_transaction.hpp"

#include <algorithm>

#include "core/native/contact_kinematics.hpp"

namespace holdfast::internal::native {

StepTransaction::StepTransaction(WorldState& world, IslandStepper& stepper, const NativeOptions& options,
                                 Counters& counters, Status& status)
    : world_(world),
      scene_(world.scene),
      stepper_(stepper),
      options_(options),
      counters_(counters),
      status_(status),
      before_(scene_.bodies.state),
      before_last_step_(scene_.bodies.count()),
      reports_(scene_.bodies.count()) {}

void StepTransaction::correct_positions() {
  for (std::size_t i = 0; i < world_.islands.size(); ++i)
    if (moves(world_.islands[i])) stepper_.correct_positions(scene_, world_.islands[i], world_.terms);
}

void StepTransaction::take(double step) {
  world_.terms.set_step(step);
  unsolved_.assign(scene_.bodies.count(), 0);
  unit_ = world_.terms.velocity_unit > 0.0 ? world_.terms.velocity_unit : 1.0;
  attempt(step, 0, 0);
}

/// All bodies of an island move, or none does.
bool StepTransaction::moves(const IslandView& island) const {
  return scene_.bodies.activity[island.bodies.front()] == Activity::moving;
}

void StepTransaction::save(const IslandView& island) {
  const Bodies& bodies = scene_.bodies;
  for (const std::uint32_t body : island.bodies) {
    for_each_state_column([&](const char*, const auto& from, auto& to) { to[body] = from[body]; }, bodies.state,
                          before_);
    before_last_step_[body] = bodies.last_step[body];
  }
}

void StepTransaction::restore(std::size_t body) {
  Bodies& bodies = scene_.bodies;
  for_each_state_column([&](const char*, const auto& from, auto& to) { to[body] = from[body]; }, before_, bodies.state);
  bodies.last_step[body] = before_last_step_[body];
  bodies.update_shape(body);
}

/// Where the bodies were, and what they had done to the sides, when the step began.
StepTransaction::Start StepTransaction::start_of_step() const {
  const Bodies& bodies = scene_.bodies;
  Start start{bodies.state, bodies.last_step, bodies.activity, scene_.side_forces.sum()};
  for (std::size_t i = 0; i < bodies.count(); ++i) {
    if (bodies.activity[i] != Activity::moving) continue;
    for_each_state_column([&](const char*, const auto& from, auto& to) { to[i] = from[i]; }, before_, start.state);
    start.last_step[i] = before_last_step_[i];
  }
  return start;
}

/// Takes the world back to the start of the step.
void StepTransaction::go_back(const Start& start) {
  Bodies& bodies = scene_.bodies;
  before_ = start.state;
  before_last_step_ = start.last_step;
  scene_.side_forces.set_sum(start.side_impulses);
  std::vector<std::uint8_t> moved(bodies.count(), 0);
  for (std::size_t i = 0; i < moved.size(); ++i) {
    if (start.activity[i] != Activity::moving && bodies.activity[i] != Activity::moving) continue;
    moved[i] = 1;
    restore(i);
  }
  bodies.activity = start.activity;
  world_.find_contacts(moved);
}

void StepTransaction::attempt(double step, int halvings, int attempts) {
  world_.terms.set_step(step);
  if (activate_predicted() || halvings > 0 || attempts > 0) {
    world_.find_islands();
    spread_motion();
  }
  world_.contacts.forget_missed(scene_.bodies.count());
  step_islands();
  world_.contacts.find_tunnelled(scene_, world_.terms, before_);
  world_.find_contacts(scene_.bodies.marked(Activity::moving));
  if (spread_failure() && halvings < kHalvings) {
    retake(step, halvings, attempts);
  } else {
    accept(scene_.bodies.marked(Activity::moving));
    world_.rest.add_pushes(scene_, world_.terms, step, stepper_.rest_proof());
    if (scene_.side_forces.wanted()) scene_.side_forces.add_sleeping(scene_, world_.terms, step);
  }
}

/// Activates the pairs that would overlap after the step if velocities changed as in the last one: the step would have
/// to be solved again with them.
bool StepTransaction::activate_predicted() {
  const Bodies& bodies = scene_.bodies;
  const StepTerms& terms = world_.terms;
  const auto mean_twist = [&](std::int32_t body) -> Twist {
    if (body < 0 || bodies.activity[at(body)] != Activity::moving) return {};
    const std::size_t i = at(body);
    return {bodies.state.position[i], bodies.state.velocity[i] + 0.5 * terms.step * bodies.last_step[i].acceleration,
            bodies.state.angular_velocity[i] + 0.5 * terms.step * bodies.last_step[i].angular_acceleration};
  };
  bool any = false;
  for (Manifold& manifold : scene_.manifolds) {
    if (manifold.active || !has_end_in(manifold, bodies, Activity::moving)) continue;
    if (has_end_in(manifold, bodies, Activity::ahead)) continue;
    const RelativeTwist mean(mean_twist(manifold.a), mean_twist(manifold.b), manifold.contact.normal);
    // Little beside what a body falls in the step.
    const double overlap = penetration_slop(bodies, manifold, kSmall * terms.velocity_unit * terms.step);
    for (int i = 0; i < manifold.contact.count && !manifold.active; ++i) {
      const ContactPoint& point = manifold.contact.points[at(i)];
      const double u = mean.normal_velocity(point);
      if (point.gap + terms.step * u >= -overlap) continue;
      manifold.activate();
      any = true;
    }
  }
  return any;
}

/// Where a body of an island moves, all of its bodies do.
void StepTransaction::spread_motion() {
  std::vector<Activity>& activity = scene_.bodies.activity;
  for (std::size_t i = 0; i < world_.islands.size(); ++i) {
    const IslandView island = world_.islands[i];
    const auto is_moving = [&](std::uint32_t body) { return activity[body] == Activity::moving; };
    if (std::none_of(island.bodies.begin(), island.bodies.end(), is_moving)) continue;
    for (const std::uint32_t body : island.bodies) activity[body] = Activity::moving;
  }
}

void StepTransaction::step_islands() {
  const Connectivity& islands = world_.islands;
  scene_.undo.clear();
  scene_.side_forces.of_step().clear();
  for (std::size_t i = 0; i < islands.size(); ++i)
    if (moves(islands[i])) save(islands[i]);
  const auto advance = [&](const IslandView& island) {
    IslandReport report;
    StepTerms terms = world_.rest.terms_for(world_.terms, island);
    terms.implicit = std::any_of(island.bodies.begin(), island.bodies.end(),
                                 [&](std::uint32_t body) { return unsolved_[body] != 0; });
    stepper_.advance(scene_, island, terms, report);
    counters_.solve_iterations += report.iterations;
    // An island that steps again overwrites its first report.
    for (const std::uint32_t body : island.bodies) reports_[body] = report;
  };
  for (std::size_t i = 0; i < islands.size(); ++i)
    if (moves(islands[i])) advance(islands[i]);
  while (merge_overlapping()) {
    world_.find_islands();
    for (std::size_t i = 0; i < islands.size(); ++i) {
      const IslandView island = islands[i];
      const auto is_restored = [&](std::uint32_t body) { return restored_[body] != 0; };
      if (std::any_of(island.bodies.begin(), island.bodies.end(), is_restored)) advance(island);
    }
  }
}

/// Activates the pairs of different islands that overlap after the step, and puts their islands back to the start of
/// the step. False where there are none.
bool StepTransaction::merge_overlapping() {
  Bodies& bodies = scene_.bodies;
  const Connectivity& islands = world_.islands;
  merged_.assign(islands.size(), 0);
  bool any = false;
  const auto shift = [&](std::int32_t body, const Vec3& point) -> Vec3 {
    if (body < 0 || bodies.activity[at(body)] != Activity::moving) return Vec3::Zero();
    const std::size_t i = at(body);
    // How far the body's point has moved.
    const Rotation turn = bodies.state.orientation[i] * before_.orientation[i].conjugate();
    return bodies.state.position[i] + turn * (point - before_.position[i]) - point;
  };
  for (Manifold& manifold : scene_.manifolds) {
    if (manifold.active || stays(bodies, manifold.a) || stays(bodies, manifold.b)) continue;
    const std::uint32_t of_a = islands.of(at(manifold.a));
    const std::uint32_t of_b = islands.of(at(manifold.b));
    if (of_a == of_b || !has_end_in(manifold, bodies, Activity::moving)) continue;
    if (has_end_in(manifold, bodies, Activity::ahead)) continue;
    const std::size_t together = islands[of_a].bodies.size() + islands[of_b].bodies.size();
    const double overlap = penetration_slop(bodies, manifold, options_.effort(together).penetration_slop);
    for (int i = 0; i < manifold.contact.count && !manifold.active; ++i) {
      const ContactPoint& point = manifold.contact.points[at(i)];
      const double gap =
          point.gap + manifold.contact.normal.dot(shift(manifold.b, point.on_b) - shift(manifold.a, point.on_a));
      if (gap >= -overlap) continue;
      manifold.activate();
      merged_[of_a] = merged_[of_b] = 1;
      any = true;
    }
  }
  if (!any) return false;
  restored_.assign(bodies.count(), 0);
  for (std::size_t i = 0; i < islands.size(); ++i) {
    if (merged_[i] == 0) continue;
    const IslandView island = islands[i];
    if (!moves(island)) save(island);
    for (const std::uint32_t body : island.bodies) {
      restored_[body] = 1;
      bodies.activity[body] = Activity::moving;  // islands that are merged move
      restore(body);
    }
  }
  // Backwards, so that the first of several copies of a manifold counts. Active manifolds stay active.
  for (auto copy = scene_.undo.rbegin(); copy != scene_.undo.rend(); ++copy) {
    Manifold& manifold = scene_.manifolds[copy->first];
    if (!has_end_in(manifold, restored_)) continue;
    const bool active = manifold.active;
    manifold = copy->second;
    manifold.active = active;
  }
  scene_.side_forces.forget(restored_);
  std::erase_if(scene_.undo, [&](const auto& copy) { return has_end_in(scene_.manifolds[copy.first], restored_); });
  return true;
}

/// Marks all bodies whose islands have to take the step again: two of their bodies overlap whose contact did not show
/// it, or have passed through each other, or the solve has not converged. True where there are any.
bool StepTransaction::spread_failure() {
  failed_ = world_.contacts.missed();
  for (std::size_t i = 0; i < failed_.size(); ++i) {
    if (scene_.bodies.activity[i] != Activity::moving) continue;
    if (residual_of(i) > kWorstResidual) failed_[i] = unsolved_[i] = 1;
    if (reports_[i].missed_contact) failed_[i] = 1;
  }
  for (std::size_t k = 0; k < world_.islands.size(); ++k) {
    const IslandView island = world_.islands[k];
    const auto has_failed = [&](std::uint32_t body) { return failed_[body] != 0; };
    const bool any = moves(island) && std::any_of(island.bodies.begin(), island.bodies.end(), has_failed);
    for (const std::uint32_t body : island.bodies) failed_[body] = any ? 1 : 0;
  }
  return std::any_of(failed_.begin(), failed_.end(), [](std::uint8_t failed) { return failed != 0; });
}

/// Takes the step again, the islands that have failed alone, while the others stay where it has taken them. Where the
/// two then overlap, all take it in halves.
void StepTransaction::retake(double step, int halvings, int attempts) {
  Bodies& bodies = scene_.bodies;
  const auto take_halves = [&] {
    attempt(0.5 * step, halvings + 1, 0);
    attempt(0.5 * step, halvings + 1, 0);
    world_.terms.set_step(step);
  };
  const Start start = start_of_step();
  std::vector<SidePush> pushes = scene_.side_forces.of_step();
  std::vector<std::uint8_t> done(bodies.count(), 0);
  for (std::size_t i = 0; i < done.size(); ++i) {
    if (bodies.activity[i] != Activity::moving) continue;
    if (failed_[i] != 0) {
      restore(i);
    } else {
      bodies.activity[i] = Activity::ahead;
      done[i] = 1;
    }
  }
  const std::vector<Contacts::Late> late =
      attempts < kLateContactRounds ? world_.contacts.late_at_start(scene_) : std::vector<Contacts::Late>();
  world_.find_contacts(bodies.marked(Activity::moving));
  if (late.empty()) {
    take_halves();
  } else {
    world_.contacts.set(scene_, late);
    attempt(step, halvings, attempts + 1);
  }
  if (overlap_with(done)) {
    go_back(start);
    take_halves();
    return;
  }
  // What the others have done counts once it is sure that they have not done it in vain.
  std::erase_if(pushes, [&](const SidePush& push) { return done[push.body] == 0; });
  scene_.side_forces.of_step() = std::move(pushes);
  for (std::size_t i = 0; i < done.size(); ++i)
    if (done[i] != 0) bodies.activity[i] = Activity::moving;
  accept(done);
}

/// Whether bodies that have taken the step overlap with others that have taken it in halves.
bool StepTransaction::overlap_with(const std::vector<std::uint8_t>& done) const {
  const double overlap = options_.large_island.penetration_slop;
  return std::any_of(scene_.manifolds.begin(), scene_.manifolds.end(), [&](const Manifold& manifold) {
    return !manifold.active && !manifold.with_side() && has_end_in(manifold, done) &&
           has_end_in(manifold, scene_.bodies, Activity::moving) && manifold.nearest_gap < -overlap;
  });
}

/// Residual of a body's island, over |g − a| times a whole step, also where it is halved; of its impacts, over theirs.
double StepTransaction::residual_of(std::size_t body) const {
  return std::max(reports_[body].residual / unit_, reports_[body].impact_residual);
}

/// Accepts the step of bodies: counts what it has cost and reached, and lets go of contacts that carry nothing.
/// @param moved a body: not 0 where it is meant
void StepTransaction::accept(const std::vector<std::uint8_t>& moved) {
  double residual = 0.0;
  for (std::size_t i = 0; i < moved.size(); ++i)
    if (moved[i] != 0) residual = std::max(residual, residual_of(i));
  counters_.note_residual(residual * unit_, unit_);
  if (residual > kWorstResidual) status_ = status_ | Status::not_converged;
  scene_.side_forces.accept_step();
  for (Manifold& manifold : scene_.manifolds) {
    if (!has_end_in(manifold, moved) || has_end_in(manifold, scene_.bodies, Activity::ahead)) continue;
    const double nearest = manifold.nearest_gap;
    counters_.max_penetration = std::max(counters_.max_penetration, -nearest);
    if (!manifold.active) continue;
    const bool carries = manifold.carries();
    manifold.idle_steps = carries ? 0 : manifold.idle_steps + 1;
    if (manifold.idle_steps > kHorizon || (!carries && nearest > kContactTolerance)) manifold.deactivate();
  }
}

}  // namespace holdfast::internal::native
