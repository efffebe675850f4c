#include "core/native/native_world.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <tuple>

#include "core/engine/step_plan.hpp"
#include "core/model/container_sides.hpp"
#include "core/native/contact_kinematics.hpp"

namespace holdfast::internal::native {

namespace {

/// Manifolds of a box, about as many as in a dense packing: memory that is reserved at once costs less than memory that
/// grows.
constexpr std::size_t kLikelyManifolds = 8;

std::vector<Side> sides_of(const ContainerSettings& container, double friction, const std::vector<OrientedBox>& boxes) {
  std::vector<Side> sides;
  for (const ContainerSide& side : closed_sides(container)) {
    Vec3 normal = Vec3::Zero();
    normal[side.axis] = side.far ? -1.0 : 1.0;
    Side& made = sides.emplace_back();
    made.index = side.index;
    made.space = {normal, side.far ? -container.size[side.axis] : 0.0};
    made.surface = {side.kind, friction, 0.0};
    made.play.assign(boxes.size(), 0.0);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const ContactSet contact = contact_of(made.space, boxes[i], kLeastPlay);
      if (contact.count > 0) made.play[i] = side_play(side.kind, contact.nearest_gap());
    }
  }
  return sides;
}

}  // namespace

NativeWorld::NativeWorld(const WorldBatch& batch, const World& world, const Settings& settings,
                         const NativeOptions& options, std::unique_ptr<ContactSolver> solver)
    : world_(world),
      options_(options),
      gravity_(0.0, 0.0, -settings.gravity),
      contact_(world.contact),
      stepper_(options, std::move(solver)) {
  scene_.bodies = bodies_of(batch, world);
  scene_.sides = sides_of(settings.container, world.container_friction, scene_.bodies.shape);
  scene_.notes_pushes = settings.screening.measures_walls();
  const std::size_t count = scene_.bodies.count();
  scene_.manifolds.reserve(kLikelyManifolds * count);
  resting_.assign(count, 0);
  moving_.assign(count, 0);
  refuted_.assign(count, 0);
  undecided_.assign(count, 0);
  wait_.assign(count, 0);
  next_wait_.assign(count, 0);
  before_ = scene_.bodies.state;
  before_acceleration_.resize(count);
  reports_.resize(count);

  double strongest = 0.0;
  for (const Segment& segment : world.acceleration->segments)
    strongest = std::max(strongest, segment.acceleration.norm());
  terms_.longest_step = 1.0 / options_.steps_per_second;
  terms_.fall_margin = fall_margin(strongest);
  find_contacts(std::vector<std::uint8_t>(count, 1));
  for (Manifold& manifold : scene_.manifolds) {
    const auto& points = manifold.contact.points;
    manifold.active = supports(scene_.bodies, manifold) &&
                      std::any_of(points.begin(), points.begin() + manifold.contact.count,
                                  [](const ContactPoint& p) { return p.gap <= kContactTolerance; });
  }
}

/// What a body moves in a step under gravity and an acceleration in the worst direction, m.
double NativeWorld::fall_margin(double acceleration) const {
  return terms_.longest_step * terms_.longest_step * (-gravity_.z() + acceleration);
}

void NativeWorld::mark() {
  mark_ = {scene_, pairs_, broad_phase_, terms_, resting_, wait_, next_wait_};
  phase_set_ = false;
}

void NativeWorld::rewind() {
  scene_ = mark_.scene;
  pairs_ = mark_.pairs;
  broad_phase_ = mark_.broad_phase;
  terms_ = mark_.terms;
  resting_ = mark_.resting;
  wait_ = mark_.wait;
  next_wait_ = mark_.next_wait;
  phase_set_ = false;
}

