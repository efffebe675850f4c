#pragma once

#include <vector>

#include "core/model/settings.hpp"
#include "core/model/world.hpp"
#include "parallel/opencl/body_columns.hpp"
#include "parallel/opencl/bullet3_pipeline.hpp"

namespace holdfast::internal {

/// A batch of worlds as columns of bodies: for each world its boxes in order, then the sides of the container.
struct DeviceBatch {
  std::vector<DeviceBody> bodies;
  std::vector<DeviceInertia> inertias;
  std::vector<Float4Column> body_inertia;  ///< principal moments, body axes, kg m²
  std::vector<DeviceShape> shapes;         ///< distinct, in the order of the first body with the shape
  std::vector<BodyRange> ranges;           ///< the bodies of each world
};

/// @param sweeps of the solver within each of Bullet's outer sweeps
DeviceBatch make_device_batch(const WorldBatch& batch, int sweeps);

}  // namespace holdfast::internal
