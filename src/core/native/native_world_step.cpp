// A step of a world: its islands one after the other, merged where they meet, and in halves where a step fails.

#include <algorithm>
#include <tuple>

#include "core/native/contact_kinematics.hpp"
#include "core/native/native_world.hpp"

namespace holdfast::internal::native {

void NativeWorld::save(const IslandView& island) {
  const Bodies& bodies = scene_.bodies;
  for (const std::uint32_t body : island.bodies) {
    for_each_state_column([&](const char*, const auto& from, auto& to) { to[body] = from[body]; }, bodies.state,
                          before_);
    before_acceleration_[body] = {bodies.acceleration[body], bodies.angular_acceleration[body]};
  }
}

void NativeWorld::restore(std::size_t body) {
  Bodies& bodies = scene_.bodies;
  for_each_state_column([&](const char*, const auto& from, auto& to) { to[body] = from[body]; }, before_, bodies.state);
  std::tie(bodies.acceleration[body], bodies.angular_acceleration[body]) = before_acceleration_[body];
  bodies.update_shape(body);
}

/// Activates the pairs that would overlap after the step if velocities changed as in the last one: the step would have
/// to be solved again with them.
bool NativeWorld::activate_predicted() {
  const Bodies& bodies = scene_.bodies;
  const double overlap = penetration_slop(terms_, 0.0);
  const auto mean_twist = [&](std::int32_t body) -> Twist {
    if (body < 0 || moving_[at(body)] == 0) return {};
    const std::size_t i = at(body);
    return {bodies.state.position[i], bodies.state.velocity[i] + 0.5 * terms_.step * bodies.acceleration[i],
            bodies.state.angular_velocity[i] + 0.5 * terms_.step * bodies.angular_acceleration[i]};
  };
  bool any = false;
  for (Manifold& manifold : scene_.manifolds) {
    if (manifold.active || !has_end_in(manifold, moving_) || has_end_in(manifold, ahead_)) continue;
    const RelativeTwist mean(mean_twist(manifold.a), mean_twist(manifold.b), manifold.contact.normal);
    for (int i = 0; i < manifold.contact.count && !manifold.active; ++i) {
      const ContactPoint& point = manifold.contact.points[at(i)];
      const double u = mean.normal_velocity(point);
      if (point.gap + terms_.step * u >= -overlap) continue;
      manifold.activate();
      any = true;
    }
  }
  return any;
}

/// Activates the pairs of different islands that overlap after the step, and puts their islands back to the start of
/// the step. False where there are none.
bool NativeWorld::merge_overlapping() {
  Bodies& bodies = scene_.bodies;
  merged_.assign(connectivity_.size(), 0);
  bool any = false;
  const auto shift = [&](std::int32_t body, const Vec3& point) -> Vec3 {
    if (body < 0 || moving_[at(body)] == 0) return Vec3::Zero();
    const std::size_t i = at(body);
    // How far the body's point has moved.
    const Rotation turn = bodies.state.orientation[i] * before_.orientation[i].conjugate();
    return bodies.state.position[i] + turn * (point - before_.position[i]) - point;
  };
  for (Manifold& manifold : scene_.manifolds) {
    if (manifold.active || stays(bodies, manifold.a) || stays(bodies, manifold.b)) continue;
    const std::uint32_t of_a = connectivity_.of(at(manifold.a));
    const std::uint32_t of_b = connectivity_.of(at(manifold.b));
    if (of_a == of_b || !has_end_in(manifold, moving_) || has_end_in(manifold, ahead_)) continue;
    const std::size_t together = connectivity_[of_a].bodies.size() + connectivity_[of_b].bodies.size();
    const double overlap = penetration_slop(terms_, options_.effort(together).penetration_slop);
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
  for (std::size_t i = 0; i < connectivity_.size(); ++i) {
    if (merged_[i] == 0) continue;
    const IslandView island = connectivity_[i];
    if (moving_[island.bodies.front()] == 0) save(island);
    for (const std::uint32_t body : island.bodies) {
      restored_[body] = 1;
      resting_[body] = 0;
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
  std::erase_if(scene_.pushes, [&](const SidePush& push) { return restored_[push.body] != 0; });
  std::erase_if(scene_.undo, [&](const auto& copy) { return has_end_in(scene_.manifolds[copy.first], restored_); });
  // Islands that are merged move.
  for (std::size_t i = 0; i < bodies.count(); ++i)
    if (restored_[i] != 0) moving_[i] = 2;
  return true;
}

void NativeWorld::step_islands() {
  scene_.undo.clear();
  scene_.pushes.clear();
  for (std::size_t i = 0; i < connectivity_.size(); ++i) {
    if (moving_[connectivity_[i].bodies.front()] != 0) save(connectivity_[i]);
  }
  const auto advance = [&](const IslandView& island) {
    IslandReport report;
    memory_->stepper.advance(scene_, island, terms_for(island), report);
    counters_.solve_iterations += report.iterations;
    // An island that steps again overwrites its first report.
    for (const std::uint32_t body : island.bodies) reports_[body] = report;
  };
  for (std::size_t i = 0; i < connectivity_.size(); ++i)
    if (moving_[connectivity_[i].bodies.front()] != 0) advance(connectivity_[i]);
  while (merge_overlapping()) {
    connectivity_.find(scene_.bodies, scene_.manifolds);
    for (std::size_t i = 0; i < connectivity_.size(); ++i) {
      const IslandView view = connectivity_[i];
      if (std::none_of(view.bodies.begin(), view.bodies.end(), [&](auto body) { return moving_[body] == 2; })) continue;
      for (const std::uint32_t body : view.bodies) moving_[body] = 1;
      advance(view);
    }
  }
}

void NativeWorld::correct_positions() {
  for (std::size_t i = 0; i < connectivity_.size(); ++i) {
    const IslandView island = connectivity_[i];
    if (moving_[island.bodies.front()] != 0) memory_->stepper.correct_positions(scene_, island, terms_);
  }
}

/// Where a body of an island moves, all of its bodies do.
void NativeWorld::spread_motion() {
  for (std::size_t i = 0; i < connectivity_.size(); ++i) {
    const IslandView view = connectivity_[i];
    if (std::none_of(view.bodies.begin(), view.bodies.end(), [&](auto body) { return moving_[body] != 0; })) continue;
    for (const std::uint32_t body : view.bodies) {
      moving_[body] = 1;
      resting_[body] = 0;
    }
  }
}

void NativeWorld::set_step(double step) {
  terms_.step = step;
  terms_.velocity_unit = terms_.effective_gravity.norm() * step;
}

void NativeWorld::take_step(double step, int halvings, int attempt) {
  set_step(step);
  if (activate_predicted() || halvings > 0 || attempt > 0) {
    connectivity_.find(scene_.bodies, scene_.manifolds);
    spread_motion();
  }
  failed_.assign(moving_.size(), 0);
  late_contacts_.clear();
  step_islands();
  mark_tunnelled(step);
  find_contacts(moving_);
  spread_failure();
  if (wake_what_jams()) {
    take_step(step, halvings, attempt);
    return;
  }
  if (halvings == kHalvings || std::none_of(failed_.begin(), failed_.end(), [](auto failed) { return failed != 0; }))
    accept_step(step);
  else
    retake_step(step, halvings, attempt);
}

/// Marks all moving bodies whose islands have to take the step again: two of their bodies overlap whose contact did not
/// show it, or have passed through each other, or the solve has not converged.
void NativeWorld::spread_failure() {
  for (std::size_t i = 0; i < moving_.size(); ++i)
    if (moving_[i] != 0 && (reports_[i].missed_contact || residual_of(i) > kWorstResidual)) failed_[i] = 1;
  for (std::size_t k = 0; k < connectivity_.size(); ++k) {
    const IslandView island = connectivity_[k];
    const auto failed = [&](std::uint32_t body) { return failed_[body] != 0; };
    const bool any =
        moving_[island.bodies.front()] != 0 && std::any_of(island.bodies.begin(), island.bodies.end(), failed);
    for (const std::uint32_t body : island.bodies) failed_[body] = any ? 1 : 0;
  }
}

/// Goes back to the start of the step with all bodies awake, where a solve has not converged: what moves may be wedged
/// between bodies that sleep, as if they were fixed. False where that is not so.
bool NativeWorld::wake_what_jams() {
  const auto is_marked = [](std::uint8_t mark) { return mark != 0; };
  const std::vector<std::uint8_t> asleep = scene_.bodies.asleep;
  if (std::none_of(asleep.begin(), asleep.end(), is_marked) || std::any_of(ahead_.begin(), ahead_.end(), is_marked))
    return false;
  bool jams = false;
  for (std::size_t i = 0; i < moving_.size(); ++i) jams = jams || (moving_[i] != 0 && residual_of(i) > kWorstResidual);
  if (!jams) return false;
  for (std::size_t i = 0; i < moving_.size(); ++i)
    if (moving_[i] != 0) restore(i);
  sleeping_.forget(asleep);
  sleeping_.wake(scene_);
  find_contacts(moving_);
  connectivity_.find(scene_.bodies, scene_.manifolds);
  spread_motion();
  return true;
}

/// Residual of a body's island, over |g − a| times a whole step, also where it is halved.
double NativeWorld::residual_of(std::size_t body) const { return reports_[body].residual / whole_step_unit_; }

/// Counts a step that the moving bodies have taken.
void NativeWorld::accept_moving() {
  double residual = 0.0;
  for (std::size_t i = 0; i < moving_.size(); ++i)
    if (moving_[i] != 0) residual = std::max(residual, residual_of(i));
  counters_.note_residual(residual * whole_step_unit_, whole_step_unit_);
  if (residual > kWorstResidual) status_ = status_ | Status::not_converged;
  add_moving_pushes();
  finish_step();
}

void NativeWorld::accept_step(double step) {
  accept_moving();
  add_resting_pushes(step);
  if (scene_.notes_pushes) add_sleeping_pushes(step);
}

/// Takes the contacts that showed too late back to where their bodies are now, at the start of the step. False where
/// there are none, or where one overlaps there: its normal is not that along which the bodies met.
bool NativeWorld::take_back_late_contacts() {
  for (LateContact& late : late_contacts_) {
    late.contact = carried_along(late.contact, late.found_at, poses_of(scene_.bodies, late.a, late.b));
    if (late.contact.nearest_gap() < -options_.missed_contact_overlap) return false;
  }
  return !late_contacts_.empty();
}

/// Takes the step again, the islands that have failed alone, while the others stay where it has taken them: with the
/// contacts that have shown too late, and in two halves where that does not help. Where the two then overlap, all take
/// it in halves.
void NativeWorld::retake_step(double step, int halvings, int attempt) {
  const auto take_halves = [&] {
    take_step(0.5 * step, halvings + 1);
    take_step(0.5 * step, halvings + 1);
    set_step(step);
  };
  const std::vector<std::uint8_t> moving = moving_;
  const std::vector<std::uint8_t> ahead = ahead_;
  const Start start = start_of_step();
  std::vector<SidePush> pushes = scene_.pushes;
  std::vector<std::uint8_t> done(moving.size(), 0);
  for (std::size_t i = 0; i < moving.size(); ++i) {
    if (moving[i] == 0) continue;
    if (failed_[i] != 0) {
      restore(i);
    } else {
      moving_[i] = 0;
      done[i] = ahead_[i] = 1;
    }
  }
  if (attempt < kLateContactRounds && take_back_late_contacts()) {
    const std::vector<LateContact> late = late_contacts_;
    find_contacts(moving_);
    for (const LateContact& found : late) set_contact(found.a, found.b, pairs_.find(found.a, found.b), found.contact);
    take_step(step, halvings, attempt + 1);
  } else {
    find_contacts(moving_);
    take_halves();
  }
  ahead_ = ahead;
  if (overlaps_with(done)) {
    go_back(start, moving);
    take_halves();
    return;
  }
  // What the others have done counts once it is sure that they have not done it in vain.
  const std::vector<std::uint8_t> halved = moving_;
  moving_ = done;
  std::erase_if(pushes, [&](const SidePush& push) { return done[push.body] == 0; });
  scene_.pushes = std::move(pushes);
  accept_moving();
  for (std::size_t i = 0; i < halved.size(); ++i)
    if (halved[i] != 0) moving_[i] = 1;
}

/// Where the bodies were, and what they had done to the sides, when the step began.
NativeWorld::Start NativeWorld::start_of_step() const {
  Start start{scene_.bodies.state, {}, side_impulses_};
  for (std::size_t i = 0; i < moving_.size(); ++i) {
    start.acceleration.emplace_back(scene_.bodies.acceleration[i], scene_.bodies.angular_acceleration[i]);
    if (moving_[i] == 0) continue;
    for_each_state_column([&](const char*, const auto& from, auto& to) { to[i] = from[i]; }, before_, start.state);
    start.acceleration[i] = before_acceleration_[i];
  }
  return start;
}

/// Back to the start of the step, with these bodies moving.
void NativeWorld::go_back(const Start& start, const std::vector<std::uint8_t>& moving) {
  before_ = start.state;
  before_acceleration_ = start.acceleration;
  side_impulses_ = start.side_impulses;
  std::vector<std::uint8_t> moved(moving);
  for (std::size_t i = 0; i < moved.size(); ++i) {
    if (moving_[i] != 0) moved[i] = 1;
    if (moved[i] != 0) restore(i);
  }
  moving_ = moving;
  find_contacts(moved);
}

/// Whether bodies that have taken the step overlap with others that have taken it in halves.
bool NativeWorld::overlaps_with(const std::vector<std::uint8_t>& done) const {
  const double overlap = penetration_slop(terms_, options_.large_island.penetration_slop);
  return std::any_of(scene_.manifolds.begin(), scene_.manifolds.end(), [&](const Manifold& manifold) {
    return !manifold.active && !manifold.with_side() && has_end_in(manifold, done) && has_end_in(manifold, moving_) &&
           manifold.nearest_gap < -overlap;
  });
}

/// Adds what moving bodies have done to the sides in a step that counts.
void NativeWorld::add_moving_pushes() {
  for (const SidePush& push : scene_.pushes) add_contact(side_impulses_, push.side, push.impulse, push.point);
}

/// Adds what resting bodies do to the sides.
void NativeWorld::add_resting_pushes(double duration) {
  for (const SidePush& push : scene_.resting_pushes)
    if (resting_[push.body] != 0) add_contact(side_impulses_, push.side, duration * push.impulse, push.point);
}

void NativeWorld::finish_step() {
  for (Manifold& manifold : scene_.manifolds) {
    if (!has_end_in(manifold, moving_) || has_end_in(manifold, ahead_)) continue;
    const double nearest = manifold.nearest_gap;
    counters_.max_penetration = std::max(counters_.max_penetration, -nearest);
    if (!manifold.active) continue;
    bool carries = false;
    for (int i = 0; i < manifold.contact.count; ++i)
      carries = carries || manifold.cached[at(i)].force.dot(manifold.contact.normal) > 0.0;
    manifold.idle_steps = carries ? 0 : manifold.idle_steps + 1;
    if (manifold.idle_steps > kIdleSteps || (!carries && nearest > kContactTolerance)) manifold.deactivate();
  }
}

}  // namespace holdfast::internal::native
