#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/base/vector.hpp"

/// The engine `native-plain`, which is written for clarity: it keeps nothing from step to step, and examines every
/// pair. It is independent of `core/native`, whose tests compare with it.
namespace holdfast::internal::plain {

/// A box in its current pose, in the container's frame.
struct Block {
  Vec3 centre = Vec3::Zero();                          ///< centroid, m
  Vec3 half_extents = Vec3::Zero();                    ///< along its own axes, m
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< container_from_body: the columns are the axes of the box
};

/// A side of the container as a half-space: the inside is normal · x >= offset.
struct HalfSpace {
  Vec3 normal = Vec3::UnitZ();  ///< unit, into the container
  double offset = 0.0;          ///< m
};

/// A point at which two bodies touch, or may touch within a step.
struct ContactPoint {
  Vec3 position = Vec3::Zero();  ///< halfway between the two surfaces, m
  Vec3 normal = Vec3::Zero();    ///< unit, from the first body to the second
  double gap = 0.0;              ///< distance of the surfaces along the normal, m; negative: penetration
};

/// Lengths below this count as zero, m. Blocks whose overlap perpendicular to the normal is smaller touch only at an
/// edge or a corner; and an axis replaces another one only if it is better by more than this.
inline constexpr double kNothing = 1e-5;

/// The corners of the block that are at most `margin` (m) from the side. The normal points to the block.
std::vector<ContactPoint> contact_points(const HalfSpace& side, const Block& block, double margin);

/// The contact points of two blocks that are at most `margin` (m) apart. The normal points from a to b.
///
/// The normal is the axis of the largest separation, or of the smallest penetration, among the six face normals and the
/// nine cross products of edges (separating axis test: Gottschalk, Lin, Manocha 1996). For a face axis the points are
/// the corners of the part of the other block's face that lies over the face, at most 8; for two edges there is one
/// point, where they are closest. Blocks that share only an edge or a corner have no contact points.
std::vector<ContactPoint> contact_points(const Block& a, const Block& b, double margin);

}  // namespace holdfast::internal::plain
