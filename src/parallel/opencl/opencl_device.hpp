#pragma once

#include <CL/cl.h>

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/result.hpp"

namespace holdfast::internal {

/// A device of an OpenCL driver of this machine.
struct OpenClDevice {
  cl_device_id id = nullptr;
  std::string name;
  std::string platform;
  std::string version;  ///< of the driver
  bool is_gpu = false;
  bool is_cpu = false;
  std::uint32_t compute_units = 0;
  std::uint64_t memory = 0;              ///< bytes
  std::uint64_t largest_allocation = 0;  ///< bytes
  std::string unusable;                  ///< why Bullet's pipeline cannot run on it; empty if it can
};

/// All devices of all drivers, in the order of the drivers.
std::vector<OpenClDevice> opencl_devices();

/// One line that describes a device, with the reason if it cannot be used.
std::string device_line(const OpenClDevice& device);

/// The device whose name contains `wanted`; if that is empty the first GPU, or else the first device.
Result<OpenClDevice> choose_device(const std::vector<OpenClDevice>& devices, const std::string& wanted);

}  // namespace holdfast::internal
