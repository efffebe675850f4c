#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace holdfast::internal {

/// A vector in the container frame unless its name says otherwise; its unit is in the documentation of the name.
using Vec3 = Eigen::Matrix<double, 3, 1, Eigen::DontAlign>;

/// A unit quaternion; names say which frames it connects (`container_from_body`).
/// Unaligned, so that its columns are plain arrays.
using Rotation = Eigen::Quaternion<double, Eigen::DontAlign>;

/// A vector and a quaternion as the results file stores them: float32, the latter as w, x, y, z.
struct Float3 {
  float x = 0, y = 0, z = 0;
};
struct Float4 {
  float w = 1, x = 0, y = 0, z = 0;
};

}  // namespace holdfast::internal
