#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "parallel/opencl/body_columns.hpp"
#include "parallel/opencl/bullet3_pipeline.hpp"
#include "parallel/opencl/opencl_device.hpp"
#include "parallel/opencl/opencl_handle.hpp"

namespace holdfast::internal {

/// The parameters of a world in one step.
struct WorldStep {
  Float4Column field_and_step = {};  ///< effective gravity, m/s²; length of the step, s, 0: the world is not moved
};

/// A device with Bullet's pipeline, the kernels of this project, and their buffers.
class DeviceSession {
 public:
  /// @param body_capacity largest number of bodies that are uploaded together, and of shapes
  static Result<std::unique_ptr<DeviceSession>> open(const OpenClDevice& device, std::size_t body_capacity);

  const OpenClDevice& device() const { return device_; }
  Bullet3Pipeline& pipeline() { return *pipeline_; }

  /// Writes bodies to the device, replacing all others.
  /// @param world_count larger than the world index of every body
  /// @param body_inertia principal moments of each body, kg m²; the fourth number is not used
  void upload(std::span<const DeviceBody> bodies, std::span<const DeviceInertia> inertias,
              std::span<const Float4Column> body_inertia, std::size_t world_count);

  /// Advances each world whose bodies are on the device by its own step.
  /// @param worlds parameters of the worlds, by index
  /// @param ranges bodies of each world on the device; worlds that are not moved have `stepping` false
  void step(std::span<const WorldStep> worlds, std::span<const BodyRange> ranges);

  /// Reads all bodies that are on the device.
  void read(std::span<DeviceBody> bodies);

  /// Errors since the last call; empty if there are none.
  std::string take_error();

 private:
  DeviceSession() = default;
  void note(cl_int code, const char* what);
  void run(const ClKernel& kernel);
  ClBuffer buffer(std::size_t bytes);

  OpenClDevice device_;
  ClContext context_;
  ClQueue queue_;
  ClProgram program_;
  ClKernel begin_step_, end_step_;
  std::unique_ptr<Bullet3Pipeline> pipeline_;
  ClBuffer body_inertia_, kept_, worlds_;
  std::size_t body_room_ = 0, world_room_ = 0;
  std::size_t body_count_ = 0;
  std::vector<WorldStep> worlds_on_device_;
  std::string error_;
};

/// Largest number of bodies on the device at the same time: as many as have full capacity, fewer if its memory is
/// small.
std::size_t bodies_at_once(const OpenClDevice& device);

/// The only session of the process: Bullet's pipeline has global state, takes seconds to build, and leaks memory when
/// it is destroyed. It is built once, for a device and a number of bodies, and rebuilt only when these do not suffice.
class SessionLease {
 public:
  /// Builds the session if there is none for the device, and reports all errors of building.
  static Result<OpenClDevice> prepare(const std::string& wanted_device);

  /// Waits until the session is free, and owns it until destroyed.
  /// @param body_count largest number of bodies that are uploaded together, and of shapes
  SessionLease(const std::string& wanted_device, std::size_t body_count);
  ~SessionLease();
  SessionLease(const SessionLease&) = delete;
  SessionLease& operator=(const SessionLease&) = delete;

  /// Null if the device has too little memory for the batch; then `error` says so.
  DeviceSession* session() const { return session_; }
  const std::string& error() const { return error_; }

 private:
  DeviceSession* session_ = nullptr;
  std::string error_;
};

}  // namespace holdfast::internal
