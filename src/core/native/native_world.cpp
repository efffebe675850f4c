#include "core/native/native_world.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/engine/step_plan.hpp"
#include "core/model/container_sides.hpp"
#include "core/native/island_motion.hpp"

namespace holdfast::internal::native {

namespace {

/// Supports with gaps up to this carry load when a world starts, and contacts without load stay active up to it, m.
constexpr double kStartTouch = 1e-5;

/// Manifolds of a box, about as many as there are in a snug load: room made at once costs less than room that grows.
constexpr std::size_t kLikelyManifolds = 8;

/// Solved steps without load after which a manifold is no longer active.
constexpr int kIdleSteps = 8;

/// Times that a step is halved to see contacts in time that none showed before, or to get on where a solve does not.
constexpr int kHalvings = 4;

/// A residual above this, over |g − a| h, is reported with the world: it moves a box by half of what it falls freely
/// in a step.
constexpr double kBadResidual = 0.5;

std::vector<Side> sides_of(const ContainerSettings& container, const std::vector<OrientedBox>& boxes) {
  std::vector<Side> sides;
  for (const ContainerSide& side : closed_sides(container)) {
    Vec3 normal = Vec3::Zero();
    normal[side.axis] = side.far ? -1.0 : 1.0;
    Side& made = sides.emplace_back();
    made.space = {normal, side.far ? -container.size[side.axis] : 0.0};
    made.surface = {side.kind, container.friction, 0.0};
    made.play.assign(boxes.size(), 0.0);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const ContactSet contact = contact_of(made.space, boxes[i], kLeastPlay);
      if (contact.count > 0) made.play[i] = side_play(side.kind, contact.nearest_gap());
    }
  }
  return sides;
}

/// Whether two boxes went from one side of each other to the other.
/// @param before,after from the one's centre to the other's, m
/// @param room         how near these can be, along each axis, before the boxes overlap, m
/// @param slack        overlap along an axis that does not count, m
bool have_passed(const Vec3& before, const Vec3& after, const Vec3& room, double slack) {
  for (int k = 0; k < 3; ++k) {
    if (!(before[k] * after[k] < 0.0)) continue;
    if (std::min(std::abs(before[k]), std::abs(after[k])) < room[k] - slack) continue;
    // Where they were level along this axis, were they across each other along the others?
    Vec3 level = (before + before[k] / (before[k] - after[k]) * (after - before)).cwiseAbs();
    level[k] = 0.0;
    if ((level.array() < room.array()).all()) return true;
  }
  return false;
}

}  // namespace

NativeWorld::NativeWorld(const WorldBatch& batch, const World& world, const Settings& settings,
                         const NativeOptions& options)
    : world_(world),
      options_(options),
      gravity_(0.0, 0.0, -settings.gravity),
      contact_(settings.contact),
      stepper_(options) {
  scene_.bodies = bodies_of(batch, world);
  scene_.sides = sides_of(settings.container, scene_.bodies.shape);
  const std::size_t count = scene_.bodies.count();
  slot_.assign(count * (count + scene_.sides.size()), -1);
  scene_.manifolds.reserve(kLikelyManifolds * count);
  resting_.assign(count, 0);
  moving_.assign(count, 0);
  leaves_.assign(count, 0);
  undecided_.assign(count, 0);
  wait_.assign(count, 0);
  patience_.assign(count, 0);
  before_ = scene_.bodies.state;
  before_acceleration_.resize(count);
  reports_.resize(count);

  double strongest = 0.0;
  for (const Segment& segment : world.acceleration->segments)
    strongest = std::max(strongest, segment.acceleration.norm());
  terms_.longest_step = 1.0 / options_.steps_per_second;
  terms_.reach = terms_.longest_step * terms_.longest_step * (settings.gravity + strongest);
  find_contacts(std::vector<std::uint8_t>(count, 1));
  for (Manifold& manifold : scene_.manifolds) {
    const auto& points = manifold.contact.points;
    manifold.active =
        supports(scene_.bodies, manifold) && std::any_of(points.begin(), points.begin() + manifold.contact.count,
                                                         [](const ContactPoint& p) { return p.gap <= kStartTouch; });
  }
}

