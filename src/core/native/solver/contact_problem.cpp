#include "core/native/solver/contact_problem.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/native/constants.hpp"
#include "core/native/solver/body_kernels.hpp"
#include "core/native/solver/contact_kernels.hpp"

namespace holdfast::internal::native {

double ContactProblem::mass() const {
  double mass = 0.0;
  for (const ProblemBody& body : bodies) mass += body.mass;
  return mass;
}

void ContactProblem::reset_warm_start() {
  std::copy(free_velocity.begin(), free_velocity.end(), velocity.begin());
  mid_arms.clear();
  continues = false;
  for (ContactConstraint& constraint : constraints) {
    constraint.impulse = ConstraintVector{};
    constraint.contact_velocity = ConstraintVector{};
    constraint.expected_impulse = Lanes{};
  }
}

void find_missing_momentum(const ContactProblem& problem, std::vector<LaneWrench>& wrench,
                           std::vector<BodyVector>& missing) {
  wrench.assign(problem.bodies.size() + 1, LaneWrench{});
  add_impulses(problem.constraints, problem.mid_arms, wrench);
  missing.resize(problem.bodies.size());
  momentum_residual(problem.bodies, problem.free_velocity, problem.velocity.data(), wrench, missing);
}

bool impulses_are_in_cones(const ContactProblem& problem) {
  // Squares of smaller numbers are 0, and are not cut.
  const double underflow = std::sqrt(std::numeric_limits<double>::min());
  for (const ContactConstraint& constraint : problem.constraints) {
    const auto& y = constraint.impulse.row;
    for (std::size_t lane = 0; lane < static_cast<std::size_t>(constraint.count); ++lane) {
      const double tangential = std::hypot(y[1][lane], y[2][lane]);
      if (y[0][lane] < 0.0 || tangential > constraint.friction * y[0][lane] * (1.0 + kRounding) + underflow)
        return false;
    }
  }
  return true;
}

bool impulses_are_in_bounds(const ContactProblem& problem) {
  for (std::size_t p = 0; p < problem.normal_bounds.size(); ++p)
    for (std::size_t lane = 0; lane < kLanes; ++lane)
      if (problem.constraints[p].impulse.row[0][lane] > problem.normal_bounds[p].lane[lane] * (1.0 + kRounding))
        return false;
  return true;
}

double largest_speed(const ContactProblem& problem, std::size_t body) {
  const double* v = problem.velocity[body].row;
  const double* w = v + kAngularRow;
  return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) +
         problem.bodies[body].radius * std::sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
}

double largest_speed(const ContactProblem& problem) {
  double largest = 0.0;
  for (std::size_t i = 0; i < problem.bodies.size(); ++i) largest = std::max(largest, largest_speed(problem, i));
  return largest;
}

}  // namespace holdfast::internal::native
