#pragma once

#include <array>

namespace holdfast::internal {

using Float4Column = std::array<float, 4>;

/// A body as Bullet's pipeline stores it on the device. This project uses two of its fields, which the pipeline
/// transports and never reads.
struct DeviceBody {
  Float4Column position = {};     ///< of the centre of mass, container's frame, m
  Float4Column orientation = {};  ///< x, y, z, w; container_from_body
  Float4Column velocity = {};     ///< m/s
  Float4Column angular_velocity = {};
  int shape = 0;
  float inverse_mass = 0.0F;  ///< 1/kg; 0: fixed
  float world = 0.0F;         ///< index of its world (Bullet: coefficient of restitution)
  float sweeps = 0.0F;        ///< of the solver within each of Bullet's outer sweeps (Bullet: coefficient of friction)
};

/// A body's inverse inertia in the container's axes, twice, as rows of four numbers. Bullet reads three of each row.
struct DeviceInertia {
  std::array<Float4Column, 3> now = {};    ///< fourth column: half extents, m; 0 if the shape is not centred
  std::array<Float4Column, 3> setup = {};  ///< fourth column: steps per second; coefficient of restitution; of friction
};

}  // namespace holdfast::internal
