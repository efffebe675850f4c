#include "core/native/island/closing_contacts.hpp"

#include <algorithm>
#include <cmath>

#include "core/native/contact_kinematics.hpp"

namespace holdfast::internal::native {

/// Activates all pairs of the island that nearly touch at the end of the step: a hit that goes on contact by contact
/// would take as many solves as a stack has layers. Not those with what is fixed: between two walls friction could hold
/// a body that nothing pushes against them.
void ClosingContacts::activate_nearby(Scene& scene, const IslandView& island, const StepTerms& terms,
                                      const PointFilter& filter, double step) const {
  const Bodies& bodies = scene.bodies;
  const double near = kNoticeable * terms.velocity_unit * step;
  for (const std::uint32_t index : island.manifolds) {
    Manifold& manifold = scene.manifolds[index];
    if (manifold.active || stays(bodies, manifold.a) || stays(bodies, manifold.b)) continue;
    const RelativeTwist now(twist_of(bodies, manifold.a), twist_of(bodies, manifold.b), manifold.contact.normal);
    const RelativeTwist mean(motion_.mean(bodies, manifold.a), motion_.mean(bodies, manifold.b),
                             manifold.contact.normal);
    for (int i = 0; i < manifold.contact.count && !manifold.active; ++i) {
      const ContactPoint& point = manifold.contact.points[at(i)];
      const double u0 = now.normal_velocity(point);
      const double gap_end = point.gap + step * mean.normal_velocity(point);
      if (!filter.takes(point.gap, u0, step) || gap_end >= near) continue;
      manifold.activate();
    }
  }
}

ClosingContacts::Event ClosingContacts::find(Scene& scene, const IslandView& island, const StepTerms& terms,
                                             const Effort& effort, const ImpactTiming& timing, double step) {
  Event event;
  const Bodies& bodies = scene.bodies;
  const PointFilter filter = timing.filter(step);
  for (const std::uint32_t index : island.manifolds) {
    Manifold& manifold = scene.manifolds[index];
    const auto in_solve = [&](const ContactPoint& point) { return manifold.active && filter.is_closed(point.gap); };
    const auto points = manifold.contact.points.begin();
    if (std::all_of(points, points + manifold.contact.count, in_solve)) continue;
    const RelativeTwist now(twist_of(bodies, manifold.a), twist_of(bodies, manifold.b), manifold.contact.normal);
    const RelativeTwist mean(motion_.mean(bodies, manifold.a), motion_.mean(bodies, manifold.b),
                             manifold.contact.normal);
    const double overlap = penetration_slop(bodies, manifold, effort.penetration_slop);
    for (int i = 0; i < manifold.contact.count; ++i) {
      const ContactPoint& point = manifold.contact.points[at(i)];
      if (in_solve(point)) continue;
      const double u0 = now.normal_velocity(point);
      const auto bit = static_cast<std::uint8_t>(1U << i);
      const bool solved = (predicted_[index] & bit) != 0 || filter.takes(point.gap, u0, step);
      if (manifold.active && solved) continue;
      const double gap_end = point.gap + step * mean.normal_velocity(point);
      if (gap_end >= -overlap) continue;
      const double u1 = motion_.end_normal_velocity(bodies, manifold, point);
      // gap + u0 t + (u1 − u0) t² / (2 step) = 0, the root in the step, in the form without cancellation.
      const double curvature = (u1 - u0) / step;
      const double root = std::sqrt(std::max(0.0, u0 * u0 - 2.0 * curvature * point.gap));
      const double time = u0 < root ? 2.0 * point.gap / (root - u0) : step;
      const bool fast = -(u0 + curvature * time) > timing.located_speed;
      if (!timing.locates || !fast || solved) {
        manifold.activate();
        predicted_[index] |= bit;
        event.activated = true;
      } else {
        event.time = std::min(event.time, std::max(time, kLeastCut * terms.step));
      }
    }
  }
  if (event.activated) activate_nearby(scene, island, terms, filter, step);
  return event;
}

}  // namespace holdfast::internal::native
