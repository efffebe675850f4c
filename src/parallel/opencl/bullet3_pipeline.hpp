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

/// A range of bodies that can touch each other, but no other bodies.
struct BodyRange {
  std::size_t begin = 0;
  std::size_t end = 0;
  bool stepping = false;  ///< false: no search for contacts
};

/// Number of worlds for which Bullet's contact solver has a cell. More worlds would share cells, and the order of a
/// world's contacts would depend on other worlds.
inline constexpr std::size_t kWorldsAtOnce = 256;

/// Number of bodies with the full capacity of 16 pairs and contacts per body; more bodies share this capacity.
inline constexpr std::size_t kBodiesAtOnce = 32 * 1024;

/// The box shape of a body.
struct DeviceShape {
  Vec3 half_extents = Vec3::Zero();  ///< m
  Vec3 centre = Vec3::Zero();        ///< of the box in the body's frame, m
};

/// Bullet's rigid-body pipeline on one OpenCL device, with patches. All worlds are at the same place, each with its own
/// range of bodies: pairs of bodies of different worlds are never searched for. The library has global state: a process
/// can have one pipeline at a time.
class Bullet3Pipeline {
 public:
  /// Builds all of the pipeline's kernels. An error names what failed: the library, the build, or patches that do not
  /// fit because the library is of another version.
  /// @param body_capacity largest number of bodies that are uploaded together, and of shapes
  static Result<std::unique_ptr<Bullet3Pipeline>> create(cl_context context, cl_device_id device,
                                                         cl_command_queue queue, std::size_t body_capacity);
  virtual ~Bullet3Pipeline() = default;

  /// Removes all shapes and bodies, and registers these shapes as convex hulls; `DeviceBody::shape` is an index into
  /// them.
  virtual void set_shapes(std::span<const DeviceShape> shapes) = 0;

  /// Writes bodies to the device, replacing all others; at most as many as the capacity.
  virtual void upload(std::span<const DeviceBody> bodies, std::span<const DeviceInertia> inertias) = 0;

  /// Finds contacts and changes velocities so that they satisfy the contact laws; changes no positions.
  /// @param ranges of all bodies, in order
  virtual void solve(std::span<const BodyRange> ranges) = 0;

  /// Errors that the pipeline has reported since the last call, or data that it has lost; empty if there are none.
  virtual std::string take_error() = 0;

  virtual cl_mem bodies() const = 0;
  virtual cl_mem inertias() const = 0;
  virtual std::size_t body_capacity() const = 0;
};

}  // namespace holdfast::internal
