#include "parallel/opencl/opencl_device.hpp"

#include <algorithm>

namespace holdfast::internal {

namespace {

constexpr std::size_t kWorkGroup = 64;                  // of Bullet's solver
constexpr std::uint64_t kLeastLocalMemory = 16 * 1024;  // bytes; of Bullet's sort

template <class Query, class Object>
std::string text_of(Query query, Object object, cl_uint what) {
  std::size_t size = 0;
  if (query(object, what, 0, nullptr, &size) != CL_SUCCESS || size == 0) return {};
  std::string text(size, '\0');
  query(object, what, size, text.data(), nullptr);
  text.resize(text.find('\0') == std::string::npos ? size : text.find('\0'));
  return text;
}

template <class Number>
Number number_of(cl_device_id device, cl_device_info what) {
  Number number = {};
  clGetDeviceInfo(device, what, sizeof(number), &number, nullptr);
  return number;
}

std::string why_unusable(cl_device_id device) {
  if (number_of<cl_bool>(device, CL_DEVICE_AVAILABLE) == CL_FALSE) return "the driver reports that it is not available";
  if (number_of<cl_bool>(device, CL_DEVICE_COMPILER_AVAILABLE) == CL_FALSE) return "its driver has no compiler";
  if (number_of<cl_bool>(device, CL_DEVICE_ENDIAN_LITTLE) == CL_FALSE) return "its byte order is not the host's";
  if (number_of<std::size_t>(device, CL_DEVICE_MAX_WORK_GROUP_SIZE) < kWorkGroup)
    return "its work groups have fewer than 64 items";
  if (number_of<cl_ulong>(device, CL_DEVICE_LOCAL_MEM_SIZE) < kLeastLocalMemory) return "too little local memory";
  return {};
}

OpenClDevice describe(cl_platform_id platform, cl_device_id id) {
  OpenClDevice device;
  device.id = id;
  device.name = text_of(clGetDeviceInfo, id, CL_DEVICE_NAME);
  device.platform = text_of(clGetPlatformInfo, platform, CL_PLATFORM_NAME);
  device.version = text_of(clGetDeviceInfo, id, CL_DRIVER_VERSION);
  const auto type = number_of<cl_device_type>(id, CL_DEVICE_TYPE);
  device.is_gpu = (type & CL_DEVICE_TYPE_GPU) != 0;
  device.is_cpu = (type & CL_DEVICE_TYPE_CPU) != 0;
  device.compute_units = number_of<cl_uint>(id, CL_DEVICE_MAX_COMPUTE_UNITS);
  device.memory = number_of<cl_ulong>(id, CL_DEVICE_GLOBAL_MEM_SIZE);
  device.largest_allocation = number_of<cl_ulong>(id, CL_DEVICE_MAX_MEM_ALLOC_SIZE);
  device.unusable = why_unusable(id);
  return device;
}

}  // namespace

std::vector<OpenClDevice> opencl_devices() {
  std::vector<OpenClDevice> devices;
  cl_uint platform_count = 0;
  if (clGetPlatformIDs(0, nullptr, &platform_count) != CL_SUCCESS) return devices;
  std::vector<cl_platform_id> platforms(platform_count);
  clGetPlatformIDs(platform_count, platforms.data(), nullptr);
  for (cl_platform_id platform : platforms) {
    cl_uint device_count = 0;
    if (clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, 0, nullptr, &device_count) != CL_SUCCESS) continue;
    std::vector<cl_device_id> ids(device_count);
    clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, device_count, ids.data(), nullptr);
    for (cl_device_id id : ids) devices.push_back(describe(platform, id));
  }
  return devices;
}

std::string device_line(const OpenClDevice& device) {
  std::string line = device.is_gpu ? "GPU " : device.is_cpu ? "CPU " : "accelerator ";
  line += device.name + " (" + device.platform + ", driver " + device.version + "): ";
  if (!device.unusable.empty()) return line + "cannot be used: " + device.unusable;
  line += std::to_string(device.compute_units) + " compute units, " + std::to_string(device.memory >> 20U) + " MiB";
  return device.is_cpu ? line : line + "; untested: only CPU devices have been measured";
}

Result<OpenClDevice> choose_device(const std::vector<OpenClDevice>& devices, const std::string& wanted) {
  if (devices.empty()) {
    return Error{.what = "no OpenCL device",
                 .accepted = "install a driver, such as Debian's pocl-opencl-icd for the processor"};
  }
  std::string names;
  for (const OpenClDevice& device : devices) names += (names.empty() ? "" : ", ") + device.name;
  std::vector<OpenClDevice> usable = devices;
  std::erase_if(usable, [&](const OpenClDevice& device) { return device.name.find(wanted) == std::string::npos; });
  if (usable.empty()) return Error{.what = "no OpenCL device of this name", .value = wanted, .accepted = names};
  const std::string reason = usable.front().unusable;
  std::erase_if(usable, [](const OpenClDevice& device) { return !device.unusable.empty(); });
  if (usable.empty()) return Error{.what = "the OpenCL device cannot be used: " + reason, .value = names};
  const auto gpu = std::find_if(usable.begin(), usable.end(), [](const OpenClDevice& device) { return device.is_gpu; });
  return gpu == usable.end() ? usable.front() : *gpu;
}

}  // namespace holdfast::internal
