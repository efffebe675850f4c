#include "api/engine_loader.hpp"

#include <dlfcn.h>

#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

#include "analyses/analysis.hpp"
#include "api/plugin_file.hpp"
#include "core/engine/engine_plugin.hpp"

namespace holdfast::internal {

namespace {

/// Builds the plug-ins of all engines, where the sources are; their other builds leave them out.
constexpr const char* kBuildPlugins =
    "`cmake --build build/release --target holdfast_plugins` in the sources builds it";

void* open_plugin(std::string_view file) {
  // RTLD_LOCAL: Bullet's float and double libraries have the same symbol names.
  return dlopen(plugin_file(std::string(file)).c_str(), RTLD_NOW | RTLD_LOCAL);
}

Result<MakeEngine*> load_plugin(std::string_view file) {
  void* library = open_plugin(file);
  if (library == nullptr) {
    std::string why = dlerror();
    const std::filesystem::path path = plugin_file(std::string(file));
    std::error_code unknown;
    if (!std::filesystem::exists(path, unknown))
      return Error{.what = "the engine's plug-in is not there", .value = path.string(), .accepted = kBuildPlugins};
    return Error{.what = "the engine's plug-in cannot be loaded", .value = std::move(why)};
  }
  auto* entry = reinterpret_cast<MakeEngine*>(dlsym(library, kEnginePluginEntry));
  if (entry == nullptr) return Error{.what = "not an engine plug-in", .value = std::string(file)};
  return entry;
}

/// What lists the devices of an engine's plug-in; none where it runs on the processor as it is, or is not there.
ListEngineDevices* devices_entry(const EngineEntry& entry) {
  void* library = entry.plugin.empty() ? nullptr : open_plugin(entry.plugin);
  if (library == nullptr) return nullptr;
  return reinterpret_cast<ListEngineDevices*>(dlsym(library, kEngineDevicesEntry));
}

Result<std::unique_ptr<Engine>> make_from_plugin(const EngineEntry& entry, const Settings& settings) {
  const Result<MakeEngine*> plugin = load_plugin(entry.plugin);
  if (!plugin) return plugin.errors();
  Result<std::unique_ptr<Engine>> engine =
      Error{.what = "the plug-in made no engine", .value = std::string(entry.plugin)};
  (*plugin)(std::string(entry.name), settings, engine);
  return engine;
}

}  // namespace

Result<std::unique_ptr<Engine>> make_engine(const std::string& name, const Settings& settings) {
  const EngineEntry* entry = find_engine(name);
  if (entry == nullptr) return unknown_engine(name);
  Result<std::unique_ptr<Engine>> engine =
      entry->make != nullptr ? entry->make(settings) : make_from_plugin(*entry, settings);
  if (!engine) return engine;
  if (const auto error = why_not_asked(**engine, settings)) return *error;
  return engine;
}

std::optional<Error> why_not_loadable(const EngineEntry& entry) {
  if (entry.plugin.empty()) return std::nullopt;
  const Result<MakeEngine*> plugin = load_plugin(entry.plugin);
  return plugin ? std::nullopt : std::optional(plugin.error());
}

bool runs_on_devices(const EngineEntry& entry) { return devices_entry(entry) != nullptr; }

std::vector<std::string> engine_devices(const EngineEntry& entry) {
  std::vector<std::string> lines;
  if (ListEngineDevices* list = devices_entry(entry)) list(lines);
  return lines;
}

}  // namespace holdfast::internal