void NativeWorld::begin_phase(const Phase& phase) {
  if (phase_set_ && !disturbed_ && phase.begin == phase_begin_) return;
  phase_set_ = true;
  phase_begin_ = phase.begin;
  phase_step_ = 0;
  const Vec3 effective_gravity = gravity_ - phase.acceleration;
  terms_.reset_warm_start = disturbed_ || effective_gravity != terms_.effective_gravity;
  terms_.effective_gravity = effective_gravity;
  disturbed_ = false;
  if (!terms_.reset_warm_start) return;
  find_farther_contacts(phase.acceleration);
  std::fill(resting_.begin(), resting_.end(), 0);
  std::fill(wait_.begin(), wait_.end(), 0);
  std::fill(next_wait_.begin(), next_wait_.end(), 0);
}

/// Looks for contacts as far away as the accelerations from now on ask for, where that is farther than before: nobody
/// has announced those that a caller sets, nor what forces from outside give.
void NativeWorld::find_farther_contacts(const Vec3& acceleration) {
  const Bodies& bodies = scene_.bodies;
  double largest_push = 0.0;
  for (std::size_t i = 0; i < bodies.count(); ++i) {
    if (bodies.fixed[i] != 0 || bodies.pushed[i].force == Vec3::Zero()) continue;
    const Vec3 turn = bodies.inertia(i).inverse() * bodies.torque(i);
    largest_push =
        std::max(largest_push, bodies.pushed[i].force.norm() / bodies.mass[i] + bodies.radius[i] * turn.norm());
  }
  const double margin = fall_margin(acceleration.norm() + largest_push);
  if (margin <= terms_.fall_margin) return;
  terms_.fall_margin = margin;
  find_contacts(std::vector<std::uint8_t>(bodies.count(), 1));
}

void NativeWorld::set_force(std::size_t box, const BoxForce& force) {
  Bodies& bodies = scene_.bodies;
  const auto body = std::find(bodies.world_box.begin(), bodies.world_box.end(), box) - bodies.world_box.begin();
  bodies.pushed[static_cast<std::size_t>(body)] = force;
  disturbed_ = true;
}

