#include "io/results/stored_layout.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/input/config_reader.hpp"
#include "io/results/results_columns.hpp"

namespace holdfast::internal {

namespace {

std::optional<double> known(double number) { return std::isnan(number) ? std::nullopt : std::optional(number); }

}  // namespace

Result<Layout> stored_layout(ResultsReader& results, std::uint64_t layout) {
  const Result<EntryRange> range = results.layout_boxes(layout, 1);
  if (!range) return range.errors();
  const std::uint64_t begin = range->begin;
  const std::size_t count = range->counts.front();
  std::vector<Error> errors;
  // The column, or nothing where the file has none.
  const auto column = [&](const char* path) -> std::vector<std::byte> {
    if (count == 0 || !results.has(path)) return {};
    Result<std::vector<std::byte>> stored = results.stored(path, begin, count);
    if (stored) return std::move(*stored);
    errors.insert(errors.end(), stored.errors().begin(), stored.errors().end());
    return {};
  };
  const auto texts = [&](const char* path) {
    const std::vector<std::byte> stored = column(path);
    return stored.empty() ? std::vector<std::string>() : texts_of(stored, stored.size() / count);
  };
  const auto low = values_of<Vec3>(column("/inputs/layouts/corner_min"));
  const auto high = values_of<Vec3>(column("/inputs/layouts/corner_max"));
  const auto material = values_of<std::int32_t>(column("/inputs/layouts/material"));
  const auto mass = values_of<double>(column("/inputs/layouts/mass"));
  const auto centre = values_of<Vec3>(column("/inputs/layouts/centre_of_mass"));
  const auto limit = values_of<double>(column("/inputs/layouts/bearing_limit"));
  const auto fixed = values_of<std::uint8_t>(column("/inputs/layouts/fixed"));
  const std::vector<std::string> name = texts("/inputs/layouts/box_name");
  const std::vector<std::string> material_name = texts("/inputs/layouts/material_name");
  if (!errors.empty()) return errors;
  Layout stored;
  stored.boxes.reserve(low.size());
  for (std::size_t i = 0; i < low.size(); ++i) {
    Box& box = stored.boxes.emplace_back();
    box.corner_min = low[i];
    box.corner_max = high[i];
    box.material = i < material_name.size() && !material_name[i].empty() ? MaterialName(material_name[i])
                                                                         : MaterialName(material[i]);
    if (i < name.size()) box.name = name[i];
    if (i < mass.size()) box.mass = known(mass[i]);
    if (i < centre.size() && centre[i].allFinite()) box.centre_of_mass = centre[i];
    if (i < limit.size()) box.bearing_limit = known(limit[i]);
    box.fixed = i < fixed.size() && fixed[i] != 0;
  }
  return stored;
}

Result<Settings> stored_materials(ResultsReader& results) {
  const Result<std::vector<std::pair<std::string, std::string>>> stored = results.settings();
  if (!stored) return stored.errors();
  TextFile text{.path = results.info().path, .name = "settings", .text = {}, .sha256 = {}};
  for (const auto& [key, value] : *stored) {
    const std::size_t stroke = std::min(key.rfind('/'), key.size());
    const std::string section = key.substr(0, stroke);
    const std::string name = key.substr(std::min(stroke + 1, key.size()));
    constexpr std::array<std::string_view, 4> kOfMaterials = {"Density", "Mass", "CentreOfMass", "Fixed"};
    const bool is_of_material = section.starts_with("Material ") &&
                                std::find(kOfMaterials.begin(), kOfMaterials.end(), name) != kOfMaterials.end();
    if (value.empty() || !(is_of_material || name == "DensityValue")) continue;
    text.text += '[' + section + "]\n" + name + " = " + value + '\n';
  }
  std::vector<Error> warnings;
  const Result<Config> config = parse_config(text, warnings);
  if (!config) return config.errors();
  return config->settings;
}

}  // namespace holdfast::internal
