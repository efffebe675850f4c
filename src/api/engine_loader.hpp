#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "core/engine/engine_registry.hpp"
#include "core/model/settings.hpp"

namespace holdfast::internal {

/// Makes an engine; loads its plug-in if it has one, which stays loaded. An error names a setting that the
/// engine cannot model, a plug-in that cannot be loaded and why, or a name that no engine has.
Result<std::unique_ptr<Engine>> make_engine(const std::string& name, const Settings& settings);

/// What keeps an engine's plug-in from being loaded, if anything. Asks for no device, which can take seconds.
std::optional<Error> why_not_loadable(const EngineEntry& entry);

/// Whether the engine runs on devices.
bool runs_on_devices(const EngineEntry& entry);

/// One line per device that the engine's plug-in finds on this machine; none where it runs on the processor as it is.
std::vector<std::string> engine_devices(const EngineEntry& entry);

}  // namespace holdfast::internal