void NativeWorld::set_friction(const ContactSettings& contact) {
  contact_ = contact;
  for (Manifold& manifold : scene_.manifolds) {
    set_surfaces(manifold);
    // Forces that balanced may lie outside of the new cones, and would pass as a proof of rest.
    for (CachedImpulse& cached : manifold.cached) cached = {.pressed = cached.pressed};
  }
  disturbed_ = true;
}

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
  const auto speed = [&](std::int32_t body, const Vec3& point) -> Vec3 {
    if (body < 0 || moving_[at(body)] == 0) return Vec3::Zero();
    const std::size_t i = at(body);
    const Vec3 v = bodies.state.velocity[i] + 0.5 * terms_.step * bodies.acceleration[i];
    const Vec3 w = bodies.state.angular_velocity[i] + 0.5 * terms_.step * bodies.angular_acceleration[i];
    return v + w.cross(point - bodies.state.position[i]);
  };
  bool any = false;
  for (Manifold& manifold : scene_.manifolds) {
    if (manifold.active || !has_end_in(manifold, moving_)) continue;
    for (int i = 0; i < manifold.contact.count && !manifold.active; ++i) {
      const ContactPoint& point = manifold.contact.points[at(i)];
      const double u = manifold.contact.normal.dot(speed(manifold.b, point.on_b) - speed(manifold.a, point.on_a));
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
    if (manifold.active || manifold.a < 0 || bodies.fixed[at(manifold.a)] != 0 || bodies.fixed[at(manifold.b)] != 0)
      continue;
    const std::uint32_t of_a = connectivity_.of(at(manifold.a));
    const std::uint32_t of_b = connectivity_.of(at(manifold.b));
    if (of_a == of_b || !has_end_in(manifold, moving_)) continue;
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

double NativeWorld::step_islands() {
  scene_.undo.clear();
  scene_.pushes.clear();
  for (std::size_t i = 0; i < connectivity_.size(); ++i) {
    if (moving_[connectivity_[i].bodies.front()] != 0) save(connectivity_[i]);
  }
  const auto advance = [&](const IslandView& island) {
    IslandReport report;
    stepper_.advance(scene_, island, terms_, report);
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
  double worst = 0.0;
  for (std::size_t i = 0; i < moving_.size(); ++i) {
    if (moving_[i] == 0) continue;
    // In units of a whole step, also where it is halved.
    worst = std::max(worst, reports_[i].residual / whole_step_unit_);
    missed_contact_ = missed_contact_ || reports_[i].missed_contact;
  }
  return worst;
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

void NativeWorld::take_step(double step, int halvings) {
  terms_.step = step;
  terms_.velocity_unit = terms_.effective_gravity.norm() * step;
  if (activate_predicted() || halvings > 0) {
    connectivity_.find(scene_.bodies, scene_.manifolds);
    spread_motion();
  }
  missed_contact_ = false;
  const double residual = step_islands();
  missed_contact_ = missed_contact_ || has_tunnelled(step);
  find_contacts(moving_);
  if ((!missed_contact_ && residual <= kWorstResidual) || halvings == kHalvings) {
    counters_.note_residual(residual * whole_step_unit_, whole_step_unit_);
    if (residual > kWorstResidual) status_ = status_ | Status::not_converged;
    add_moving_pushes();
    add_resting_pushes(step);
    finish_step();
    return;
  }
  // Goes back to the start of the step, and takes it in two halves.
  for (std::size_t i = 0; i < moving_.size(); ++i)
    if (moving_[i] != 0) restore(i);
  find_contacts(moving_);
  take_step(0.5 * step, halvings + 1);
  take_step(0.5 * step, halvings + 1);
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
    if (!has_end_in(manifold, moving_)) continue;
    const double nearest = manifold.contact.nearest_gap();
    counters_.max_penetration = std::max(counters_.max_penetration, -nearest);
    if (!manifold.active) continue;
    bool carries = false;
    for (int i = 0; i < manifold.contact.count; ++i)
      carries = carries || manifold.cached[at(i)].force.dot(manifold.contact.normal) > 0.0;
    manifold.idle_steps = carries ? 0 : manifold.idle_steps + 1;
    if (manifold.idle_steps > kIdleSteps || (!carries && nearest > kContactTolerance)) manifold.active = false;
  }
}

double NativeWorld::advance(const Phase& phase) {
  const double time = take_next_step(phase);
  // A state that is not finite is no bug: the caller ends the world there.
  assert(!has_finite_state(view()) || broken_invariants(view()).empty());
  return time;
}

double NativeWorld::take_next_step(const Phase& phase) {
  side_impulses_ = {};
  begin_phase(phase);
  const StepPlan plan(phase, options_.steps_per_second);
  terms_.step = plan.step();
  terms_.velocity_unit = terms_.effective_gravity.norm() * terms_.step;
  whole_step_unit_ = terms_.velocity_unit > 0.0 ? terms_.velocity_unit : 1.0;
  const bool any_moving = find_moving();
  if (!any_moving && options_.jump) {
    const std::uint64_t left = plan.step_count() - phase_step_;
    add_resting_pushes(plan.step() * static_cast<double>(left));
    counters_.steps += left;
    counters_.steps_skipped += left;
    phase_step_ = plan.step_count();
    terms_.reset_warm_start = false;
    return phase.end;
  }
  if (any_moving) take_step(plan.step(), 0);
  if (!any_moving) add_resting_pushes(plan.step());
  terms_.reset_warm_start = false;
  ++counters_.steps;
  if (!any_moving) ++counters_.steps_skipped;
  return plan.end_of(phase_step_++);
}

void NativeWorld::read_back(StateColumns& state) const {
  const std::vector<std::uint32_t>& box = scene_.bodies.world_box;
  for_each_state_column(
      [&](const char*, const auto& from, auto& to) {
        for (std::size_t i = 0; i < box.size(); ++i) to[world_.box_begin + box[i]] = from[i];
      },
      scene_.bodies.state, state);
}

}  // namespace holdfast::internal::native
