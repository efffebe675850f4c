#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/base/vector.hpp"

/// The parts of the engine `native-plain`, which is written to be read: nothing is kept from step to step, and every
/// pair is looked at. Independent of `core/native`, whose tests it is the measure of.
namespace holdfast::internal::plain {

/// A box as a solid where it is now, in the container's frame.
struct Block {
  Vec3 centre = Vec3::Zero();                          ///< centroid, m
  Vec3 half_extents = Vec3::Zero();                    ///< along its own axes, m
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< container_from_body: its columns are its axes
};

/// A side of the container as a half-space: what has normal · x >= offset is inside.
struct HalfSpace {
  Vec3 normal = Vec3::UnitZ();  ///< unit, into the container
  double offset = 0.0;          ///< m
};

/// A place where two bodies touch, or will within a step.
struct ContactPoint {
  Vec3 position = Vec3::Zero();  ///< halfway between the two surfaces, m
  Vec3 normal = Vec3::Zero();    ///< unit, from the first body to the second
  double gap = 0.0;              ///< distance of the surfaces along the normal, m; negative where they overlap
};

/// Lengths below this are nothing: blocks that overlap by less across the normal touch along an edge or a corner
/// only, and an axis must be better by more to be taken instead of another one, m.
inline constexpr double kNothing = 1e-5;

/// The corners of the block that are not further from the side than `margin`, m. The normal points to the block.
std::vector<ContactPoint> contact_points(const HalfSpace& side, const Block& block, double margin);

/// Where the blocks are not further from each other than `margin`, m. The normal points from a to b.
///
/// The normal is the one along which they are furthest apart, or overlap least, of the six face normals and the nine
/// products of edges (separating axis test: Gottschalk, Lin, Manocha 1996). For a face it is the part of the other
/// block's face that lies over it, its corners: 8 points at most; for two edges the one point where they are closest.
/// Blocks that share an edge or a corner only have none.
std::vector<ContactPoint> contact_points(const Block& a, const Block& b, double margin);

}  // namespace holdfast::internal::plain
