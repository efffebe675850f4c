#pragma once

#include <CL/cl.h>

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "core/base/vector.hpp"
#include "parallel/opencl/body_columns.hpp"

namespace holdfast::internal {

/// A range of bodies that can touch each other and no other body.
struct BodyRange {
  std::size_t begin = 0;
  std::size_t end = 0;
  bool stepping = false;  ///< false: no contacts are looked for
};

/// Worlds that Bullet's contact solver has a cell for. More would share cells, and the order of a world's contacts
/// would depend on its company.
inline constexpr std::size_t kWorldsAtOnce = 256;

/// Bodies that have full room for pairs and contacts, 16 a body; where more are uploaded, they share it.
inline constexpr std::size_t kBodiesAtOnce = 32 * 1024;

/// A box of which bodies are made.
struct DeviceShape {
  Vec3 half_extents = Vec3::Zero();  ///< m
  Vec3 centre = Vec3::Zero();        ///< of the box in the body's frame, m
};

/// Bullet's rigid-body pipeline on one OpenCL device, patched. All worlds stand in the same place, in their own range
/// of bodies: pairs of two worlds are never looked for. The library keeps global state: one at a time in a process.
class Bullet3Pipeline {
 public:
  /// Builds all of the pipeline's kernels. An error names what failed: the library, the build, or patches that do not
  /// fit because the library is of another version.
  /// @param body_capacity most bodies that are uploaded together, and most shapes
  static Result<std::unique_ptr<Bullet3Pipeline>> create(cl_context context, cl_device_id device,
                                                         cl_command_queue queue, std::size_t body_capacity);
  virtual ~Bullet3Pipeline() = default;

  /// Forgets all shapes and bodies, and takes these shapes as convex hulls; `DeviceBody::shape` is an index into them.
  virtual void set_shapes(std::span<const DeviceShape> shapes) = 0;

  /// Writes bodies to the device, in place of those that are there. No more than the capacity.
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

}  // namespace holdfast::internal
