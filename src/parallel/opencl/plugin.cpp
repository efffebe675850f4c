#include "core/engine/engine_plugin.hpp"
#include "parallel/opencl/opencl_device.hpp"
#include "parallel/opencl/opencl_engine.hpp"

using namespace holdfast::internal;

extern "C" __attribute__((visibility("default"))) void holdfast_make_engine(const std::string& name,
                                                                            const Settings& settings,
                                                                            Result<std::unique_ptr<Engine>>& engine) {
  engine = OpenClEngine::make(name, settings);
}

extern "C" __attribute__((visibility("default"))) void holdfast_list_devices(std::vector<std::string>& lines) {
  for (const OpenClDevice& device : opencl_devices()) lines.push_back(device_line(device));
}