/// Place in `slot_` of the pair of body or side `a` and body `b`; of two bodies `a` is the first.
std::size_t NativeWorld::slot_index(std::int32_t a, std::int32_t b) const {
  const std::size_t count = scene_.bodies.count();
  const std::size_t other = a < 0 ? count + static_cast<std::size_t>(-1 - a) : at(a);
  return at(b) * (count + scene_.sides.size()) + other;
}

void NativeWorld::update_pair(std::int32_t a, std::int32_t b) {
  const Bodies& bodies = scene_.bodies;
  std::int32_t& slot = slot_[slot_index(a, b)];
  static const ContactSet kNone;
  const ContactSet& before = slot < 0 ? kNone : scene_.manifolds[at(slot)].contact;
  const ContactSet contact = contact_now(bodies, scene_.sides, a, b, contact_reach(terms_, bodies, a, b), before.axis);
  if (overlaps_unseen(contact, before, options_.deep_overlap)) met_deep_ = true;
  if (slot >= 0 && contact.count > 0) {
    renew_contact(scene_.manifolds[at(slot)], contact, bodies);
  } else if (slot >= 0) {
    end_manifold(at(slot));
  } else if (contact.count > 0) {
    const Surface& on_a = a < 0 ? scene_.sides[static_cast<std::size_t>(-1 - a)].surface : bodies.surface[at(a)];
    slot = static_cast<std::int32_t>(scene_.manifolds.size());
    Manifold& manifold = scene_.manifolds.emplace_back();
    manifold.a = a;
    manifold.b = b;
    manifold.friction = friction_of_pair(contact_, on_a, bodies.surface[at(b)]);
    manifold.restitution = restitution_of_pair(on_a, bodies.surface[at(b)]);
    renew_contact(manifold, contact, bodies);
  }
}

void NativeWorld::end_manifold(std::size_t index) {
  const auto slot_of = [&](const Manifold& manifold) -> std::int32_t& {
    return slot_[slot_index(manifold.a, manifold.b)];
  };
  slot_of(scene_.manifolds[index]) = -1;
  if (index + 1 < scene_.manifolds.size()) {
    slot_of(scene_.manifolds.back()) = static_cast<std::int32_t>(index);
    scene_.manifolds[index] = scene_.manifolds.back();
  }
  scene_.manifolds.pop_back();
}

void NativeWorld::find_contacts(const std::vector<std::uint8_t>& moved) {
  const Bodies& bodies = scene_.bodies;
  const std::size_t count = bodies.count();
  lower_.resize(count);
  upper_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const OrientedBox& box = bodies.shape[i];
    const double speed = bodies.state.velocity[i].norm() + bodies.spin(i);
    const Vec3 extent = box.reach_along_axes().array() + 0.5 * contact_reach(terms_, 2.0 * speed);
    lower_[i] = box.centre - extent;
    upper_[i] = box.centre + extent;
    if (moved[i] == 0 || bodies.fixed[i] != 0) continue;
    for (std::size_t s = 0; s < scene_.sides.size(); ++s)
      update_pair(-1 - static_cast<std::int32_t>(s), static_cast<std::int32_t>(i));
  }
  // Pairs that are no longer near end; backwards, because the last manifold takes the place of one that ends.
  for (std::size_t m = scene_.manifolds.size(); m-- > 0;) {
    const Manifold& manifold = scene_.manifolds[m];
    if (manifold.with_side()) continue;
    const std::size_t a = at(manifold.a);
    const std::size_t b = at(manifold.b);
    const bool near = (lower_[a].array() <= upper_[b].array()).all() && (lower_[b].array() <= upper_[a].array()).all();
    if ((moved[a] != 0 || moved[b] != 0) && !near) end_manifold(m);
  }
  for (const IndexPair& pair : broad_phase_.find_pairs(lower_, upper_, moved))
    if (bodies.fixed[pair.i] == 0 || bodies.fixed[pair.j] == 0)
      update_pair(static_cast<std::int32_t>(pair.i), static_cast<std::int32_t>(pair.j));
}

