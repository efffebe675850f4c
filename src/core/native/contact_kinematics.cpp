#include "core/native/contact_kinematics.hpp"

#include <algorithm>

namespace holdfast::internal::native {

bool is_missed_contact(const ContactSet& contact, double gap_before, double deep) {
  return contact.nearest_gap() < std::min(0.0, gap_before) - deep;
}

bool is_slow(const Bodies& bodies, const IslandView& island, double speed) {
  return std::all_of(island.bodies.begin(), island.bodies.end(),
                     [&](std::uint32_t body) { return bodies.largest_speed(body) <= speed; });
}

std::optional<std::size_t> pushed_side(const Scene& scene, const Manifold& manifold, std::int32_t end) {
  if (end < 0) return scene.sides[side_of(manifold)].index;
  if (is_fixed(scene.bodies, end)) return kFixedBoxes;
  const Side* const floor = floor_of(scene);
  return floor == nullptr ? std::nullopt : std::optional(floor->index);
}

double speculative_margin(const StepTerms& terms, double approach) {
  // What rounding may hide, what the bodies approach, and what they fall in a step.
  return kContactTolerance + kSpeculation * terms.longest_step * approach + terms.fall_margin;
}

double speculative_margin(const StepTerms& terms, const Bodies& bodies, std::int32_t a, std::int32_t b) {
  const StateColumns& state = bodies.state;
  const Vec3& v = state.velocity[at(b)];
  const double approach =
      a < 0 ? v.norm() : (v - state.velocity[at(a)]).norm() + bodies.largest_rotational_speed(at(a));
  return speculative_margin(terms, approach + bodies.largest_rotational_speed(at(b)));
}

}  // namespace holdfast::internal::native
