#pragma once

#include <CL/cl.h>

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "core/vector.hpp"
#include "parallel/opencl/body_columns.hpp"

namespace holdfast {

/// A range of bodies that can touch each other and no other body.
struct BodyRange {
  std::size_t begin = 0;
  std::size_t end = 0;
  bool stepping = false;  ///< false: no contacts are looked for
};

/// Bullet's rigid-body pipeline on one OpenCL device, patched. All worlds stand in the same place, in their own range
/// of bodies: pairs of two worlds are never looked for. The library keeps global state: one at a time in a process.
class Bullet3Pipeline {
 public:
  /// Builds all of the pipeline's kernels. An error names what failed: the library, the build, or patches that do not
  /// fit because the library is of another version.
  /// @param body_capacity most bodies of a batch
  static Result<std::unique_ptr<Bullet3Pipeline>> create(cl_context context, cl_device_id device,
                                                         cl_command_queue queue, std::size_t body_capacity);
  virtual ~Bullet3Pipeline() = default;

  /// Forgets all shapes and bodies.
  virtual void clear() = 0;

  /// Adds a box as a convex hull. @param centre of the box in the body's frame, m
  /// @return its index for `DeviceBody::shape`
  virtual int add_shape(const Vec3& half_extents, const Vec3& centre) = 0;

  /// Writes all bodies to the device. No more than the capacity.
  virtual void upload(std::span<const DeviceBody> bodies, std::span<const DeviceInertia> inertias) = 0;

  /// Finds contacts and changes velocities so that they hold; moves nothing.
  /// @param ranges of all bodies, in order
  virtual void solve(std::span<const BodyRange> ranges) = 0;

  /// What the pipeline has reported as wrong since the last call, or has lost; empty when all is well.
  virtual std::string take_error() = 0;

  virtual cl_mem bodies() const = 0;
  virtual cl_mem inertias() const = 0;
  virtual std::size_t body_capacity() const = 0;
};

}  // namespace holdfast
