#include "core/native/sleeping_bodies.hpp"

#include <algorithm>
#include <limits>

#include "core/native/contact_kinematics.hpp"

namespace holdfast::internal::native {

namespace {

bool is_asleep(const Bodies& bodies, std::int32_t body) {
  return body >= 0 && bodies.activity[at(body)] == Activity::asleep;
}

}  // namespace

void SleepingBodies::reset(Scene& scene) {
  wake(scene);
  forget(std::vector<std::uint8_t>(slow_steps_.size(), 1));
  steps_ = 0;
}

void SleepingBodies::forget(const std::vector<std::uint8_t>& bodies) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies[i] == 0) continue;
    slow_steps_[i] = 0;
    // Every speed has risen from this one.
    speed_[i] = -std::numeric_limits<double>::infinity();
  }
}

void SleepingBodies::wake(Scene& scene) {
  slept_ = scene.bodies.marked(Activity::asleep);
  std::vector<Activity>& activity = scene.bodies.activity;
  std::replace(activity.begin(), activity.end(), Activity::asleep, Activity::moving);
}

bool SleepingBodies::choose(Scene& scene, const StepTerms& terms, const Connectivity& islands) {
  if (++steps_ % kWakeEvery == 0) return false;
  Bodies& bodies = scene.bodies;
  for (std::size_t i = 0; i < islands.size(); ++i) {
    const IslandView island = islands[i];
    if (island.bodies.size() <= kMediumIslandBodies) continue;
    if (bodies.activity[island.bodies.front()] != Activity::moving) continue;
    // What begins to move may be as slow as rounding, and asleep it would be held: a proof decides whether all rest.
    if (is_slow(bodies, island, kSmall * terms.velocity_unit)) continue;
    for (const std::uint32_t body : island.bodies)
      if (slow_steps_[body] >= kSlowSteps) bodies.activity[body] = Activity::asleep;
  }
  if (!bodies.any(Activity::asleep)) return false;
  wake_hit(scene, terms);
  find_contacts(scene);
  wake_unsupported(scene, terms);
  if (!bodies.any(Activity::asleep)) return false;
  sum_forces(bodies, [](const Contact&) { return true; });
  for (std::size_t i = 0; i < bodies.count(); ++i) {
    if (bodies.activity[i] != Activity::asleep) continue;
    if (slept_[i] == 0) load_[i] = load_now_[i];
    scene.side_forces.add_stopped(scene, i);
    bodies.stop(i);
  }
  return true;
}

/// Finds the contacts of the bodies that sleep now. All manifolds are looked at once, and these few often.
void SleepingBodies::find_contacts(const Scene& scene) {
  contacts_.clear();
  for (const Manifold& manifold : scene.manifolds) {
    if (!manifold.active || !(is_asleep(scene.bodies, manifold.a) || is_asleep(scene.bodies, manifold.b))) continue;
    Vec3 force = Vec3::Zero();
    for (std::size_t i = 0; i < at(manifold.contact.count); ++i) force += manifold.cached[i].force;
    contacts_.push_back({manifold.a, manifold.b, force});
  }
}

/// Sums the contact forces on each body that sleeps into `load_now_`, N; 0 for the others.
/// @param counts `bool(const Contact&)`: whether the contact's force counts
template <class Counts>
void SleepingBodies::sum_forces(const Bodies& bodies, Counts counts) {
  load_now_.assign(bodies.count(), Vec3::Zero());
  for (const Contact& contact : contacts_) {
    const bool on_a = is_asleep(bodies, contact.a);
    const bool on_b = is_asleep(bodies, contact.b);
    if (!(on_a || on_b) || !counts(contact)) continue;
    if (on_b) load_now_[at(contact.b)] += contact.force;
    if (on_a) load_now_[at(contact.a)] -= contact.force;
  }
}

