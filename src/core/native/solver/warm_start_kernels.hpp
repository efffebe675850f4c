#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/native/solver/contact_constraint.hpp"

// The inner loops between the impulses that are kept from step to step, in the container's frame, and those of a
// problem, along the directions of its constraints.

namespace holdfast::internal::native {

/// How a body moves at the start of a step, and how it is predicted to turn within it; zero for what is fixed.
struct alignas(64) BodyMotion {
  std::array<double, 3> velocity = {};          ///< m/s
  std::array<double, 3> angular_velocity = {};  ///< rad/s
  bool turns = false;
  /// Rotation matrices from the start of the step to its middle and to its end, row by row, where the body turns.
  std::array<std::array<double, 3>, 3> turn_mid = {}, turn_end = {};
};

/// Start values of a step.
struct StepStart {
  double step = 0.0;           ///< s
  double velocity_unit = 0.0;  ///< |g − a| times the whole step, m/s
};

/// Makes the start values of the constraints from impulses of the last step. On entry a constraint holds of each point
/// the force, N, in place of the impulse, and the contact velocity, both in the container's frame.
/// @param step s
void start_from_last(double step, std::span<ContactConstraint> constraints);

/// The same for a step, with velocity biases, and with arms of its middle and its end. On entry a constraint holds of
/// each point also the arms at the start of the step, and the gap, m, in place of the bias along the normal.
/// @param motion      a body; the last entry, of what is fixed, is zero
/// @param mid_arms    a constraint; empty: no body turns
/// @param late_impact a body and what is fixed: 1 where a contact closes faster than the step can follow, else as it
/// was
/// @returns whether any contact does
bool start_step(const StepStart& start, std::span<const BodyMotion> motion, std::span<ContactConstraint> constraints,
                std::span<Arms> mid_arms, std::span<std::uint8_t> late_impact);

/// What is to be kept for the next step: forces, N, and contact velocities without the bias, in the container's frame.
/// @param step             s
/// @param force            a constraint
/// @param contact_velocity a constraint
void to_container_frame(double step, std::span<const ContactConstraint> constraints, std::span<ConstraintVector> force,
                        std::span<ConstraintVector> contact_velocity);

}  // namespace holdfast::internal::native