void NativeWorld::begin_phase(const Phase& phase) {
  if (phase_set_ && phase.begin == phase_begin_) return;
  phase_set_ = true;
  phase_begin_ = phase.begin;
  phase_step_ = 0;
  const Vec3 pull = gravity_ - phase.acceleration;
  terms_.cold = pull != terms_.pull;
  terms_.pull = pull;
  if (!terms_.cold) return;
  std::fill(resting_.begin(), resting_.end(), 0);
  std::fill(wait_.begin(), wait_.end(), 0);
  std::fill(patience_.begin(), patience_.end(), 0);
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

/// Activates the pairs that would overlap after the step if velocities changed as in the last one: solving without
/// them first would be in vain.
bool NativeWorld::activate_predicted() {
  const Bodies& bodies = scene_.bodies;
  const double overlap = least_overlap(terms_, 0.0);
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

/// Activates the pairs of different islands that overlap after the step. Where there are any, their islands are put
/// back to the start of the step.
bool NativeWorld::merge_overlapping() {
  Bodies& bodies = scene_.bodies;
  again_.assign(islands_.size(), 0);
  bool any = false;
  const auto shift = [&](std::int32_t body, const Vec3& point) -> Vec3 {
    if (body < 0 || moving_[at(body)] == 0) return Vec3::Zero();
    const std::size_t i = at(body);
    // Where the body's point has gone.
    const Rotation turn = bodies.state.orientation[i] * before_.orientation[i].conjugate();
    return bodies.state.position[i] + turn * (point - before_.position[i]) - point;
  };
  for (Manifold& manifold : scene_.manifolds) {
    if (manifold.active || manifold.a < 0 || bodies.fixed[at(manifold.a)] != 0 || bodies.fixed[at(manifold.b)] != 0)
      continue;
    const std::uint32_t of_a = islands_.of(at(manifold.a));
    const std::uint32_t of_b = islands_.of(at(manifold.b));
    if (of_a == of_b || !has_end_in(manifold, moving_)) continue;
    const std::size_t together = islands_[of_a].bodies.size() + islands_[of_b].bodies.size();
    const double overlap = least_overlap(terms_, options_.effort(together).late_overlap);
    for (int i = 0; i < manifold.contact.count && !manifold.active; ++i) {
      const ContactPoint& point = manifold.contact.points[at(i)];
      const double gap =
          point.gap + manifold.contact.normal.dot(shift(manifold.b, point.on_b) - shift(manifold.a, point.on_a));
      if (gap >= -overlap) continue;
      manifold.activate();
      again_[of_a] = again_[of_b] = 1;
      any = true;
    }
  }
  if (!any) return false;
  restored_.assign(bodies.count(), 0);
  for (std::size_t i = 0; i < islands_.size(); ++i) {
    if (again_[i] == 0) continue;
    const IslandView island = islands_[i];
    if (moving_[island.bodies.front()] == 0) save(island);
    for (const std::uint32_t body : island.bodies) {
      restored_[body] = 1;
      resting_[body] = 0;
      restore(body);
    }
  }
  // Backwards: of several copies the first one counts. What is active stays active.
  for (auto copy = scene_.undo.rbegin(); copy != scene_.undo.rend(); ++copy) {
    Manifold& manifold = scene_.manifolds[copy->first];
    if (!has_end_in(manifold, restored_)) continue;
    const bool active = manifold.active;
    manifold = copy->second;
    manifold.active = active;
  }
  std::erase_if(scene_.undo, [&](const auto& copy) { return has_end_in(scene_.manifolds[copy.first], restored_); });
  // Who was merged moves now.
  for (std::size_t i = 0; i < bodies.count(); ++i)
    if (restored_[i] != 0) moving_[i] = 2;
  return true;
}

/// Whether a body that a blow has turned off its course has passed another in the step: contacts are looked for along
/// the courses at its start, and bodies that are apart again, or nearly, show nothing.
bool NativeWorld::has_passed_unseen(double step) const {
  const Bodies& bodies = scene_.bodies;
  const auto shift = [&](std::size_t i) -> Vec3 {
    if (moving_[i] == 0) return Vec3::Zero();
    return bodies.state.position[i] - before_.position[i];
  };
  for (std::size_t i = 0; i < bodies.count(); ++i) {
    if (moving_[i] == 0 || (shift(i) - step * before_.velocity[i]).norm() <= terms_.reach) continue;
    for (std::size_t j = 0; j < bodies.count(); ++j) {
      const auto first = static_cast<std::int32_t>(std::min(i, j));
      const auto second = static_cast<std::int32_t>(std::max(i, j));
      if (j == i || slot_[slot_index(first, second)] >= 0) continue;
      const OrientedBox& box = bodies.shape[i];
      const OrientedBox& other = bodies.shape[j];
      const Vec3 apart = box.centre - other.centre;
      const Vec3 room = box.reach_along_axes() + other.reach_along_axes();
      if (have_passed(apart - (shift(i) - shift(j)), apart, room, options_.deep_overlap)) return true;
    }
  }
  return false;
}

double NativeWorld::step_moving() {
  scene_.undo.clear();
  for (std::size_t i = 0; i < islands_.size(); ++i) {
    if (moving_[islands_[i].bodies.front()] != 0) save(islands_[i]);
  }
  const auto advance = [&](const IslandView& island) {
    IslandReport report;
    stepper_.advance(scene_, island, terms_, report);
    counters_.solve_iterations += report.iterations;
    // Whoever is put back and steps again overwrites what he came to first.
    for (const std::uint32_t body : island.bodies) reports_[body] = report;
  };
  for (std::size_t i = 0; i < islands_.size(); ++i)
    if (moving_[islands_[i].bodies.front()] != 0) advance(islands_[i]);
  while (merge_overlapping()) {
    islands_.find(scene_.bodies, scene_.manifolds);
    for (std::size_t i = 0; i < islands_.size(); ++i) {
      const IslandView view = islands_[i];
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
    met_deep_ = met_deep_ || reports_[i].met_deep;
  }
  return worst;
}

/// An island with a body that moves moves as a whole.
void NativeWorld::spread_motion() {
  for (std::size_t i = 0; i < islands_.size(); ++i) {
    const IslandView view = islands_[i];
    if (std::none_of(view.bodies.begin(), view.bodies.end(), [&](auto body) { return moving_[body] != 0; })) continue;
    for (const std::uint32_t body : view.bodies) {
      moving_[body] = 1;
      resting_[body] = 0;
    }
  }
}

void NativeWorld::take_step(double step, int halvings) {
  terms_.step = step;
  terms_.velocity_unit = terms_.pull.norm() * step;
  if (activate_predicted() || halvings > 0) {
    islands_.find(scene_.bodies, scene_.manifolds);
    spread_motion();
  }
  met_deep_ = false;
  const double residual = step_moving();
  met_deep_ = met_deep_ || has_passed_unseen(step);
  find_contacts(moving_);
  if ((!met_deep_ && residual <= kBadResidual) || halvings == kHalvings) {
    counters_.max_residual = std::max(counters_.max_residual, residual);
    if (residual > kBadResidual) status_ = status_ | Status::not_converged;
    finish_step();
    return;
  }
  // Back to the start, and on in two steps.
  for (std::size_t i = 0; i < moving_.size(); ++i)
    if (moving_[i] != 0) restore(i);
  find_contacts(moving_);
  take_step(0.5 * step, halvings + 1);
  take_step(0.5 * step, halvings + 1);
}

void NativeWorld::finish_step() {
  for (Manifold& manifold : scene_.manifolds) {
    if (!has_end_in(manifold, moving_)) continue;
    const double nearest = manifold.contact.nearest_gap();
    counters_.max_penetration = std::max(counters_.max_penetration, -nearest);
    if (!manifold.active) continue;
    bool loaded = false;
    for (int i = 0; i < manifold.contact.count; ++i)
      loaded = loaded || manifold.memory[at(i)].force.dot(manifold.contact.normal) > 0.0;
    manifold.idle_steps = loaded ? 0 : manifold.idle_steps + 1;
    if (manifold.idle_steps > kIdleSteps || (!loaded && nearest > kStartTouch)) manifold.active = false;
  }
}

double NativeWorld::advance(const Phase& phase) {
  begin_phase(phase);
  const StepPlan plan(phase, options_.steps_per_second);
  terms_.step = plan.step();
  terms_.velocity_unit = terms_.pull.norm() * terms_.step;
  whole_step_unit_ = terms_.velocity_unit > 0.0 ? terms_.velocity_unit : 1.0;
  const bool any_moving = find_moving();
  if (!any_moving && options_.jump) {
    const std::uint64_t left = plan.step_count() - phase_step_;
    counters_.steps += left;
    counters_.steps_skipped += left;
    phase_step_ = plan.step_count();
    terms_.cold = false;
    return phase.end;
  }
  if (any_moving) take_step(plan.step(), 0);
  terms_.cold = false;
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
