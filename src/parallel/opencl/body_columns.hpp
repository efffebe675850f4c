#pragma once

#include <array>

namespace holdfast::internal {

using Float4Column = std::array<float, 4>;

/// A body as Bullet's pipeline keeps it on the device. Two of its numbers, which the pipeline carries and never reads,
/// serve this project.
struct DeviceBody {
  Float4Column position = {};     ///< of the centre of mass, container's frame, m
  Float4Column orientation = {};  ///< x, y, z, w; container_from_body
  Float4Column velocity = {};     ///< m/s
  Float4Column angular_velocity = {};
  int shape = 0;
  float inverse_mass = 0.0F;  ///< 1/kg; 0: nothing moves it
  float world = 0.0F;         ///< index of its world (Bullet: coefficient of restitution)
  float sweeps = 0.0F;        ///< of the solver inside each of Bullet's outer ones (Bullet: coefficient of friction)
};

/// A body's inverse inertia in the container's axes, twice, as rows of four numbers. Bullet reads three of each.
struct DeviceInertia {
  std::array<Float4Column, 3> now = {};  ///< fourth column: half extents, m; 0 where the shape is not about its centre
  std::array<Float4Column, 3> setup = {};  ///< fourth column: steps a second; coefficient of restitution; of friction
};

}  // namespace holdfast::internal
