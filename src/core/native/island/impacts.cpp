#include "core/native/island/impacts.hpp"

namespace holdfast::internal::native {

namespace {

/// By how much the velocity of a surface may change within a step because its body turns, ω² R h, m/s: impacts are
/// predicted with arms that do not turn, and slower ones may not be there at all.
double turning_speed(const Bodies& bodies, const IslandView& island, const StepTerms& terms) {
  double largest = 0.0;
  for (const std::uint32_t body : island.bodies)
    largest = std::max(largest, bodies.state.angular_velocity[body].squaredNorm() * bodies.radius[body]);
  return terms.step * largest;
}

}  // namespace

ImpactTiming impact_timing(const Bodies& bodies, const IslandView& island, const StepTerms& terms, const Effort& effort,
                           bool crowd, int cuts) {
  return {.located_speed = std::max(kSmall * terms.velocity_unit, effort.impact_cuts > 0 && !crowd
                                                                      ? turning_speed(bodies, island, terms)
                                                                      : effort.slop / terms.step),
          .locates = cuts < effort.impact_cuts};
}

void Impacts::resolve(Scene& scene, const IslandView& island, const StepTerms& terms, const Effort& effort,
                      const ImpactTiming& timing, double step, IslandReport& report) {
  Bodies& bodies = scene.bodies;
  IslandProblem& prepared = solve_.prepared;
  double fastest = 0.0;
  const double fast = timing.located_speed;
  const PointFilter filter = timing.filter(step);
  impacting_.assign(scene.manifolds.size(), 0);
  for (const std::uint32_t index : island.manifolds) {
    Manifold& manifold = scene.manifolds[index];
    // Without rebound, and not located in time, an impact needs no solve of its own.
    if (effort.impact_cuts == 0 && manifold.restitution == 0.0) continue;
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
  limits.iterations = 2 * effort.iterations;
  limits.tolerance = effort.tolerance;
  limits.plain_iterations = 0;
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
    prepared.prepare_impact(scene, island, terms, step, solve_.solver(), filter, impacting_);
    // What a contact carries is measured by the impact: by the weight in a step, R would be far too large.
    prepared.problem.impulse_per_mass = unit;
    SolveResult result = solve_.solve_once(limits, report);
    if (result.residual > limits.worst_residual * unit) {
      // Where friction makes normal impulses, as at a kerb, the splitting may diverge.
      prepared.problem.reset_warm_start();
      result = solve_.solve_by_points({.tolerance = kNegligible * unit, .worst_residual = limits.worst_residual * unit},
                                      report);
    }
    propagated = propagate(scene, island, terms, filter, step);
    if (!propagated) report.impact_residual = std::max(report.impact_residual, result.residual / unit);
  }
  if (scene.side_forces.wanted()) {
    prepared.complete_impulses();
    prepared.add_pushes(scene, 1.0, scene.side_forces.of_step());
  }
  for (const std::uint32_t body : island.bodies) {
    bodies.state.velocity[body] = linear(prepared.solution(body));
    bodies.state.angular_velocity[body] = angular(prepared.solution(body));
  }
}

/// Adds all points that touch to the impact, where its solution pushes some of them into each other. False where it
/// pushes none.
bool Impacts::propagate(const Scene& scene, const IslandView& island, const StepTerms& terms, const PointFilter& filter,
                        double step) {
  const Bodies& bodies = scene.bodies;
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
      if (manifold.restitution > 0.0 && before > kNegligible * terms.velocity_unit) continue;
      could_impact_[index] |= bit;
      const double after = motion_.end_normal_velocity(bodies, manifold, point);
      pushes = pushes || std::max(0.0, point.gap) + step * after < -kNegligible * terms.velocity_unit * step;
    }
  }
  if (pushes)
    for (const std::uint32_t index : island.manifolds) impacting_[index] |= could_impact_[index];
  return pushes;
}

}  // namespace holdfast::internal::native
