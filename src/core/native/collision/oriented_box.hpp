#pragma once

#include <Eigen/Core>

#include "core/base/vector.hpp"

namespace holdfast::internal::native {

/// A rotation matrix; unaligned, like all small vectors of the columns.
using Mat3 = Eigen::Matrix<double, 3, 3, Eigen::DontAlign>;

/// The shape of a box where it is now, in the container's frame.
struct OrientedBox {
  Vec3 centre = Vec3::Zero();        ///< centroid, m
  Vec3 half_extents = Vec3::Zero();  ///< along the body's axes, m
  Mat3 axes = Mat3::Identity();      ///< container_from_body; its columns are the body's axes
  bool aligned = true;               ///< axes are exactly the identity

  /// Half of its extent along the container's axes, m.
  Vec3 bounding_half_extents() const { return axes.cwiseAbs() * half_extents; }
};

/// A side of the container: everything with normal · x ≥ offset is free.
struct HalfSpace {
  Vec3 normal = Vec3::UnitZ();  ///< unit, into the container
  double offset = 0.0;          ///< m
};

}  // namespace holdfast::internal::native
