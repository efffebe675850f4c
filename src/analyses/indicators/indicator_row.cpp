#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>

#include "analyses/analysis.hpp"
#include "analyses/indicators/indicators.hpp"
#include "io/export/csv_field.hpp"
#include "io/results/found_tables.hpp"
#include "io/results/summary.hpp"

namespace holdfast::internal {

namespace {

void indicator_json(nlohmann::ordered_json& json, const LayoutRecord& layout) {
  const auto& found = layout.found.value<LayoutIndicators>();
  const auto array = [](const Vec3& v) { return std::array{v.x(), v.y(), v.z()}; };
  json["indicators"] = {{"fill", found.fill},
                        {"centre_of_gravity_m", array(found.centre_of_gravity)},
                        {"centre_offset", array(found.centre_offset)},
                        {"badly_based", found.badly_based},
                        {"badly_braced", found.badly_braced}};
}

std::string world_fields(const LayoutIndicators& found) {
  return fmt::format(",{},{},{},{},{}", csv_number(found.fill), csv_vector(found.centre_of_gravity),
                     csv_vector(found.centre_offset), csv_number(found.badly_based), csv_number(found.badly_braced));
}

std::string box_fields(const LayoutIndicators& found, std::size_t box) {
  if (box >= found.base_support.size()) return ",,";
  return fmt::format(",{},{}", found.base_support[box], found.supported_sides[box]);
}

/// Those of the layout of each world; unknown where another part has the layout.
Result<CsvFields> indicator_fields(ResultsReader& results, const SummarySlice& slice) {
  const ResultsInfo& info = results.info();
  CsvFields fields;
  LayoutIndicators found;
  std::optional<std::uint64_t> found_of;  // consecutive worlds have one layout
  for (const WorldRow& row : slice.rows) {
    const std::uint64_t layout = row.layout - info.layout_begin;
    const bool known = row.layout >= info.layout_begin && layout < info.layouts.size();
    if (!known) found = {};
    if (known && found_of != row.layout) {
      Result<std::vector<LayoutIndicators>> read = read_layouts<LayoutIndicators>(results, layout, 1, Depth::boxes);
      if (!read) return read.errors();
      found = std::move(read->front());
    }
    found_of = row.layout;
    fields.worlds.push_back(world_fields(found));
    for (std::size_t box = 0; box < row.boxes; ++box) fields.boxes.push_back(box_fields(found, box));
  }
  return fields;
}

}  // namespace

const Analysis kIndicators = {
    .key = "Indicators",
    .option = "Also tell base support, supported sides, centre of gravity and fill of the layouts",
    .enabled = [](const Settings& settings) { return settings.screening.indicators; },
    .method = {.of_layout =
                   [](const AnalysisInputs& inputs, LayoutRecord& layout) {
                     layout.found.put(find_indicators(*layout.layout, inputs.settings));
                     return true;
                   }},
    .tables = tables_of_layouts<LayoutIndicators>(
        {.name = "indicators",
         .asked_by = "`Indicators`",
         .page = "indicators.md",
         .file_order = -2,
         .world_headings = ",fill,centre_x_m,centre_y_m,centre_z_m,centre_offset_x,centre_offset_y,centre_offset_z,"
                           "badly_based,badly_braced",
         .box_headings = ",base_support,supported_sides",
         .csv_fields = indicator_fields}),
    .table = indicator_table,
    .layout_json = indicator_json};

}  // namespace holdfast::internal
