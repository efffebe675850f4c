#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "core/engine/engine.hpp"
#include "core/model/settings.hpp"

namespace holdfast::internal {

/// The function that a plug-in exports under the name `kEnginePluginEntry`. It sets `engine` to the engine of that
/// name, or to the errors that say which settings the engine cannot model. Plug-ins are built with the program, by the
/// same compiler; the interface is not stable.
using MakeEngine = void(const std::string& name, const Settings& settings, Result<std::unique_ptr<Engine>>& engine);
inline constexpr const char* kEnginePluginEntry = "holdfast_make_engine";

/// The function that the plug-in of an engine for devices also exports, under the name `kEngineDevicesEntry`: it lists
/// the devices of this machine, one per line, with the reason where a device cannot be used.
using ListEngineDevices = void(std::vector<std::string>& lines);
inline constexpr const char* kEngineDevicesEntry = "holdfast_list_devices";

}  // namespace holdfast::internal
