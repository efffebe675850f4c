// Events within a step of an island: impacts, contacts that close, slips that end.

#include "core/native/island_stepper.hpp"

#include <algorithm>
#include <cmath>

#include "core/native/contact_kinematics.hpp"

namespace holdfast::internal::native {

namespace {

/// The part of a velocity that is along the contact's surfaces.
Vec3 tangential(const Manifold& manifold, const Vec3& velocity) {
  return velocity - manifold.contact.normal * manifold.contact.normal.dot(velocity);
}

/// The largest slip of a contact's points, m/s.
/// @param velocity_of `Vec3(const ContactPoint&)`: of b's surface relative to a's, m/s
template <class VelocityOf>
double largest_slip(const Manifold& manifold, VelocityOf velocity_of) {
  double largest = 0.0;
  for (int i = 0; i < manifold.contact.count; ++i)
    largest = std::max(largest, tangential(manifold, velocity_of(manifold.contact.points[at(i)])).norm());
  return largest;
}

}  // namespace

/// Which contacts are solved: those that are closed, those that close slower than what is located in time, and, once
/// nothing more is located, all that close.
PointFilter IslandStepper::point_filter(const StepTerms& terms, double step) const {
  return {.closed_gap = std::max(kTouch, located_speed(terms) * step), .takes_closing = !locates_impacts_};
}

/// Speed from which impacts are located in time, m/s. Where none may cut a step, it only tells which contacts count as
/// closed.
double IslandStepper::located_speed(const StepTerms& terms) const {
  return std::max(kLocatedShare * terms.velocity_unit,
                  effort_.impact_cuts > 0 ? turning_speed_ : effort_.closing_length / terms.step);
}

/// By how much the velocity of a surface may change within a step because its body turns, ω² R h, m/s: impacts are
/// predicted with arms that do not turn, and slower ones may not be there at all.
double IslandStepper::turning_speed(const Bodies& bodies, const IslandView& island, const StepTerms& terms) const {
  double largest = 0.0;
  for (const std::uint32_t body : island.bodies)
    largest = std::max(largest, bodies.state.angular_velocity[body].squaredNorm() * bodies.radius[body]);
  return terms.step * largest;
}

/// How a body of the island moves after the solve.
Twist IslandStepper::end_twist(const Bodies& bodies, std::int32_t body) const {
  if (stays(bodies, body)) return {};
  const BodyVector& v = prepared_.solution(static_cast<std::uint32_t>(body));
  return {bodies.state.position[at(body)], linear(v), angular(v)};
}

/// Velocity of b's surface relative to a's after the solve, m/s.
Vec3 IslandStepper::end_velocity(const Bodies& bodies, const Manifold& manifold, const ContactPoint& point) const {
  return end_twist(bodies, manifold.b).at_point(point.on_b) - end_twist(bodies, manifold.a).at_point(point.on_a);
}

/// Normal velocity at a point after the solve, m/s.
double IslandStepper::end_normal_velocity(const Bodies& bodies, const Manifold& manifold,
                                          const ContactPoint& point) const {
  return manifold.contact.normal.dot(end_velocity(bodies, manifold, point));
}

/// How a body of the island moves through the step, on average.
Twist IslandStepper::mean_twist(const Bodies& bodies, std::int32_t body) const {
  if (stays(bodies, body)) return {};
  const BodyVector& v = mean_velocity_[at(body)];
  return {bodies.state.position[at(body)], linear(v), angular(v)};
}

void IslandStepper::resolve_impacts(Scene& scene, const IslandView& island, const StepTerms& terms, double step,
                                    IslandReport& report) {
  Bodies& bodies = scene.bodies;
  double fastest = 0.0;
  const double fast = located_speed(terms);
  const PointFilter filter = point_filter(terms, step);
  impacting_.assign(scene.manifolds.size(), 0);
  for (const std::uint32_t index : island.manifolds) {
    Manifold& manifold = scene.manifolds[index];
    // Without rebound, and not located in time, an impact needs no solve of its own.
    if (effort_.impact_cuts == 0 && manifold.restitution == 0.0) continue;
    for (int i = 0; i < manifold.contact.count; ++i) {
      const ContactPoint& point = manifold.contact.points[at(i)];
      const double speed = normal_velocity(bodies, manifold, point);
      if (!filter.takes(point.gap, speed, step) || std::max(0.0, point.gap) + step * speed >= -fast * step) continue;
      impacting_[index] |= static_cast<std::uint8_t>(1U << i);
      fastest = std::max(fastest, -speed);
    }
  }
  if (fastest == 0.0) return;
  SolveLimits limits;
  limits.iterations = 2 * effort_.iterations;
  limits.tolerance = effort_.tolerance;
  limits.accelerate = true;
  const double unit = std::max(fastest, terms.velocity_unit);
  limits.velocity_unit = unit;
  // An impact acts where surfaces meet. Where that would push others into each other, all that touch take part: contact
  // by contact, it would take as many solves as a stack has layers. A contact without a part has no impulse, and no
  // friction.
  for (bool propagated = true; propagated;) {
    for (const std::uint32_t index : island.manifolds) {
      if (impacting_[index] == 0) continue;
      scene.manifolds[index].activate();
    }
    prepared_.prepare_impact(scene, island, terms, step, *solver_, filter, impacting_);
    // What a contact carries is measured by the impact: by the weight in a step, R would be far too large.
    prepared_.problem.impulse_per_mass = unit;
    const SolveResult result = solve_once(limits, report);
    propagated = propagate_impact(scene, island, terms, step);
    // In units of its own velocities, as that of other solves.
    if (!propagated) report.residual = std::max(report.residual, terms.velocity_unit / unit * result.residual);
  }
  if (scene.notes_pushes) prepared_.add_pushes(scene, 1.0, scene.pushes);
  for (const std::uint32_t body : island.bodies) {
    bodies.state.velocity[body] = linear(prepared_.solution(body));
    bodies.state.angular_velocity[body] = angular(prepared_.solution(body));
  }
}

/// Adds all points that touch to the impact, where its solution pushes some of them into each other. False where it
/// pushes none.
bool IslandStepper::propagate_impact(const Scene& scene, const IslandView& island, const StepTerms& terms,
                                     double step) {
  const Bodies& bodies = scene.bodies;
  const PointFilter filter = point_filter(terms, step);
  bool pushes = false;
  could_impact_.assign(scene.manifolds.size(), 0);
  for (const std::uint32_t index : island.manifolds) {
    const Manifold& manifold = scene.manifolds[index];
    for (int i = 0; i < manifold.contact.count; ++i) {
      const ContactPoint& point = manifold.contact.points[at(i)];
      const auto bit = static_cast<std::uint8_t>(1U << i);
      const double before = normal_velocity(bodies, manifold, point);
      if ((impacting_[index] & bit) != 0 || !filter.takes(point.gap, before, step)) continue;
      // An impulse on surfaces that separate already gives energy, which nothing takes where impacts rebound.
      if (manifold.restitution > 0.0 && before > kSlipShare * terms.velocity_unit) continue;
      could_impact_[index] |= bit;
      const double after = end_normal_velocity(bodies, manifold, point);
      pushes = pushes || std::max(0.0, point.gap) + step * after < -kSlipShare * terms.velocity_unit * step;
    }
  }
  if (pushes)
    for (const std::uint32_t index : island.manifolds) impacting_[index] |= could_impact_[index];
  return pushes;
}

/// Activates all pairs of the island that nearly touch at the end of the step: a hit that goes on contact by contact
/// would take as many solves as a stack has layers. Not those with what is fixed: between two walls friction could hold
/// a body that nothing pushes against them.
void IslandStepper::activate_nearby(Scene& scene, const IslandView& island, const StepTerms& terms, double step) const {
  const Bodies& bodies = scene.bodies;
  const PointFilter filter = point_filter(terms, step);
  const double near = kNearbyShare * terms.velocity_unit * step;
  for (const std::uint32_t index : island.manifolds) {
    Manifold& manifold = scene.manifolds[index];
    if (manifold.active || stays(bodies, manifold.a) || stays(bodies, manifold.b)) continue;
    const RelativeTwist now(twist_of(bodies, manifold.a), twist_of(bodies, manifold.b), manifold.contact.normal);
    const RelativeTwist mean(mean_twist(bodies, manifold.a), mean_twist(bodies, manifold.b), manifold.contact.normal);
    for (int i = 0; i < manifold.contact.count && !manifold.active; ++i) {
      const ContactPoint& point = manifold.contact.points[at(i)];
      const double u0 = now.normal_velocity(point);
      const double gap_end = point.gap + step * mean.normal_velocity(point);
      if (!filter.takes(point.gap, u0, step) || gap_end >= near) continue;
      manifold.activate();
    }
  }
}

/// Looks for contacts outside of the solve that the step would make overlap. Slow ones become active and predicted; the
/// first fast one is the event that cuts the step.
IslandStepper::Event IslandStepper::find_overlap(Scene& scene, const IslandView& island, const StepTerms& terms,
                                                 double step) {
  Event event;
  const Bodies& bodies = scene.bodies;
  const PointFilter filter = point_filter(terms, step);
  const double overlap = penetration_slop(terms, effort_.penetration_slop);
  for (const std::uint32_t index : island.manifolds) {
    Manifold& manifold = scene.manifolds[index];
    const auto in_solve = [&](const ContactPoint& point) { return manifold.active && filter.is_closed(point.gap); };
    const auto points = manifold.contact.points.begin();
    if (std::all_of(points, points + manifold.contact.count, in_solve)) continue;
    const RelativeTwist now(twist_of(bodies, manifold.a), twist_of(bodies, manifold.b), manifold.contact.normal);
    const RelativeTwist mean(mean_twist(bodies, manifold.a), mean_twist(bodies, manifold.b), manifold.contact.normal);
    for (int i = 0; i < manifold.contact.count; ++i) {
      const ContactPoint& point = manifold.contact.points[at(i)];
      if (in_solve(point)) continue;
      const double u0 = now.normal_velocity(point);
      const auto bit = static_cast<std::uint8_t>(1U << i);
      const bool solved = (predicted_[index] & bit) != 0 || filter.takes(point.gap, u0, step);
      if (manifold.active && solved) continue;
      const double gap_end = point.gap + step * mean.normal_velocity(point);
      if (gap_end >= -overlap) continue;
      const double u1 = end_normal_velocity(bodies, manifold, point);
      // gap + u0 t + (u1 − u0) t² / (2 step) = 0, the root in the step, in the form without cancellation.
      const double curvature = (u1 - u0) / step;
      const double root = std::sqrt(std::max(0.0, u0 * u0 - 2.0 * curvature * point.gap));
      const double time = u0 < root ? 2.0 * point.gap / (root - u0) : step;
      const bool fast = -(u0 + curvature * time) > located_speed(terms);
      if (!locates_impacts_ || !fast || solved) {
        manifold.activate();
        predicted_[index] |= bit;
        event.activated = true;
      } else {
        event.time = std::min(event.time, std::max(time, kLeastCut * terms.step));
      }
    }
  }
  if (event.activated) activate_nearby(scene, island, terms, step);
  return event;
}

/// Slip from which friction is kinetic, m/s.
double IslandStepper::kinetic_slip(const StepTerms& terms) const {
  return std::max(kKineticSlip, effort_.mean_residual) * terms.velocity_unit;
}

/// Slip from which friction becomes kinetic within a step, m/s. Where a proof of rest has just failed, what does not
/// stick slips, however slowly: all that the solve may leave of it does not count.
/// @param residual of the solve that the slip is from, m/s
double IslandStepper::beginning_slip(const StepTerms& terms, double residual) const {
  if (!terms.refuted) return kinetic_slip(terms);
  return std::min(kinetic_slip(terms),
                  kResidualSlip * std::max(effort_.reset_tolerance * terms.velocity_unit, residual));
}

/// Finds the manifolds of the island whose surfaces slide now: their friction is kinetic, that of the others static.
/// What slid at the end of the last step goes on for as long as it slips at all.
void IslandStepper::find_sliding(Scene& scene, const IslandView& island, const StepTerms& terms) const {
  for (const std::uint32_t index : island.manifolds) {
    Manifold& manifold = scene.manifolds[index];
    if (manifold.kinetic_friction == manifold.friction) continue;
    const double slow = manifold.slides ? kSlipShare * terms.velocity_unit : kinetic_slip(terms);
    manifold.slides = largest_slip(manifold, [&](const ContactPoint& point) {
                        return relative_velocity(scene.bodies, manifold, point);
                      }) > slow;
  }
}

/// Finds the manifolds of the island that slid through the part of the step that has been solved, and that stick at its
/// end.
/// @param residual of the solve, m/s: what sticks may show as much slip
void IslandStepper::find_ended_slips(Scene& scene, const IslandView& island, const StepTerms& terms,
                                     double residual) const {
  const double slow = std::max(kSlipShare * terms.velocity_unit, kResidualSlip * residual);
  for (const std::uint32_t index : island.manifolds) {
    Manifold& manifold = scene.manifolds[index];
    manifold.slides = manifold.slides && largest_slip(manifold, [&](const ContactPoint& point) {
                                           return end_velocity(scene.bodies, manifold, point);
                                         }) > slow;
  }
}

/// Finds the manifolds that the solve took as sticking, and that slide at its end with all the friction that they may
/// have. True where there are any: friction gives way within the step, and the step is solved again with less of it.
/// @param residual of the solve, m/s
bool IslandStepper::find_begun_slips(Scene& scene, const StepTerms& terms, double residual) const {
  const double slow = beginning_slip(terms, residual);
  bool any = false;
  for (std::size_t p = 0; p < prepared_.sources.size(); ++p) {
    Manifold& manifold = scene.manifolds[prepared_.sources[p].manifold];
    if (manifold.slides || manifold.kinetic_friction == manifold.friction) continue;
    const ContactConstraint& constraint = prepared_.problem.constraints[p];
    const auto& y = constraint.impulse.row;
    for (std::size_t lane = 0; lane < static_cast<std::size_t>(constraint.count) && !manifold.slides; ++lane) {
      const double most = kSlidingShare * constraint.friction * y[0][lane];
      if (!(y[0][lane] > 0.0) || y[1][lane] * y[1][lane] + y[2][lane] * y[2][lane] < most * most) continue;
      const ContactPoint& point = manifold.contact.points[prepared_.sources[p].point[lane]];
      manifold.slides = tangential(manifold, end_velocity(scene.bodies, manifold, point)).norm() > slow;
    }
    any = any || manifold.slides;
  }
  return any;
}

/// Time until the first slip ends or reverses within the step; `step` where none does. How fast it slows down is what
/// it did in the last step, or, where the effective gravity has changed since, on something fixed, what a block does
/// that slides there alone.
double IslandStepper::first_slip_end(const Scene& scene, const StepTerms& terms, double step) const {
  const Bodies& bodies = scene.bodies;
  const auto rate = [&](std::int32_t body, const Vec3& point) -> Vec3 {
    if (stays(bodies, body)) return Vec3::Zero();
    return bodies.acceleration[at(body)] +
           bodies.angular_acceleration[at(body)].cross(point - bodies.state.position[at(body)]);
  };
  const bool changed = terms.reset_warm_start && impact_cuts_ + slip_end_cuts_ == 0;
  double first = step;
  for (std::size_t p = 0; p < prepared_.sources.size(); ++p) {
    const Manifold& manifold = scene.manifolds[prepared_.sources[p].manifold];
    if (manifold.friction == 0.0) continue;
    for (std::size_t lane = 0; lane < static_cast<std::size_t>(prepared_.problem.constraints[p].count); ++lane) {
      if (!(prepared_.problem.constraints[p].impulse.row[0][lane] > 0.0)) continue;
      const ContactPoint& point = manifold.contact.points[prepared_.sources[p].point[lane]];
      const Vec3 slip = tangential(manifold, relative_velocity(bodies, manifold, point));
      const double speed = slip.norm();
      if (speed <= kSlipShare * terms.velocity_unit) continue;
      const Vec3 end = tangential(manifold, end_velocity(bodies, manifold, point));
      // A slip that keeps some speed in its direction goes on.
      if (end.dot(slip) > kSlipShare * speed * speed) continue;
      double slowing =
          -slip.dot(tangential(manifold, rate(manifold.b, point.on_b) - rate(manifold.a, point.on_a))) / speed;
      if (changed && is_fixed(bodies, manifold.a)) {
        const Vec3& g = terms.effective_gravity;
        slowing = manifold.friction_now() * std::max(0.0, -g.dot(manifold.contact.normal)) -
                  slip.dot(tangential(manifold, g)) / speed;
      }
      if (slowing > 0.0) first = std::min(first, speed / slowing);
    }
  }
  // A cut right at the start or the end of the step would change nothing.
  return first > kLeastCut * terms.step && first < step - kLeastCut * terms.step ? first : step;
}

}  // namespace holdfast::internal::native
