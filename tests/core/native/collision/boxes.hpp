#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "core/native/collision/box_box.hpp"

/// Boxes for tests of their geometry.
namespace holdfast::internal::native {

inline OrientedBox box_at(const Vec3& centre, const Vec3& size) {
  return {.centre = centre, .half_extents = 0.5 * size, .axes = Mat3::Identity(), .aligned = true};
}

inline OrientedBox turned(OrientedBox box, const Vec3& axis, double angle) {
  box.axes = Eigen::AngleAxisd(angle, Eigen::Vector3d(axis).normalized()).toRotationMatrix() * box.axes;
  box.aligned = false;
  return box;
}

/// The same box, through the path of rotated boxes.
inline OrientedBox as_rotated(OrientedBox box) {
  box.aligned = false;
  return box;
}

inline double least_gap(const ContactSet& contact) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < contact.count; ++i) least = std::min(least, contact.points[static_cast<std::size_t>(i)].gap);
  return least;
}

}  // namespace holdfast::internal::native
