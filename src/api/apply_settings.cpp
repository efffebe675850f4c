#include "api/apply_settings.hpp"

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "api/convert.hpp"
#include "core/model/setting_table.hpp"

namespace holdfast::internal {

namespace {

PlacedSetting placed(const holdfast::Setting& given) {
  if (auto found = place_setting(given.section, given.key)) return std::move(*found);
  throw exception_of({{.what = "unknown key",
                       .value = printable('[' + given.section + "] " + given.key),
                       .accepted = "docs/reference/config.md has a list"}});
}

}  // namespace

void apply_setting(Settings& settings, const holdfast::Setting& given) {
  const PlacedSetting setting = placed(given);
  if (!setting.key->set(settings, setting.of, given.value))
    throw exception_of({{.what = printable("not a value of [" + given.section + "] " + given.key),
                         .value = printable(given.value),
                         .accepted = "accepted are " + std::string(setting.key->accepted)}});
}

holdfast::Setting main_spelling(const holdfast::Setting& given) {
  Settings settings;
  apply_setting(settings, given);
  const PlacedSetting setting = placed(given);
  return {setting.section, setting.name, printable(setting.key->get(settings, setting.of))};
}

void apply_settings(Config& config, std::span<const holdfast::Setting> given) {
  Settings& settings = config.settings;
  for (const holdfast::Setting& one : given) {
    apply_setting(settings, one);
    const PlacedSetting setting = placed(one);
    config.given.insert({setting.section, setting.name});
  }
  const auto is_given = [&](std::string_view section, std::string_view key) {
    return config.given.contains({std::string(section), std::string(key)});
  };
  apply_container_type(settings, is_given);
  std::vector<Error> errors;
  for (SettingConflict& conflict : choose_friction_model(settings, is_given))
    errors.push_back(std::move(conflict.error));
  for (SettingConflict& conflict : check_settings(settings)) errors.push_back(std::move(conflict.error));
  if (!errors.empty()) throw exception_of(errors);
}

}  // namespace holdfast::internal
