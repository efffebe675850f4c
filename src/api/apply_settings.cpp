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

/// What a section of a material begins with.
constexpr std::string_view kMaterialPrefix = "Material ";

/// The key, and the id of the material for keys of a material; the key is null when there is no such key.
std::pair<const SettingKey*, int> find(const holdfast::Setting& given) {
  const std::string_view section = given.section;
  if (section.starts_with(kMaterialPrefix)) {
    const std::optional<int> id = material_id(section.substr(kMaterialPrefix.size()));
    return {id ? find_setting(kMaterialSection, given.key) : nullptr, id.value_or(0)};
  }
  return {find_setting(section, given.key), 0};
}

}  // namespace

void apply_setting(Settings& settings, const holdfast::Setting& given) {
  const std::string name = printable('[' + given.section + "] " + given.key);
  const auto [key, material] = find(given);
  if (key == nullptr)
    throw exception_of({{.what = "unknown key", .value = name, .accepted = "docs/config.md has a list"}});
  if (!key->set(settings, material, given.value))
    throw exception_of({{.what = "not a value of " + name,
                         .value = printable(given.value),
                         .accepted = "accepted are " + std::string(key->accepted)}});
}

holdfast::Setting main_spelling(const holdfast::Setting& given) {
  Settings settings;
  apply_setting(settings, given);
  const auto [key, material] = find(given);
  const bool of_material = key->section == kMaterialSection;
  return {of_material ? std::string(kMaterialPrefix) + std::to_string(material) : std::string(key->section),
          std::string(key->name), printable(key->get(settings, material))};
}

void apply_settings(Settings& settings, std::span<const holdfast::Setting> given) {
  for (const holdfast::Setting& setting : given) apply_setting(settings, setting);
  const auto is_given = [&](std::string_view section, std::string_view key) {
    return std::any_of(given.begin(), given.end(),
                       [&](const auto& one) { return one.section == section && one.key == key; });
  };
  std::vector<Error> errors;
  for (SettingConflict& conflict : choose_friction_model(settings, is_given))
    errors.push_back(std::move(conflict.error));
  for (SettingConflict& conflict : check_settings(settings)) errors.push_back(std::move(conflict.error));
  if (!errors.empty()) throw exception_of(errors);
}

}  // namespace holdfast::internal
