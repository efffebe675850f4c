#include "core/native/solver/equilibrium.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/native/solver/contact_kernels.hpp"

namespace holdfast::internal::native {

double EquilibriumCheck::residual(const ContactProblem& problem, double velocity_unit) {
  wrench_.assign(problem.bodies.size() + 1, LaneWrench{});
  add_impulses(problem.constraints, problem.mid_arms, wrench_);
  momentum_residual(problem, wrench_, true, force_);
  double worst = 0.0;
  for (std::size_t i = 0; i < problem.bodies.size(); ++i) {
    const ProblemBody& body = problem.bodies[i];
    const double* f = force_[i].row;
    const double force = std::sqrt(f[0] * f[0] + f[1] * f[1] + f[2] * f[2]);
    const double torque = std::sqrt(f[3] * f[3] + f[4] * f[4] + f[5] * f[5]);
    if (std::isnan(force) || std::isnan(torque)) return std::numeric_limits<double>::infinity();
    worst = std::max(worst, std::max(force, torque / body.radius) / (body.mass * velocity_unit));
  }
  return worst;
}

bool EquilibriumCheck::refutes_rest(const ContactProblem& problem, double largest_impulse) {
  const double fastest = largest_speed(problem);
  // Every motion may be the proof: without the bodies that hardly move it is one sooner.
  for (const double share : {0.0, 0.01, 0.1, 0.5}) {
    motion_ = problem.velocity;
    double power = 0.0;
    for (std::size_t i = 0; i < problem.bodies.size(); ++i) {
      if (largest_speed(problem, i) < share * fastest) motion_[i] = BodyVector{};
      const double* v = motion_[i].row;
      const double* free = problem.free_velocity[i].row;
      for (int k = 0; k < 3; ++k) power += problem.bodies[i].mass * v[k] * free[k];
      // Gravity does not turn a body, but a force from outside may.
      power += Vec3(v[3], v[4], v[5]).dot(problem.bodies[i].inertia * Vec3(free[3], free[4], free[5]));
    }
    if (power > supported_power(problem, largest_impulse)) return true;
  }
  return false;
}

/// The most that impulses can take from the motion, kg m²/s².
double EquilibriumCheck::supported_power(const ContactProblem& problem, double largest_impulse) {
  const std::vector<ContactConstraint>& constraints = problem.constraints;
  u_.resize(constraints.size());
  find_contact_velocities(constraints, motion_, u_);
  double power = 0.0;
  for (std::size_t p = 0; p < constraints.size(); ++p) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(constraints[p].count); ++i) {
      const auto& u = u_[p].row;
      const double slip = std::sqrt(u[1][i] * u[1][i] + u[2][i] * u[2][i]);
      const double most =
          problem.normal_bounds.empty() ? largest_impulse : std::min(largest_impulse, problem.normal_bounds[p].lane[i]);
      power += most * std::max(0.0, constraints[p].friction * slip - u[0][i]);
    }
  }
  return power;
}

}  // namespace holdfast::internal::native
