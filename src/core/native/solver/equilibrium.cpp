#include "core/native/solver/equilibrium.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/native/constants.hpp"
#include "core/native/solver/body_kernels.hpp"
#include "core/native/solver/contact_kernels.hpp"

namespace holdfast::internal::native {

double EquilibriumCheck::residual(const ContactProblem& problem, double velocity_unit) {
  wrench_.assign(problem.bodies.size() + 1, LaneWrench{});
  add_impulses(problem.constraints, problem.mid_arms, wrench_);
  force_.resize(problem.bodies.size());
  momentum_residual(problem.bodies, problem.free_velocity, nullptr, wrench_, force_);
  double worst = 0.0;
  for (std::size_t i = 0; i < problem.bodies.size(); ++i) {
    const ProblemBody& body = problem.bodies[i];
    const double* f = force_[i].row;
    const double* t = f + kAngularRow;
    const double force = std::sqrt(f[0] * f[0] + f[1] * f[1] + f[2] * f[2]);
    const double torque = std::sqrt(t[0] * t[0] + t[1] * t[1] + t[2] * t[2]);
    if (std::isnan(force) || std::isnan(torque)) return std::numeric_limits<double>::infinity();
    worst = std::max(worst, std::max(force, torque / body.radius) / (body.mass * velocity_unit));
  }
  return worst;
}

bool EquilibriumCheck::refutes_rest(const ContactProblem& problem, double largest_impulse) {
  const std::size_t count = problem.bodies.size();
  speed_.resize(count);
  power_.resize(count);
  double fastest = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const ProblemBody& body = problem.bodies[i];
    const BodyVector& v = problem.velocity[i];
    const BodyVector& free = problem.free_velocity[i];
    speed_[i] = largest_speed(problem, i);
    fastest = std::max(fastest, speed_[i]);
    // Gravity does not turn a body, but a force from outside may.
    power_[i] = body.mass * (v.row[0] * free.row[0] + v.row[1] * free.row[1] + v.row[2] * free.row[2]) +
                angular(v).dot(body.inertia * angular(free));
  }
  // Every motion may be the proof: without the bodies that hardly move it is one sooner.
  motion_ = problem.velocity;
  for (const double share : {0.0, kSmall, kNoticeable, 0.5}) {
    double power = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      if (speed_[i] < share * fastest)
        motion_[i] = BodyVector{};
      else
        power += power_[i];
    }
    if (power > supported_power(problem.constraints, motion_, largest_impulse, problem.normal_bounds)) return true;
  }
  return false;
}

}  // namespace holdfast::internal::native
