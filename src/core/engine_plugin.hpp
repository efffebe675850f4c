#pragma once

#include <memory>
#include <string>

#include "core/engine.hpp"
#include "core/result.hpp"
#include "core/settings.hpp"

namespace holdfast {

/// What a plug-in exports under the name `kEnginePluginEntry`: makes the engine of that name, or says what it
/// cannot model of the settings, in `engine`. Built with the program, by the same compiler; not a stable interface.
using MakeEngine = void(const std::string& name, const Settings& settings, Result<std::unique_ptr<Engine>>& engine);
inline constexpr const char* kEnginePluginEntry = "holdfast_make_engine";

}  // namespace holdfast
