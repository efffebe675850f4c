#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace holdfast::internal {

/// A vector in the container frame unless its name says otherwise; its unit is in the documentation of the name.
using Vec3 = Eigen::Matrix<double, 3, 1, Eigen::DontAlign>;

/// A unit quaternion; names say which frames it connects (`container_from_body`).
/// Unaligned, so that its columns are plain arrays.
using Rotation = Eigen::Quaternion<double, Eigen::DontAlign>;

}  // namespace holdfast::internal
