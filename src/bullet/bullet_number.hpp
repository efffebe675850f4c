#pragma once

#include <LinearMath/btQuaternion.h>
#include <LinearMath/btVector3.h>

#include "core/base/vector.hpp"

// The adapter is compiled once for each of Bullet's two builds; with the wrong headers it would misread every vector.
static_assert(sizeof(btScalar) == HOLDFAST_BULLET_SCALAR_BYTES, "Bullet's headers and libraries differ in precision");

namespace holdfast::internal {

inline btScalar to_bullet(double number) { return static_cast<btScalar>(number); }

inline btVector3 to_bullet(const Vec3& v) { return {to_bullet(v.x()), to_bullet(v.y()), to_bullet(v.z())}; }

inline Vec3 from_bullet(const btVector3& v) {
  return {static_cast<double>(v.x()), static_cast<double>(v.y()), static_cast<double>(v.z())};
}

inline Rotation from_bullet(const btQuaternion& q) {
  Rotation rotation(static_cast<double>(q.w()), static_cast<double>(q.x()), static_cast<double>(q.y()),
                    static_cast<double>(q.z()));
  rotation.normalize();
  return rotation;
}

}  // namespace holdfast::internal