/// Those that are hit in the step do not sleep, nor do their neighbours, on which the impact acts at once: against what
/// stays, a body that moves would lose all of its momentum.
void SleepingBodies::wake_hit(Scene& scene, const StepTerms& terms) {
  Bodies& bodies = scene.bodies;
  hit_.assign(bodies.count(), 0);
  bool any_hit = false;
  for (const Manifold& manifold : scene.manifolds) {
    if (manifold.with_side() || is_asleep(bodies, manifold.a) == is_asleep(bodies, manifold.b)) continue;
    const RelativeTwist now(twist_of(bodies, manifold.a), twist_of(bodies, manifold.b), manifold.contact.normal);
    for (std::size_t i = 0; i < at(manifold.contact.count); ++i) {
      const ContactPoint& point = manifold.contact.points[i];
      const double speed = now.normal_velocity(point);
      if (speed >= -kNoticeable * terms.velocity_unit || point.gap + terms.step * speed >= 0.0) continue;
      hit_[at(is_asleep(bodies, manifold.a) ? manifold.a : manifold.b)] = 1;
      any_hit = true;
    }
  }
  if (!any_hit) return;
  for (int layer = 0; layer < kHitLayers; ++layer) {
    const std::vector<std::uint8_t> before = hit_;
    for (const Manifold& manifold : scene.manifolds) {
      if (manifold.with_side() || !manifold.active || !has_end_in(manifold, before)) continue;
      hit_[at(manifold.a)] = hit_[at(manifold.b)] = 1;
    }
  }
  for (std::size_t i = 0; i < bodies.count(); ++i) {
    if (hit_[i] == 0 || bodies.activity[i] != Activity::asleep) continue;
    bodies.activity[i] = Activity::moving;
    slow_steps_[i] = 0;
  }
}

/// Bodies that moving ones carry do not sleep: as if they were fixed they would not press on these, and would stay in
/// the air where these leave. Against g − a, the contact forces of what stays must be a share of what balances the
/// body.
void SleepingBodies::wake_unsupported(Scene& scene, const StepTerms& terms) {
  Bodies& bodies = scene.bodies;
  const auto of_what_stays = [&](const Contact& contact) {
    return stays(bodies, contact.a) && stays(bodies, contact.b);
  };
  const double least = kSleepingSupport * terms.effective_gravity.squaredNorm();
  for (bool any_woke = true; any_woke;) {
    any_woke = false;
    sum_forces(bodies, of_what_stays);
    for (std::size_t i = 0; i < bodies.count(); ++i) {
      if (bodies.activity[i] != Activity::asleep ||
          -load_now_[i].dot(terms.effective_gravity) >= bodies.mass[i] * least)
        continue;
      bodies.activity[i] = Activity::moving;
      any_woke = true;  // it carries others, which have to be looked at again
    }
  }
}

void SleepingBodies::note(const Scene& scene, const StepTerms& terms) {
  const Bodies& bodies = scene.bodies;
  if (bodies.any(Activity::asleep)) wake_overloaded(scene, terms);
  for (std::size_t i = 0; i < bodies.count(); ++i) {
    if (bodies.activity[i] != Activity::moving) continue;
    const double speed = bodies.largest_speed(i);
    if (speed > kNegligible * terms.velocity_unit)
      slow_steps_[i] = 0;
    else if (speed <= speed_[i] + rising_speed_ * terms.velocity_unit)
      ++slow_steps_[i];
    speed_[i] = speed;
  }
}

/// Those whose load has changed by much are no longer slow. A single box between heavy ones may carry many times its
/// weight, and forces in a jam are not determined: what counts is the change over the box and its sleeping neighbours.
void SleepingBodies::wake_overloaded(const Scene& scene, const StepTerms& terms) {
  const Bodies& bodies = scene.bodies;
  find_contacts(scene);
  sum_forces(bodies, [](const Contact&) { return true; });
  change_.assign(bodies.count(), Vec3::Zero());
  mass_.assign(bodies.count(), 0.0);
  const auto add = [&](std::size_t to, std::size_t of) {
    change_[to] += load_now_[of] - load_[of];
    mass_[to] += bodies.mass[of];
  };
  for (std::size_t i = 0; i < bodies.count(); ++i)
    if (bodies.activity[i] == Activity::asleep) add(i, i);
  for (const Contact& contact : contacts_) {
    if (!is_asleep(bodies, contact.a) || !is_asleep(bodies, contact.b)) continue;
    add(at(contact.a), at(contact.b));
    add(at(contact.b), at(contact.a));
  }
  const double most = kSleepingLoadChange * terms.effective_gravity.norm();
  for (std::size_t i = 0; i < bodies.count(); ++i)
    if (bodies.activity[i] == Activity::asleep && change_[i].norm() > most * mass_[i]) slow_steps_[i] = 0;
}

}  // namespace holdfast::internal::native
