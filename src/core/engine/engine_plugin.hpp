#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "core/engine/engine.hpp"
#include "core/model/settings.hpp"

namespace holdfast::internal {

/// What a plug-in exports under the name `kEnginePluginEntry`: makes the engine of that name, or says what it
/// cannot model of the settings, in `engine`. Built with the program, by the same compiler; not a stable interface.
using MakeEngine = void(const std::string& name, const Settings& settings, Result<std::unique_ptr<Engine>>& engine);
inline constexpr const char* kEnginePluginEntry = "holdfast_make_engine";

/// What the plug-in of an engine that runs on devices exports besides, under the name `kEngineDevicesEntry`: a line a
/// device of this machine, with the reason where one cannot be used.
using ListEngineDevices = void(std::vector<std::string>& lines);
inline constexpr const char* kEngineDevicesEntry = "holdfast_list_devices";

}  // namespace holdfast::internal
