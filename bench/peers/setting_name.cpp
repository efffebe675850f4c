#include "setting_name.hpp"

#include <regex>
#include <sstream>
#include <vector>

#include "api/engine_loader.hpp"
#include "core/engine/engine_registry.hpp"
#include "core/model/setting_table.hpp"
#include "peer_engine.hpp"
#include "peer_options.hpp"

namespace holdfast::peers {

namespace {

using internal::Engine;
using internal::Error;
using internal::Result;
using internal::Settings;

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

/// Sets `Key=Value` of the engine's section.
std::optional<Error> override_key(Settings& settings, const std::string& section, const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::string value = equals == std::string::npos ? "" : text.substr(equals + 1);
  const internal::SettingKey* key = internal::find_setting(section, text.substr(0, equals));
  if (key == nullptr) return Error{.what = "no key of [" + section + "]", .value = text};
  if (key->set(settings, {}, value)) return std::nullopt;
  return Error{.what = "no value of " + std::string(key->name), .value = value, .accepted = std::string(key->accepted)};
}

/// An engine of ours, or of a plug-in.
Result<std::unique_ptr<Engine>> own_engine(const std::string& name, Settings settings) {
  std::vector<std::string> parts = split(name, ':');
  std::string engine = parts.front();
  const bool native = engine.starts_with("native-") && internal::find_engine(engine) == nullptr;
  settings.screening.engine = native ? "native" : engine;
  if (native) {
    if (auto error = set_accuracy(settings, engine.substr(engine.find('-') + 1))) return *error;
  }
  for (std::size_t i = 1; i < parts.size(); ++i) {
    if (auto error = override_key(settings, engine.starts_with("native") ? "Native" : "Bullet", parts[i]))
      return *error;
  }
  return internal::make_engine(settings.screening.engine, settings);
}

std::unique_ptr<Engine> box3d_engine([[maybe_unused]] const std::string& name,
                                     [[maybe_unused]] const Settings& settings,
                                     [[maybe_unused]] const Box3dOptions& options) {
#ifdef HOLDFAST_BOX3D
  return std::make_unique<PeerEngine>(name, settings, options.steps_per_second,
                                      [=](const Scene& scene) { return make_box3d_world(scene, options); });
#else
  return nullptr;
#endif
}

std::unique_ptr<Engine> jolt_engine([[maybe_unused]] const std::string& name, [[maybe_unused]] const Settings& settings,
                                    [[maybe_unused]] const JoltOptions& options) {
#ifdef HOLDFAST_JOLT
  return std::make_unique<PeerEngine>(name, settings, options.steps_per_second,
                                      [=](const Scene& scene) { return make_jolt_world(scene, options); });
#else
  return nullptr;
#endif
}

}  // namespace

Result<std::unique_ptr<Engine>> engine_of(const std::string& name, const Settings& settings) {
  static const std::regex box3d_name("box3d-([1-9][0-9]{0,4})x([1-9][0-9]{0,2})(k?)(s?)");
  static const std::regex jolt_name("jolt-([1-9][0-9]{0,4})(?:x([1-9][0-9]{0,2})x([1-9][0-9]{0,2}))?(p?)(s?)");
  const bool of_peer = name.starts_with("box3d") || name.starts_with("jolt");
  if (!of_peer) return own_engine(name, settings);
  std::unique_ptr<Engine> engine;
  if (std::smatch match; std::regex_match(name, match, box3d_name)) {
    engine = box3d_engine(name, settings,
                          {.steps_per_second = std::stod(match[1]),
                           .substeps = std::stoi(match[2]),
                           .stiff = match[3].length() > 0,
                           .sleeping = match[4].length() > 0});
  } else if (std::regex_match(name, match, jolt_name)) {
    JoltOptions options{
        .steps_per_second = std::stod(match[1]), .precise = match[4].length() > 0, .sleeping = match[5].length() > 0};
    if (match[2].matched) {
      options.velocity_iterations = std::stoi(match[2]);
      options.position_iterations = std::stoi(match[3]);
    }
    engine = jolt_engine(name, settings, options);
  } else {
    return Error{.what = "unknown setting of a peer", .value = name, .accepted = "box3d-60x4ks or jolt-60x20x4ps"};
  }
  if (engine == nullptr) return Error{.what = "this build was made without the sources of that peer", .value = name};
  return engine;
}

}  // namespace holdfast::peers
