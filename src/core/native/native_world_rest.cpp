// Which islands of a world rest and which move, at the start of a step.

#include <algorithm>

#include "core/native/contact_kinematics.hpp"
#include "core/native/native_world.hpp"

namespace holdfast::internal::native {

/// The terms of a step for an island, with whether it is reset, and refuted.
StepTerms NativeWorld::terms_for(const IslandView& island) const {
  const auto all = [&](const std::vector<std::uint8_t>& mark) {
    return std::all_of(island.bodies.begin(), island.bodies.end(), [&](std::uint32_t body) { return mark[body] != 0; });
  };
  StepTerms terms = terms_;
  terms.reset_warm_start = gravity_changed_ && all(reset_);
  terms.refuted = all(refuted_);
  return terms;
}

/// Small islands are reset by any change of the acceleration: they are cheap, and as exact as under one that is
/// constant.
void NativeWorld::reset_small_islands() {
  for (std::size_t i = 0; i < connectivity_.size(); ++i) {
    const IslandView island = connectivity_[i];
    if (island.bodies.size() > kSmallIslandBodies) continue;
    for (const std::uint32_t body : island.bodies) reset_[body] = 1;
  }
}

/// Decides which islands rest and which move. True when any moves.
bool NativeWorld::find_moving() {
  connectivity_.find(scene_.bodies, scene_.manifolds);
  if (gravity_changed_) reset_small_islands();
  std::fill(refuted_.begin(), refuted_.end(), 0);
  std::fill(undecided_.begin(), undecided_.end(), 1);
  for (int round = 0;; ++round) {
    for (std::size_t i = 0; i < connectivity_.size(); ++i) {
      const IslandView view = connectivity_[i];
      const auto marked = [](const std::vector<std::uint8_t>& mark) {
        return [&](std::uint32_t body) { return mark[body] != 0; };
      };
      if (std::none_of(view.bodies.begin(), view.bodies.end(), marked(undecided_))) continue;
      const bool known = options_.freeze && std::all_of(view.bodies.begin(), view.bodies.end(), marked(resting_));
      const bool rests = known || (may_rest(scene_.bodies, view, terms_) && (round > 0 || is_due(view)) &&
                                   prove_rest(view, round > 0));
      if (rests) set_at_rest(view);
      if (rests && !known && scene_.notes_pushes) find_resting_pushes(view);
      for (const std::uint32_t body : view.bodies) {
        moving_[body] = rests ? 0 : 1;
        if (!rests) resting_[body] = 0;
        undecided_[body] = 0;
      }
    }
    if (!gravity_changed_ || round == kActivationRounds || !activate_leaning()) break;
    connectivity_.find(scene_.bodies, scene_.manifolds);
  }
  for (std::size_t i = 0; i < refuted_.size(); ++i) {
    if (refuted_[i] != 0) wait_[i] = next_wait_[i] = std::min(kLongestWait, std::max(1U, 2 * next_wait_[i]));
    if (moving_[i] == 0) wait_[i] = next_wait_[i] = 0;
  }
  return std::any_of(moving_.begin(), moving_.end(), [](std::uint8_t moving) { return moving != 0; });
}

/// Whether a proof of rest is tried in this step: after a proof that fails, some steps are taken first.
bool NativeWorld::is_due(const IslandView& island) {
  bool due = true;
  for (const std::uint32_t body : island.bodies) {
    if (wait_[body] == 0) continue;
    --wait_[body];
    due = false;
  }
  return due;
}

bool NativeWorld::prove_rest(const IslandView& island, bool leans) {
  IslandReport report;
  const bool rests = memory_->stepper.rests(scene_, island, terms_for(island), leans, report);
  counters_.solve_iterations += report.iterations;
  for (const std::uint32_t body : island.bodies) refuted_[body] = rests ? 0 : 1;
  return rests;
}

/// Activates contacts that touch and that the motion which refutes rest would close: a body that leans on a neighbour
/// may rest with its help. True where there are any.
bool NativeWorld::activate_leaning() {
  const Bodies& bodies = scene_.bodies;
  const double least = kLeaningAcceleration * terms_.effective_gravity.norm();
  const auto acceleration = [&](std::int32_t body, const Vec3& point) -> Vec3 {
    if (body < 0 || refuted_[at(body)] == 0 || reset_[at(body)] == 0) return Vec3::Zero();
    const std::size_t i = at(body);
    return bodies.acceleration[i] + bodies.angular_acceleration[i].cross(point - bodies.state.position[i]);
  };
  bool any = false;
  for (Manifold& manifold : scene_.manifolds) {
    if (manifold.active || !has_end_in(manifold, refuted_)) continue;
    for (int i = 0; i < manifold.contact.count && !manifold.active; ++i) {
      const ContactPoint& point = manifold.contact.points[at(i)];
      if (point.gap > leaning_gap(bodies, manifold)) continue;
      const Vec3 closing = acceleration(manifold.a, point.on_a) - acceleration(manifold.b, point.on_b);
      if (manifold.contact.normal.dot(closing) <= least) continue;
      manifold.activate();
      undecided_[at(manifold.b)] = 1;
      if (!manifold.with_side()) undecided_[at(manifold.a)] = 1;
      any = true;
    }
  }
  return any;
}

void NativeWorld::find_resting_pushes(const IslandView& island) {
  std::erase_if(scene_.resting_pushes, [&](const SidePush& push) {
    return std::find(island.bodies.begin(), island.bodies.end(), push.body) != island.bodies.end();
  });
  memory_->stepper.find_resting_pushes(scene_, island, terms_);
}

/// Adds what sleeping bodies do to the sides by themselves: what they did when they fell asleep. What moving bodies do
/// to them counts as pushing the floor (`IslandProblem::add_pushes`) until they wake, as does what is left over, so
/// that all sides together balance the load.
void NativeWorld::add_sleeping_pushes(double duration) {
  const Bodies& bodies = scene_.bodies;
  left_.assign(bodies.count(), Vec3::Zero());
  for (const Manifold& manifold : scene_.manifolds) {
    if (!manifold.active || !stays(bodies, manifold.a) || !stays(bodies, manifold.b)) continue;
    const bool fixed_a = is_fixed(bodies, manifold.a), fixed_b = is_fixed(bodies, manifold.b);
    for (std::size_t i = 0; i < at(manifold.contact.count); ++i) {
      const Vec3 impulse = duration * manifold.cached[i].force;
      left_[at(manifold.b)] += impulse;
      if (!manifold.with_side()) left_[at(manifold.a)] -= impulse;
      if (fixed_a || fixed_b)
        add_contact(side_impulses_, *pushed_side(scene_, manifold, fixed_a ? manifold.a : manifold.b),
                    fixed_a ? Vec3(-impulse) : impulse, manifold.contact.points[i].on_a);
    }
  }
  push_floor([&](std::size_t i) -> Vec3 {
    return left_[i] + duration * (bodies.pushed[i].force + bodies.mass[i] * terms_.effective_gravity);
  });
}

/// Adds impulses of the sleeping bodies on the floor, N s.
void NativeWorld::push_floor(const std::function<Vec3(std::size_t)>& impulse) {
  const Side* const floor = floor_of(scene_);
  if (floor == nullptr) return;
  for (std::size_t i = 0; i < scene_.bodies.count(); ++i) {
    if (scene_.bodies.asleep[i] == 0) continue;
    Vec3 below = scene_.bodies.state.position[i];
    below.z() = 0.0;
    add_contact(side_impulses_, floor->index, impulse(i), below);
  }
}

void NativeWorld::set_at_rest(const IslandView& island) {
  for (const std::uint32_t body : island.bodies) {
    resting_[body] = 1;
    scene_.bodies.state.velocity[body] = Vec3::Zero();
    scene_.bodies.state.angular_velocity[body] = Vec3::Zero();
    scene_.bodies.acceleration[body] = Vec3::Zero();
    scene_.bodies.angular_acceleration[body] = Vec3::Zero();
  }
}

}  // namespace holdfast::internal::native
