#include "api/engine_loader.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "api/plugin_file.hpp"
#include "core/base/closest_word.hpp"
#include "core/engine/engine_plugin.hpp"
#include "core/native/native_engine.hpp"
#include "core/reference/plain_engine.hpp"

namespace holdfast {

namespace {

void* open_plugin(const std::string& file) {
  // RTLD_LOCAL: Bullet's float and double libraries have the same symbol names.
  return dlopen(plugin_file(file).c_str(), RTLD_NOW | RTLD_LOCAL);
}

Result<MakeEngine*> load_plugin(const std::string& file) {
  void* library = open_plugin(file);
  if (library == nullptr) return Error{.what = "the engine's plug-in cannot be loaded", .value = dlerror()};
  auto* entry = reinterpret_cast<MakeEngine*>(dlsym(library, kEnginePluginEntry));
  if (entry == nullptr) return Error{.what = "not an engine plug-in", .value = file};
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
  Result<std::unique_ptr<Engine>> engine = Error{.what = "the plug-in made no engine", .value = entry.plugin};
  (*plugin)(entry.name, settings, engine);
  return engine;
}

Result<std::unique_ptr<Engine>> make_native(const Settings& settings) {
  std::vector<Error> errors = unsupported_by_native(settings);
  if (!errors.empty()) return errors;
  return std::unique_ptr<Engine>(std::make_unique<NativeEngine>(settings));
}

Result<std::unique_ptr<Engine>> make_plain(const Settings& settings) {
  std::vector<Error> errors = unsupported_by_plain(settings);
  if (!errors.empty()) return errors;
  return std::unique_ptr<Engine>(std::make_unique<PlainEngine>(settings));
}

}  // namespace

const std::vector<EngineEntry>& engine_catalog() {
  static const std::vector<EngineEntry> kEngines = {
      {"native",
       "hard contacts solved to a tolerance, and no work where nothing changes: screening, standard, reference", "",
       make_native},
      {"bullet", "Bullet in float, best practical setting: 240 1/s, 50 iterations, 2 friction directions, random order",
       "libholdfast-bullet.so"},
      {"bullet-f64", "the same in double precision", "libholdfast-bullet-f64.so"},
      {"bullet-stock", "Bullet in float as shipped, for comparison: 240 1/s, 10 iterations, 1 friction direction",
       "libholdfast-bullet.so"},
      {"native-plain",
       "rigid boxes with hard contacts, solved to the end by plain means: slow, what other engines are compared with",
       "", make_plain},
      {"bullet-opencl", "Bullet's OpenCL pipeline with changed kernels: batches of worlds on a CPU or GPU device",
       "libholdfast-bullet-opencl.so"},
  };
  return kEngines;
}

Result<std::unique_ptr<Engine>> make_engine(const std::string& name, const Settings& settings) {
  const std::vector<EngineEntry>& catalog = engine_catalog();
  const auto entry = std::find_if(catalog.begin(), catalog.end(), [&](const auto& e) { return e.name == name; });
  if (entry == catalog.end()) {
    std::vector<std::string_view> names;
    for (const EngineEntry& known : catalog) names.push_back(known.name);
    const auto meant = closest_word(name, names);
    return Error{.what = "unknown engine",
                 .value = name,
                 .accepted = meant ? fmt::format("did you mean '{}'?", *meant)
                                   : fmt::format("accepted are {}", fmt::join(names, ", "))};
  }
  return entry->make != nullptr ? entry->make(settings) : make_from_plugin(*entry, settings);
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

}  // namespace holdfast
