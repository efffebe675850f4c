#pragma once

namespace holdfast::internal {

/// By how much a shape is larger than its box on every side, m. Bullet's narrow phase sees no pair that is apart; with
/// the margin a resting contact lasts, at a distance of zero.
inline constexpr double kShapeMargin = 0.0005;

/// Boxes that overlap by less than this across a contact's normal touch at an edge only, m.
inline constexpr double kEdgeOverlap = 0.0003;

/// Share of an overlap that is undone in a step, as on Bullet's CPU.
inline constexpr double kErp = 0.2;

/// Approach speed below which nothing rebounds, m/s, as on Bullet's CPU.
inline constexpr double kReboundSpeed = 0.2;

/// Outer sweeps that Bullet's host code makes over all contacts; ours are inside each of them.
inline constexpr int kOuterSweeps = 4;

}  // namespace holdfast::internal
