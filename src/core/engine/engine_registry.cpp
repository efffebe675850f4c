#include "core/engine/engine_registry.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "core/base/closest_word.hpp"
#include "core/model/setting_table.hpp"
#include "core/native/native_engine.hpp"
#include "core/reference/plain_engine.hpp"

namespace holdfast::internal {

namespace {

template <class OwnEngine, std::vector<Error> (*unsupported)(const Settings&)>
Result<std::unique_ptr<Engine>> make_own(const Settings& settings) {
  std::vector<Error> errors = unsupported(settings);
  if (!errors.empty()) return errors;
  return std::unique_ptr<Engine>(std::make_unique<OwnEngine>(settings));
}

constexpr std::array kEngines = {
    EngineEntry{
        .name = "native",
        .sentence =
            "hard contacts solved to a tolerance, and no work where nothing changes: screening, standard, reference",
        .accuracy_keys = "Native",
        .make = make_own<NativeEngine, unsupported_by_native>},
    EngineEntry{
        .name = "bullet",
        .sentence =
            "Bullet in float, best practical setting: 240 1/s, 50 iterations, 2 friction directions, random order",
        .plugin = "libholdfast-bullet.so"},
    EngineEntry{
        .name = "bullet-f64", .sentence = "the same in double precision", .plugin = "libholdfast-bullet-f64.so"},
    EngineEntry{.name = "bullet-stock",
                .sentence = "Bullet in float as shipped, for comparison: 240 1/s, 10 iterations, 1 friction direction",
                .plugin = "libholdfast-bullet.so"},
    EngineEntry{.name = "bullet-opencl",
                .sentence = "Bullet's OpenCL pipeline with changed kernels: batches of worlds on a CPU or GPU device",
                .plugin = "libholdfast-bullet-opencl.so"},
    EngineEntry{.name = "native-plain",
                .sentence =
                    "rigid boxes with hard contacts, solved to the end by plain means: slow, what other engines "
                    "are compared with",
                .make = make_own<PlainEngine, unsupported_by_plain>},
};

}  // namespace

std::span<const EngineEntry> engine_registry() { return kEngines; }

const EngineEntry* find_engine(std::string_view name) {
  const auto* const found =
      std::find_if(kEngines.begin(), kEngines.end(), [&](const EngineEntry& entry) { return entry.name == name; });
  return found == kEngines.end() ? nullptr : found;
}

Error unknown_engine(std::string_view name) {
  std::vector<std::string_view> names;
  std::string all;
  for (const EngineEntry& entry : kEngines) {
    names.push_back(entry.name);
    all += (all.empty() ? "" : ", ") + std::string(entry.name);
  }
  const auto meant = closest_word(name, names);
  return {.what = "unknown engine",
          .value = std::string(name),
          .accepted = meant ? "did you mean '" + std::string(*meant) + "'?" : "accepted are " + all};
}

std::string accuracy_of(const Settings& settings) {
  const EngineEntry* entry = find_engine(settings.screening.engine);
  if (entry == nullptr || entry->accuracy_keys.empty()) return "";
  return find_setting(entry->accuracy_keys, "Accuracy")->get(settings, "");
}

std::optional<Error> set_accuracy(Settings& settings, const std::string& accuracy) {
  const EngineEntry* entry = find_engine(settings.screening.engine);
  if (entry == nullptr || entry->accuracy_keys.empty()) {
    std::string able;
    for (const EngineEntry& other : kEngines)
      if (!other.accuracy_keys.empty()) able += (able.empty() ? "" : " or ") + std::string(other.name);
    return Error{.what = "an accuracy is for the engine " + able + ", and the engine is",
                 .value = settings.screening.engine,
                 .accepted = "leave out --accuracy, or take --engine " + able};
  }
  const SettingKey& key = *find_setting(entry->accuracy_keys, "Accuracy");
  if (key.set(settings, "", accuracy)) return std::nullopt;
  return Error{.what = "unknown accuracy", .value = accuracy, .accepted = "accepted are " + std::string(key.accepted)};
}

}  // namespace holdfast::internal
