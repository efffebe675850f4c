#pragma once

#include "core/model/world.hpp"

namespace holdfast::internal {

/// How near a friction coefficient has to be to what an acceleration asks for, relative to that, so that the answer
/// hangs on digits of friction that nobody knows. Twice: worlds with 0.49 under 0.5 g are marginal too, and so on; the
/// mark changes no verdict.
inline constexpr double kMarginalFriction = 0.02;

/// True when the largest ratio of the horizontal to the vertical force that the acceleration puts on a free box,
/// |a_xy| / (g + a_z), is within `kMarginalFriction` of a coefficient of friction between a box of the world and the
/// floor, or another one of its boxes: such a box slides, or does not, by a difference that is not known.
/// @param gravity m/s²
bool has_marginal_friction(const World& world, const BoxView& boxes, double gravity);

}  // namespace holdfast::internal
