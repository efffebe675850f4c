#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace holdfast::internal {

/// A vector in the container frame unless its name says otherwise; the unit is in the name's doc.
using Vec3 = Eigen::Matrix<double, 3, 1, Eigen::DontAlign>;

/// A unit quaternion; names say which frames it connects (`container_from_body`).
/// Unaligned, so that columns of it are plain arrays.
using Rotation = Eigen::Quaternion<double, Eigen::DontAlign>;

}  // namespace holdfast::internal
