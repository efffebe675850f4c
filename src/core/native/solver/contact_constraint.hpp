#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>

namespace holdfast::internal::native {

/// Contact points that are solved side by side, one per SIMD lane.
inline constexpr int kLanes = 4;

/// Two bodies that share contacts, by index.
using BodyPair = std::pair<std::uint32_t, std::uint32_t>;

/// Pair of a constraint with what is fixed: it has no block off the diagonal.
inline constexpr std::uint32_t kNoPair = ~0U;

/// One number of each of a constraint's points.
using Lanes = std::array<double, kLanes>;

/// A vector's three components and a zero.
using Direction = std::array<double, kLanes>;

/// Arms of a constraint's points: from each body's centre of mass to the point, container frame, m.
struct alignas(32) Arms {
  std::array<Lanes, 3> a = {};
  std::array<Lanes, 3> b = {};
};

/// As kernels take the arms of the middle of the step: null stands for those of the constraints.
inline const Arms* arms_or_null(std::span<const Arms> arms) { return arms.empty() ? nullptr : arms.data(); }

/// A number for each direction and point of a constraint.
struct alignas(32) ConstraintVector {
  std::array<Lanes, 3> row = {};
};

/// A 3×3 matrix for each point of a constraint, rows and columns by direction.
struct alignas(32) ConstraintMatrix {
  std::array<std::array<Lanes, 3>, 3> entry = {};
};

/// The largest normal impulses that a constraint's points may have, kg m/s.
struct alignas(32) NormalBounds {
  Lanes lane = {};
};

/// Up to four contact points of two bodies with one normal and one friction coefficient: what the contact solver
/// reads and writes in an iteration. Directions: 0 along the normal, 1 and 2 along the tangents. A lane without a
/// point has penalty 0 and stays at impulse 0, as do the tangents of a constraint without friction.
struct alignas(64) ContactConstraint {
  Arms arms;                          ///< at the end of the step: where velocities are measured
  ConstraintVector impulse;           ///< y, on b, opposite on a, kg m/s
  ConstraintVector contact_velocity;  ///< z, the velocity that goes with the impulse by Coulomb's law, m/s
  /// Added to the velocity, m/s: along the normal, what must stay ≥ 0 is the sum; along the tangents, the sum is what
  /// friction opposes.
  ConstraintVector velocity_bias;
  Lanes expected_impulse = {};                ///< normal impulse that the point is likely to carry, kg m/s
  std::array<Lanes, 2> penalty = {};          ///< R of the splitting, normal and tangential, kg
  std::array<Lanes, 2> inverse_penalty = {};  ///< 1 / R, 0 where R is 0, 1/kg
  std::array<Direction, 3> directions = {};   ///< normal (from a to b) and tangents, unit, container frame
  double friction = 0.0;
  std::int32_t a = 0;  ///< index of a body in the problem; their count: something fixed
  std::int32_t b = 0;
  std::int32_t count = 0;       ///< points in use, the first lanes
  double effective_mass = 0.0;  ///< effective mass of the two bodies over the contact's points, kg
};

}  // namespace holdfast::internal::native
