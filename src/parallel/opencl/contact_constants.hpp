#pragma once

namespace holdfast::internal {

/// Margin by which a shape is larger than its box on every side, m. Bullet's narrow phase finds no pair of shapes that
/// do not overlap; with the margin a resting contact persists at a distance of zero.
inline constexpr double kShapeMargin = 0.0005;

/// Boxes whose overlap perpendicular to the contact normal is smaller than this touch only at an edge, m.
inline constexpr double kEdgeOverlap = 0.0003;

/// Fraction of a penetration that is corrected per step, as in Bullet on the CPU.
inline constexpr double kErp = 0.2;

/// Approach speed below which contacts do not rebound, m/s, as in Bullet on the CPU.
inline constexpr double kReboundSpeed = 0.2;

/// Outer sweeps over all contacts in Bullet's host code; the sweeps of this project are within each of them.
inline constexpr int kOuterSweeps = 4;

}  // namespace holdfast::internal
