#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "core/model/container_sides.hpp"
#include "core/native/constants.hpp"
#include "core/native/scene.hpp"
#include "core/native/solver/contact_problem.hpp"

// How bodies move at a contact, what a contact is to them, and when it is looked for.

namespace holdfast::internal::native {

inline std::size_t at(std::int32_t index) { return static_cast<std::size_t>(index); }

/// How a rigid body moves: the velocity of its centre of mass, m/s, and its angular velocity, rad/s.
struct Twist {
  Vec3 centre = Vec3::Zero();  ///< of mass, m
  Vec3 linear = Vec3::Zero();
  Vec3 angular = Vec3::Zero();

  /// Velocity of the body's point that is there, m/s.
  Vec3 at_point(const Vec3& point) const { return linear + angular.cross(point - centre); }
};

/// The twist of a body; a negative index is a side of the container.
inline Twist twist_of(const Bodies& bodies, std::int32_t body) {
  if (body < 0) return {};
  const StateColumns& state = bodies.state;
  return {state.position[at(body)], state.velocity[at(body)], state.angular_velocity[at(body)]};
}

/// How the two bodies of a contact move, for the velocities at all of its points.
class RelativeTwist {
 public:
  RelativeTwist(const Twist& a, const Twist& b, const Vec3& normal) : a_(a), b_(b), normal_(normal) {}

  /// Of the surfaces: positive where they separate, m/s.
  double normal_velocity(const ContactPoint& point) const {
    return normal_.dot(b_.at_point(point.on_b) - a_.at_point(point.on_a));
  }

 private:
  Twist a_, b_;
  Vec3 normal_;
};

/// Velocity of a body at a point, m/s; a negative index is a side of the container.
inline Vec3 velocity_at(const Bodies& bodies, std::int32_t body, const Vec3& point) {
  return twist_of(bodies, body).at_point(point);
}

/// Velocity of b's surface relative to a's, m/s.
inline Vec3 relative_velocity(const Bodies& bodies, const Manifold& manifold, const ContactPoint& point) {
  return velocity_at(bodies, manifold.b, point.on_b) - velocity_at(bodies, manifold.a, point.on_a);
}

/// Normal velocity of the surfaces at a point: positive where they separate, m/s.
inline double normal_velocity(const Bodies& bodies, const Manifold& manifold, const ContactPoint& point) {
  return manifold.contact.normal.dot(relative_velocity(bodies, manifold, point));
}

inline bool is_fixed(const Bodies& bodies, std::int32_t body) {
  return body < 0 || bodies.activity[at(body)] == Activity::fixed;
}

/// Whether the body does not move in this step: it is fixed, or asleep.
inline bool stays(const Bodies& bodies, std::int32_t body) {
  return is_fixed(bodies, body) || bodies.activity[at(body)] == Activity::asleep;
}

/// What counts as pushed, in `kPushedNames`, where a body presses an end of a manifold that stays: a side, the fixed
/// boxes, or the floor where the end sleeps. None where there is no floor.
std::optional<std::size_t> pushed_side(const Scene& scene, const Manifold& manifold, std::int32_t end);

/// Whether no body of an island is faster than `speed`, m/s.
bool is_slow(const Bodies& bodies, const IslandView& island, double speed);

/// Whether the contact can carry weight: one body is on the other, or on something fixed.
inline bool supports(const Bodies& bodies, const Manifold& manifold) {
  const double up = manifold.contact.normal.z();
  if (is_fixed(bodies, manifold.a)) return up > kSupporting;
  if (is_fixed(bodies, manifold.b)) return up < -kSupporting;
  return std::abs(up) > kSupporting;
}

/// Whether something fixed is beside the body or above it, not below: the contact has play, and carries only what is
/// pushed into it.
inline bool is_wall_or_roof(const Bodies& bodies, const Manifold& manifold) {
  return (is_fixed(bodies, manifold.a) || is_fixed(bodies, manifold.b)) && !supports(bodies, manifold);
}

/// Whether something fixed is beside the body.
inline bool is_wall(const Bodies& bodies, const Manifold& manifold) {
  return is_wall_or_roof(bodies, manifold) && std::abs(manifold.contact.normal.z()) <= kSupporting;
}

/// Gap up to which a body may lean on another or on a wall without having moved, m: the play that it has there.
inline double leaning_gap(const Scene& scene, const Manifold& manifold) {
  if (!is_wall(scene.bodies, manifold)) return kTouch;
  return kTouch + (manifold.with_side() ? scene.sides[side_of(manifold)].play[at(manifold.b)] : kLeastPlay);
}

/// Whether a contact overlaps by `deep`, m, more than the one before it, so that it should have been found earlier.
/// Corners that approach along two directions at once have no contact until they overlap.
/// @param gap_before nearest gap of the contact before it, m; infinite: there was none
bool is_missed_contact(const ContactSet& contact, double gap_before, double deep);

/// Overlap at the end of a step from which a contact has to be solved, m: none but rounding where it can carry weight.
/// A box that slides from one support to the next would tilt at each until it overlaps by as much, and slide on
/// downhill.
/// @param beside where it cannot, m
inline double penetration_slop(const Bodies& bodies, const Manifold& manifold, double beside) {
  return supports(bodies, manifold) ? kNegligible * kTouch : beside;
}

/// Gap up to which contacts are looked for: two bodies this near may meet within the next step, however long it is, m.
/// @param approach bound of the speed at which their surfaces approach each other, m/s
double speculative_margin(const StepTerms& terms, double approach);

/// The same of body or side `a` and body `b`, as fast as they are now in whatever direction, m.
double speculative_margin(const StepTerms& terms, const Bodies& bodies, std::int32_t a, std::int32_t b);

}  // namespace holdfast::internal::native
