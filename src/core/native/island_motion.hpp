#pragma once

#include "core/model/container_sides.hpp"
#include "core/native/island.hpp"

// What the parts of IslandStepper share: how bodies move at a point, and when they touch.

namespace holdfast::internal::native {

/// A contact supports, rather than merely touches, when its normal is this much along the vertical.
inline constexpr double kSupporting = 0.5;

/// Surfaces this near are in touch, m: rounding of positions is far below, what a scene shows far above.
inline constexpr double kTouch = 1e-7;

/// Approach, and change of velocity beyond that of the step before, above this share of |g − a| h are an impact.
inline constexpr double kJumpShare = 0.1;

/// Slip below this share of |g − a| h is none.
inline constexpr double kSlipShare = 1e-3;

/// No part of a step that is cut is shorter than this share of it.
inline constexpr double kLeastStep = 1e-4;

/// Normal force that a proof of rest may use at a wall or roof, over that with which the body pressed against it in the
/// last step: what is pushed into it and no more, but for the tolerance of the step.
inline constexpr double kPressedMore = 1.01;

/// Largest rotation that a step's arms are predicted for, rad.
inline constexpr double kLargestTurn = 0.25;

inline std::size_t at(std::int32_t index) { return static_cast<std::size_t>(index); }

inline Vec3 linear(const BodyVector& v) { return {v.row[0], v.row[1], v.row[2]}; }
inline Vec3 angular(const BodyVector& v) { return {v.row[3], v.row[4], v.row[5]}; }
inline BodyVector body_vector(const Vec3& linear, const Vec3& angular) {
  return {{linear.x(), linear.y(), linear.z(), angular.x(), angular.y(), angular.z(), 0.0, 0.0}};
}

/// Velocity of body `body` (negative: a side) at a point.
inline Vec3 velocity_at(const Bodies& bodies, std::int32_t body, const Vec3& point) {
  if (body < 0) return Vec3::Zero();
  const StateColumns& state = bodies.state;
  return state.velocity[at(body)] + state.angular_velocity[at(body)].cross(point - state.position[at(body)]);
}

/// Velocity of b's surface relative to a's, m/s.
inline Vec3 relative_velocity(const Bodies& bodies, const Manifold& manifold, const ContactPoint& point) {
  return velocity_at(bodies, manifold.b, point.on_b) - velocity_at(bodies, manifold.a, point.on_a);
}

/// Speed at which the surfaces part at a point, m/s.
inline double parting(const Bodies& bodies, const Manifold& manifold, const ContactPoint& point) {
  return manifold.contact.normal.dot(relative_velocity(bodies, manifold, point));
}

inline bool is_fixed(const Bodies& bodies, std::int32_t body) { return body < 0 || bodies.fixed[at(body)] != 0; }

/// Whether the contact can carry weight: of two bodies one on the other, or of a body on what is fixed below it.
inline bool supports(const Bodies& bodies, const Manifold& manifold) {
  const double up = manifold.contact.normal.z();
  if (is_fixed(bodies, manifold.a)) return up > kSupporting;
  if (is_fixed(bodies, manifold.b)) return up < -kSupporting;
  return std::abs(up) > kSupporting;
}

/// Whether the contact is with what is fixed beside a body or above it, and not below: it has play, and carries only
/// what is pushed into it.
inline bool is_border(const Bodies& bodies, const Manifold& manifold) {
  return (is_fixed(bodies, manifold.a) || is_fixed(bodies, manifold.b)) && !supports(bodies, manifold);
}

/// Whether the contact is with a wall: what is fixed beside a body.
inline bool is_wall(const Bodies& bodies, const Manifold& manifold) {
  return is_border(bodies, manifold) && std::abs(manifold.contact.normal.z()) <= kSupporting;
}

/// Gap up to which a body may lean on another or on a wall without having moved, m.
inline double leaning_gap(const Bodies& bodies, const Manifold& manifold) {
  return is_wall(bodies, manifold) ? kLeastPlay + kTouch : kTouch;
}

}  // namespace holdfast::internal::native
