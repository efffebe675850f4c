#pragma once

#include <vector>

#include "core/model/settings.hpp"
#include "core/model/world.hpp"
#include "parallel/opencl/body_columns.hpp"
#include "parallel/opencl/bullet3_pipeline.hpp"

namespace holdfast::internal {

/// A batch of worlds as columns of bodies: of each world its boxes in order, then the sides of the container.
struct DeviceBatch {
  std::vector<DeviceBody> bodies;
  std::vector<DeviceInertia> inertias;
  std::vector<Float4Column> body_inertia;  ///< principal moments, body axes, kg m²
  std::vector<DeviceShape> shapes;         ///< each once, in the order of the first body of that shape
  std::vector<BodyRange> ranges;           ///< a world's bodies
};

/// @param sweeps of the solver inside each of Bullet's outer ones
DeviceBatch make_device_batch(const WorldBatch& batch, const Settings& settings, int sweeps);

}  // namespace holdfast::internal
