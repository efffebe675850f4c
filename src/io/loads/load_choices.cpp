#include "io/loads/load_choices.hpp"

#include <utility>
#include <vector>

#include "core/model/setting_table.hpp"
#include "io/loads/table_loads.hpp"

namespace holdfast::internal {

namespace {

std::optional<Error> set(Settings& settings, const char* section, const char* name,
                         const std::optional<std::string>& value) {
  const SettingKey& key = *find_setting(section, name);
  if (!value || key.set(settings, "", *value)) return std::nullopt;
  return Error{.what = std::string("a wrong value of [") + section + "] " + name,
               .value = *value,
               .accepted = std::string(key.accepted)};
}

}  // namespace

std::optional<Error> LoadChoices::apply_to(Settings& settings, const Config& config) const {
  if (auto wrong = set(settings, "Container", "Type", container)) return wrong;
  if (container) {
    settings.container.overrides_loads = true;
    // The command line comes before the configuration; sides that it gives come before those of the catalogue.
    apply_container_type(settings, [&](std::string_view section, std::string_view key) {
      const bool is_size = key == "Length" || key == "Width" || key == "Height";
      return !is_size && config.given.contains({std::string(section), std::string(key)});
    });
  }
  if (auto wrong = set(settings, "Loads", "Unit", unit)) return wrong;
  if (auto wrong = set(settings, "Loads", "Axes", axes)) return wrong;
  if (axes) settings.up_axis = UpAxis::z;
  if (auto wrong = set(settings, "Loads", "Format", format)) return wrong;
  if (auto wrong = set(settings, "Loads", "Columns", columns)) return wrong;
  const Result<TableChoices> choices = TableChoices::of(settings);
  return choices ? std::nullopt : std::optional(choices.error());
}

}  // namespace holdfast::internal
