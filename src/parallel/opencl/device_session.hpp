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

/// What a world does in one step.
struct WorldStep {
  Float4Column field_and_step = {};  ///< what every box feels, m/s²; length of the step, s, 0: the world stands still
};

/// A device with everything that runs on it: Bullet's pipeline, our own kernels, their buffers.
class DeviceSession {
 public:
  /// @param body_capacity most bodies that are uploaded together, and most shapes
  static Result<std::unique_ptr<DeviceSession>> open(const OpenClDevice& device, std::size_t body_capacity);

  const OpenClDevice& device() const { return device_; }
  Bullet3Pipeline& pipeline() { return *pipeline_; }

  /// Writes bodies to the device, in place of those that are there.
  /// @param world_count more than the number of any body's world
  /// @param body_inertia principal moments of each body, kg m²; the fourth number is not used
  void upload(std::span<const DeviceBody> bodies, std::span<const DeviceInertia> inertias,
              std::span<const Float4Column> body_inertia, std::size_t world_count);

  /// Takes the worlds whose bodies are on the device one step of their own.
  /// @param worlds of the bodies, by number
  /// @param ranges a world's bodies among those on the device; those that stand still are not stepping
  void step(std::span<const WorldStep> worlds, std::span<const BodyRange> ranges);

  /// Reads all bodies that are on the device.
  void read(std::span<DeviceBody> bodies);

  /// What went wrong since the last call; empty when all is well.
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

/// How many bodies may be on the device at the same time: as many as have full room, fewer where its memory is short.
std::size_t bodies_at_once(const OpenClDevice& device);

/// The one session of the process: Bullet's pipeline keeps global state, takes seconds to build, and never gives all of
/// its memory back. It is built once, for a device and a number of bodies, and built anew only when these do not
/// suffice.
class SessionLease {
 public:
  /// Builds the session if there is none for the device: what can fail fails here.
  static Result<OpenClDevice> prepare(const std::string& wanted_device);

  /// Waits until nobody else uses the session, and has it until the end of its life.
  /// @param body_count most bodies that are uploaded together, and most shapes
  SessionLease(const std::string& wanted_device, std::size_t body_count);
  ~SessionLease();
  SessionLease(const SessionLease&) = delete;
  SessionLease& operator=(const SessionLease&) = delete;

  /// Null when the device has no room for the batch; then `error` says so.
  DeviceSession* session() const { return session_; }
  const std::string& error() const { return error_; }

 private:
  DeviceSession* session_ = nullptr;
  std::string error_;
};

}  // namespace holdfast::internal
