#pragma once

#include <optional>

#include "core/native/solver/contact_solver.hpp"

namespace holdfast::internal::native {

/// How far apart two velocities of a problem's bodies are: of each body, no point differs by more than |Δv| + r |Δω|,
/// with r the radius of the sphere around the box.
struct VelocityDifference {
  double mean = 0.0;   ///< root of the mean square over the bodies, m/s
  double worst = 0.0;  ///< largest of all bodies, m/s
};

/// Between the velocities that two solves of the same problem ended with.
VelocityDifference velocity_difference(const ContactProblem& found, const ContactProblem& other);

/// A problem whose solve went on for long.
struct LongSolve {
  ContactProblem problem;  ///< with the solution
  SolveResult result;
};

/// Solves a problem to 1e-6 of the limits' unit, with at most so many iterations.
LongSolve solve_for_long(const ContactProblem& problem, const SolveLimits& limits, int iterations);

/// What two independent methods disagree by where both go on for long: the splitting, and projected Gauss-Seidel point
/// by point (`core/reference/plain_solver.hpp`). Both solve the problem without what the plain method does not model:
/// arms of mid step, and what friction opposes beside the velocity. Nothing where a normal impulse is bounded.
std::optional<VelocityDifference> method_difference(const ContactProblem& problem, const SolveLimits& limits,
                                                    int iterations);

}  // namespace holdfast::internal::native
