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

/// What a constraint's points begin a step with, container frame.
struct alignas(64) ContactStart {
  ConstraintVector force;             ///< of the last step, N
  ConstraintVector contact_velocity;  ///< of the last step, without the bias, m/s
  Lanes gap = {};                     ///< m
};

/// Scales of a step.
struct StepScale {
  double step = 0.0;           ///< s
  double velocity_unit = 0.0;  ///< |g − a| times the whole step, m/s
  double lasting_slip = 0.0;   ///< above it, friction opposes the mean of a slip, and not that at the end, m/s
};

/// Makes the impulses and contact velocities with which a solve starts from those of the last step.
/// @param step  s
/// @param start one per constraint
void start_from_last(double step, std::span<const ContactStart> start, std::span<ContactConstraint> constraints);

/// The same for a step, with velocity biases, and with arms of its middle and its end. On entry the arms of a
/// constraint are those at the start of the step.
/// @param start       one per constraint
/// @param motion      a body; the last entry, of what is fixed, is zero
/// @param mid_arms    a constraint; empty: no body turns
/// @param late_impact a body and what is fixed: 1 where a contact closes faster than the step can follow, else as it
/// was
/// @returns whether any contact does
bool start_step(const StepScale& scale, std::span<const ContactStart> start, std::span<const BodyMotion> motion,
                std::span<ContactConstraint> constraints, std::span<Arms> mid_arms,
                std::span<std::uint8_t> late_impact);

/// What the next step begins with, but for gaps.
/// @param step s
/// @param next one per constraint
void to_container_frame(double step, std::span<const ContactConstraint> constraints, std::span<ContactStart> next);

}  // namespace holdfast::internal::native
