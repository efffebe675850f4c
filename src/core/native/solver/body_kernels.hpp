#pragma once

#include <span>

#include "core/native/solver/contact_problem.hpp"

// The inner loops over bodies.

namespace holdfast::internal::native {

/// What is left of the momentum equation, M (v* − v) + the wrench of the impulses.
/// @param velocity v, a body; null: all are at rest
/// @param wrench   a body: of the impulses
/// @param out      a body
void momentum_residual(std::span<const ProblemBody> bodies, std::span<const BodyVector> free_velocity,
                       const BodyVector* velocity, std::span<const LaneWrench> wrench, std::span<BodyVector> out);

/// Adds changes to velocities. Returns the largest change of the speed of any point of a body, m/s; not a number where
/// one of them is none.
/// @param change   a body
/// @param velocity a body, and more
double add_velocity_changes(std::span<const ProblemBody> bodies, std::span<const BodyVector> change,
                            std::span<BodyVector> velocity);

}  // namespace holdfast::internal::native
