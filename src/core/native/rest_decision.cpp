#include "core/native/rest_decision.hpp"

#include <algorithm>

#include "core/base/byte_hash.hpp"
#include "core/native/contact_kinematics.hpp"

namespace holdfast::internal::native {

namespace {

void set_at_rest(Scene& scene, const IslandView& island) {
  for (const std::uint32_t body : island.bodies) {
    scene.bodies.activity[body] = Activity::resting;
    scene.side_forces.add_stopped(scene, body);
    scene.bodies.stop(body);
  }
}

}  // namespace

Change RestDecision::note(Bodies& bodies, const StepTerms& terms, const Vec3& effective_gravity, bool disturbed) {
  if (!disturbed && effective_gravity == terms.effective_gravity) return change_ = Change::none;
  const double change = (effective_gravity - reset_gravity_).norm();
  if (disturbed || change > kSmall * effective_gravity.norm()) {
    change_ = Change::much;
    reset_gravity_ = effective_gravity;
    std::fill(reset_.begin(), reset_.end(), 1);
    std::fill(wait_.begin(), wait_.end(), 0);
    std::fill(next_wait_.begin(), next_wait_.end(), 0);
  } else {
    change_ = Change::little;
    reset_ = bodies.marked(Activity::resting);
  }
  std::replace(bodies.activity.begin(), bodies.activity.end(), Activity::resting, Activity::moving);
  return change_;
}

StepTerms RestDecision::terms_for(const StepTerms& terms, const IslandView& island) const {
  const auto all = [&](const std::vector<std::uint8_t>& mark) {
    return std::all_of(island.bodies.begin(), island.bodies.end(), [&](std::uint32_t body) { return mark[body] != 0; });
  };
  StepTerms of_island = terms;
  of_island.reset_warm_start = change_ != Change::none && all(reset_);
  of_island.refuted = all(refuted_);
  return of_island;
}

/// Small islands are reset by any change of the acceleration: they are cheap, and as exact as under one that is
/// constant.
void RestDecision::reset_small_islands(const Connectivity& islands) {
  for (std::size_t i = 0; i < islands.size(); ++i) {
    const IslandView island = islands[i];
    if (island.bodies.size() > kSmallIslandBodies) continue;
    for (const std::uint32_t body : island.bodies) reset_[body] = 1;
  }
}

void RestDecision::decide(Scene& scene, const StepTerms& terms, Connectivity& islands, bool freeze, RestProof& proof,
                          Counters& counters) {
  Bodies& bodies = scene.bodies;
  islands.find(bodies, scene.manifolds);
  if (change_ != Change::none) reset_small_islands(islands);
  std::fill(refuted_.begin(), refuted_.end(), 0);
  std::fill(undecided_.begin(), undecided_.end(), 1);
  for (std::size_t round = 0;; ++round) {
    for (std::size_t i = 0; i < islands.size(); ++i) {
      const IslandView island = islands[i];
      const auto is_undecided = [&](std::uint32_t body) { return undecided_[body] != 0; };
      const auto is_resting = [&](std::uint32_t body) { return bodies.activity[body] == Activity::resting; };
      if (std::none_of(island.bodies.begin(), island.bodies.end(), is_undecided)) continue;
      const bool known = freeze && std::all_of(island.bodies.begin(), island.bodies.end(), is_resting);
      const bool rests =
          known || (is_slow(bodies, island, kNegligible * terms.velocity_unit) && (round > 0 || is_due(island)) &&
                    prove(scene, terms, island, round > 0, proof, counters));
      if (rests) set_at_rest(scene, island);
      for (const std::uint32_t body : island.bodies) {
        if (!known) pushes_with_[body] = 0;
        if (!rests) bodies.activity[body] = Activity::moving;
        undecided_[body] = 0;
      }
    }
    if (change_ == Change::none || round == kRepairRounds || !activate_leaning(scene, terms)) break;
    islands.find(bodies, scene.manifolds);
  }
  for (std::size_t i = 0; i < refuted_.size(); ++i) {
    if (refuted_[i] != 0) wait_[i] = next_wait_[i] = std::min(2 * kHorizon, std::max(1U, 2 * next_wait_[i]));
    if (bodies.activity[i] != Activity::moving) wait_[i] = next_wait_[i] = 0;
  }
}

/// Whether a proof of rest is tried in this step: after a proof that fails, some steps are taken first.
bool RestDecision::is_due(const IslandView& island) {
  bool due = true;
  for (const std::uint32_t body : island.bodies) {
    if (wait_[body] == 0) continue;
    --wait_[body];
    due = false;
  }
  return due;
}

bool RestDecision::prove(Scene& scene, const StepTerms& terms, const IslandView& island, bool leans, RestProof& proof,
                         Counters& counters) {
  IslandReport report;
  const bool rests = proof.rests(scene, island, terms_for(terms, island), leans, report);
  counters.solve_iterations += report.iterations;
  for (const std::uint32_t body : island.bodies) refuted_[body] = rests ? 0 : 1;
  return rests;
}

void RestDecision::add_pushes(Scene& scene, const StepTerms& terms, double duration, RestProof& proof) {
  if (scene.side_forces.wanted()) find_resting_pushes(scene, terms, proof);
  scene.side_forces.add_resting(scene.bodies, duration);
}

/// Finds what bodies that rest do to the sides, where some of them begin to, or others than before rest with them: with
/// all contacts that touch, whichever of them the way to rest has made active, so that the forces depend on the pose
/// alone.
void RestDecision::find_resting_pushes(Scene& scene, const StepTerms& terms, RestProof& proof) {
  const Bodies& bodies = scene.bodies;
  if (!bodies.any(Activity::resting)) return;
  const auto may_carry = [&](std::int32_t body) {
    return is_fixed(bodies, body) || bodies.activity[at(body)] == Activity::resting;
  };
  std::vector<std::uint8_t> active;
  for (Manifold& manifold : scene.manifolds) {
    active.push_back(manifold.active ? 1 : 0);
    const bool touches = manifold.nearest_gap <= leaning_gap(scene, manifold);
    manifold.active = manifold.active || (touches && may_carry(manifold.a) && may_carry(manifold.b));
  }
  Connectivity touching;
  touching.find(bodies, scene.manifolds);
  for (std::size_t i = 0; i < touching.size(); ++i) {
    const IslandView island = touching[i];
    if (bodies.activity[island.bodies.front()] != Activity::resting) continue;
    ByteHash hash;
    hash.add(island.bodies.data(), island.bodies.size_bytes());
    const auto is_known = [&](std::uint32_t body) { return pushes_with_[body] == hash.value(); };
    if (std::all_of(island.bodies.begin(), island.bodies.end(), is_known)) continue;
    proof.find_resting_pushes(scene, island, terms);
    for (const std::uint32_t body : island.bodies) pushes_with_[body] = hash.value();
  }
  for (std::size_t i = 0; i < active.size(); ++i) scene.manifolds[i].active = active[i] != 0;
}

/// Activates contacts that touch and that the motion which refutes rest would close: a body that leans on a neighbour
/// may rest with its help. True where there are any.
bool RestDecision::activate_leaning(Scene& scene, const StepTerms& terms) {
  const Bodies& bodies = scene.bodies;
  const double least = kNegligible * terms.effective_gravity.norm();
  const auto acceleration = [&](std::int32_t body, const Vec3& point) -> Vec3 {
    if (body < 0 || refuted_[at(body)] == 0 || reset_[at(body)] == 0) return Vec3::Zero();
    const std::size_t i = at(body);
    const LastStep& last = bodies.last_step[i];
    return last.acceleration + last.angular_acceleration.cross(point - bodies.state.position[i]);
  };
  bool any = false;
  for (Manifold& manifold : scene.manifolds) {
    if (manifold.active || !has_end_in(manifold, refuted_)) continue;
    for (int i = 0; i < manifold.contact.count && !manifold.active; ++i) {
      const ContactPoint& point = manifold.contact.points[at(i)];
      if (point.gap > leaning_gap(scene, manifold)) continue;
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

}  // namespace holdfast::internal::native
