#include "core/native/side_forces.hpp"

#include <algorithm>

#include "core/native/contact_kinematics.hpp"
#include "core/native/scene.hpp"

namespace holdfast::internal::native {

void SideForces::forget(const std::vector<std::uint8_t>& bodies) {
  std::erase_if(of_step_, [&](const SidePush& push) { return bodies[push.body] != 0; });
}

void SideForces::accept_step() {
  for (const SidePush& push : of_step_) add_contact(sum_, push.side, push.impulse, push.point);
}

std::vector<SidePush>& SideForces::of_resting(const IslandView& island) {
  std::erase_if(of_resting_, [&](const SidePush& push) {
    return std::find(island.bodies.begin(), island.bodies.end(), push.body) != island.bodies.end();
  });
  return of_resting_;
}

void SideForces::add_resting(const Bodies& bodies, double duration) {
  for (const SidePush& push : of_resting_)
    if (bodies.activity[push.body] == Activity::resting)
      add_contact(sum_, push.side, duration * push.impulse, push.point);
}

void SideForces::add_sleeping(const Scene& scene, const StepTerms& terms, double duration) {
  const Bodies& bodies = scene.bodies;
  left_.assign(bodies.count(), Vec3::Zero());
  for (const Manifold& manifold : scene.manifolds) {
    if (!manifold.active || !stays(bodies, manifold.a) || !stays(bodies, manifold.b)) continue;
    const bool fixed_a = is_fixed(bodies, manifold.a), fixed_b = is_fixed(bodies, manifold.b);
    for (std::size_t i = 0; i < at(manifold.contact.count); ++i) {
      const Vec3 impulse = duration * manifold.cached[i].force;
      left_[at(manifold.b)] += impulse;
      if (!manifold.with_side()) left_[at(manifold.a)] -= impulse;
      if (fixed_a || fixed_b)
        add_contact(sum_, *pushed_side(scene, manifold, fixed_a ? manifold.a : manifold.b),
                    fixed_a ? Vec3(-impulse) : impulse, manifold.contact.points[i].on_a);
    }
  }
  for (std::size_t i = 0; i < bodies.count(); ++i)
    if (bodies.activity[i] == Activity::asleep)
      push_floor(scene, i, left_[i] + duration * (bodies.pushed[i].force + bodies.mass[i] * terms.effective_gravity));
}

void SideForces::add_stopped(const Scene& scene, std::size_t body) {
  if (!wanted_) return;
  const Bodies& bodies = scene.bodies;
  push_floor(scene, body, bodies.mass[body] * (bodies.state.velocity[body] + bodies.last_step[body].missing_velocity));
}

/// Adds the impulse of a body on the floor below it, N s.
void SideForces::push_floor(const Scene& scene, std::size_t body, const Vec3& impulse) {
  const Side* const floor = floor_of(scene);
  if (floor == nullptr) return;
  Vec3 below = scene.bodies.state.position[body];
  below.z() = 0.0;
  add_contact(sum_, floor->index, impulse, below);
}

}  // namespace holdfast::internal::native
