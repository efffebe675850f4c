// What happens within a step of an island: impacts, bodies that meet, slips that end.

#include "core/native/island.hpp"

#include <algorithm>
#include <cmath>

#include "core/native/island_motion.hpp"

namespace holdfast::internal::native {

namespace {

/// Impacts below this share of |g − a| h are never located in time: they close at the end of their step.
constexpr double kFastShare = 0.25;

/// Gaps below this share of |g − a| h² are those of neighbours that a hit may reach.
constexpr double kNearby = 0.2;

}  // namespace

/// Contacts that are part of the solve: closed, or closing slower than what is located in time, or closing at all
/// once nothing more is located.
bool IslandStepper::is_solved(const ContactPoint& point, double parting, const StepTerms& terms, double step) const {
  return is_closed(point, terms, step) || (!may_cut_ && point.gap + step * parting < slow_gap(terms, step));
}

/// Contacts of which that is known whatever their speed.
bool IslandStepper::is_closed(const ContactPoint& point, const StepTerms& terms, double step) const {
  return point.gap <= slow_gap(terms, step);
}

/// Gap that a contact closes in the step when it is as fast as what is located in time, m.
double IslandStepper::slow_gap(const StepTerms& terms, double step) const {
  return std::max(kTouch, fast_approach(terms) * step);
}

/// Speed from which impacts are located in time, m/s.
double IslandStepper::fast_approach(const StepTerms& terms) const {
  return std::max(kFastShare * terms.velocity_unit, effort_.impact_length / terms.step);
}

/// Velocity of a body of the island at a point after the solve, m/s.
Vec3 IslandStepper::end_velocity(const Bodies& bodies, std::int32_t body, const Vec3& point) const {
  if (is_fixed(bodies, body)) return Vec3::Zero();
  const BodyVector& v = solver_.velocity[at(place_[at(body)])];
  return linear(v) + angular(v).cross(point - bodies.state.position[at(body)]);
}

/// Speed at which the surfaces part at a point after the solve, m/s.
double IslandStepper::end_parting(const Bodies& bodies, const Manifold& manifold, const ContactPoint& point) const {
  return manifold.contact.normal.dot(end_velocity(bodies, manifold.b, point.on_b) -
                                     end_velocity(bodies, manifold.a, point.on_a));
}

void IslandStepper::resolve_impacts(Scene& scene, const IslandView& island, const StepTerms& terms, double step,
                                    IslandReport& report) {
  Bodies& bodies = scene.bodies;
  double fastest = 0.0;
  const double fast = fast_approach(terms);
  struck_.assign(scene.manifolds.size(), 0);
  for (const std::uint32_t index : island.manifolds) {
    Manifold& manifold = scene.manifolds[index];
    // Without rebound, and not located in time, an impact needs no solve of its own.
    if (effort_.impact_cuts == 0 && manifold.restitution == 0.0) continue;
    for (int i = 0; i < manifold.contact.count; ++i) {
      const ContactPoint& point = manifold.contact.points[at(i)];
      const double speed = parting(bodies, manifold, point);
      if (!is_solved(point, speed, terms, step) || std::max(0.0, point.gap) + step * speed >= -fast * step) continue;
      struck_[index] |= static_cast<std::uint8_t>(1U << i);
      fastest = std::max(fastest, -speed);
    }
  }
  if (fastest == 0.0) return;
  SplittingOptions options;
  options.iterations = 2 * effort_.iterations;
  options.tolerance = effort_.tolerance;
  options.accelerate = true;
  const double unit = std::max(fastest, terms.velocity_unit);
  // An impact acts where surfaces meet. Where that would push others into each other, all that touch answer it: passed
  // on contact by contact, it would take as many solves as a crowd has layers. A contact that need not answer has no
  // impulse, and no friction.
  for (bool passed_on = true; passed_on;) {
    for (const std::uint32_t index : island.manifolds) {
      if (struck_[index] == 0) continue;
      scene.manifolds[index].activate();
    }
    load(scene, island, terms, Purpose::impact, step);
    // What a contact carries is measured by the blow: by the weight in a step, R would be far too large.
    solver_.load_unit = unit;
    const SplittingResult result = solver_.solve(options, unit);
    report.iterations += static_cast<std::uint64_t>(result.iterations);
    passed_on = pass_on(scene, island, terms, step);
    // In units of its own velocities, as that of other solves.
    if (!passed_on) report.residual = std::max(report.residual, terms.velocity_unit / unit * result.residual);
  }
  for (const std::uint32_t body : island.bodies) {
    bodies.state.velocity[body] = linear(solver_.velocity[at(place_[body])]);
    bodies.state.angular_velocity[body] = angular(solver_.velocity[at(place_[body])]);
  }
}

/// Has all points that touch take part in the impact, where as solved it pushes some that do not into each other. False
/// when it pushes none.
bool IslandStepper::pass_on(const Scene& scene, const IslandView& island, const StepTerms& terms, double step) {
  const Bodies& bodies = scene.bodies;
  bool pushes = false;
  touching_.assign(scene.manifolds.size(), 0);
  for (const std::uint32_t index : island.manifolds) {
    const Manifold& manifold = scene.manifolds[index];
    for (int i = 0; i < manifold.contact.count; ++i) {
      const ContactPoint& point = manifold.contact.points[at(i)];
      const auto bit = static_cast<std::uint8_t>(1U << i);
      const double before = parting(bodies, manifold, point);
      if ((struck_[index] & bit) != 0 || !is_solved(point, before, terms, step)) continue;
      // An impulse on what parts already gives energy, which nothing takes where impacts rebound.
      if (manifold.restitution > 0.0 && before > kSlipShare * terms.velocity_unit) continue;
      touching_[index] |= bit;
      const double after = end_parting(bodies, manifold, point);
      pushes = pushes || std::max(0.0, point.gap) + step * after < -kSlipShare * terms.velocity_unit * step;
    }
  }
  if (pushes)
    for (const std::uint32_t index : island.manifolds) struck_[index] |= touching_[index];
  return pushes;
}

/// Has all pairs of the island that nearly touch, and end the step so, take part in its next solve: a hit that is
/// passed on contact by contact would take as many solves as the crowd has layers. Not what is fixed: between two walls
/// friction could hold what nothing pushes against them.
void IslandStepper::activate_nearby(Scene& scene, const IslandView& island, const StepTerms& terms, double step) const {
  const Bodies& bodies = scene.bodies;
  const double near = kNearby * terms.velocity_unit * step;
  for (const std::uint32_t index : island.manifolds) {
    Manifold& manifold = scene.manifolds[index];
    if (manifold.active || is_fixed(bodies, manifold.a) || is_fixed(bodies, manifold.b)) continue;
    for (int i = 0; i < manifold.contact.count && !manifold.active; ++i) {
      const ContactPoint& point = manifold.contact.points[at(i)];
      const double u0 = parting(bodies, manifold, point);
      const double gap_end = point.gap + 0.5 * step * (u0 + end_parting(bodies, manifold, point));
      if (!is_solved(point, u0, terms, step) || gap_end >= near) continue;
      manifold.activate();
    }
  }
}

IslandStepper::Event IslandStepper::find_overlap(Scene& scene, const IslandView& island, const StepTerms& terms,
                                                 double step) {
  Event event;
  const Bodies& bodies = scene.bodies;
  const double overlap = least_overlap(terms, effort_.late_overlap);
  for (const std::uint32_t index : island.manifolds) {
    Manifold& manifold = scene.manifolds[index];
    for (int i = 0; i < manifold.contact.count; ++i) {
      const ContactPoint& point = manifold.contact.points[at(i)];
      if (manifold.active && is_closed(point, terms, step)) continue;
      const double u0 = parting(bodies, manifold, point);
      const auto bit = static_cast<std::uint8_t>(1U << i);
      const bool solved = (met_[index] & bit) != 0 || is_solved(point, u0, terms, step);
      if (manifold.active && solved) continue;
      const double u1 = end_parting(bodies, manifold, point);
      const double gap_end = point.gap + 0.5 * step * (u0 + u1);
      if (gap_end >= -overlap) continue;
      // gap + u0 t + (u1 − u0) t² / (2 step) = 0, the root in the step, in the form without cancellation.
      const double curvature = (u1 - u0) / step;
      const double root = std::sqrt(std::max(0.0, u0 * u0 - 2.0 * curvature * point.gap));
      const double time = u0 < root ? 2.0 * point.gap / (root - u0) : step;
      const bool fast = -(u0 + curvature * time) > fast_approach(terms);
      if (!may_cut_ || !fast || solved) {
        manifold.activate();
        met_[index] |= bit;
        event.activated = true;
      } else {
        event.time = std::min(event.time, std::max(time, kLeastStep * terms.step));
      }
    }
  }
  if (event.activated) activate_nearby(scene, island, terms, step);
  return event;
}

/// Time until the first slip ends or turns back within the step, by the acceleration of the last step; `step` when
/// none does.
double IslandStepper::first_stop(const Scene& scene, const StepTerms& terms, double step) const {
  const Bodies& bodies = scene.bodies;
  const auto rate = [&](std::int32_t body, const Vec3& point) -> Vec3 {
    if (is_fixed(bodies, body)) return Vec3::Zero();
    return bodies.acceleration[at(body)] +
           bodies.angular_acceleration[at(body)].cross(point - bodies.state.position[at(body)]);
  };
  double first = step;
  for (std::size_t p = 0; p < sources_.size(); ++p) {
    const Manifold& manifold = scene.manifolds[sources_[p].manifold];
    if (manifold.friction == 0.0) continue;
    const Vec3& normal = manifold.contact.normal;
    for (std::size_t lane = 0; lane < static_cast<std::size_t>(solver_.patches[p].count); ++lane) {
      if (!(solver_.patches[p].impulse.row[0][lane] > 0.0)) continue;
      const ContactPoint& point = manifold.contact.points[sources_[p].point[lane]];
      const auto tangential = [&](const Vec3& v) -> Vec3 { return v - normal * normal.dot(v); };
      const Vec3 slip = tangential(relative_velocity(bodies, manifold, point));
      const double speed = slip.norm();
      if (speed <= kSlipShare * terms.velocity_unit) continue;
      const Vec3 end =
          tangential(end_velocity(bodies, manifold.b, point.on_b) - end_velocity(bodies, manifold.a, point.on_a));
      // It goes on when it keeps some speed in its direction.
      if (end.dot(slip) > kSlipShare * speed * speed) continue;
      const double slowing = -slip.dot(tangential(rate(manifold.b, point.on_b) - rate(manifold.a, point.on_a))) / speed;
      if (slowing > 0.0) first = std::min(first, speed / slowing);
    }
  }
  // A cut right at the start or the end of the step would change nothing.
  return first > kLeastStep * terms.step && first < step - kLeastStep * terms.step ? first : step;
}

}  // namespace holdfast::internal::native
