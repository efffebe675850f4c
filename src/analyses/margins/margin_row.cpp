#include "analyses/margins/margins.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "analyses/analysis.hpp"
#include "analyses/margins/margin_search.hpp"
#include "analyses/margins/margin_spread.hpp"
#include "io/export/csv_field.hpp"
#include "io/results/found_tables.hpp"

namespace holdfast::internal {

namespace {

std::optional<Error> why_no_margins(const Engine& engine, const Settings& /*settings*/) {
  if (engine.traits().rewinds) return std::nullopt;
  return Error{.what = "this engine cannot find margins, since its worlds cannot go back in time",
               .value = engine.traits().name,
               .accepted = "leave margins out, or take the engine native"};
}

/// Puts what `find` finds of a layout that can be used, and how long it takes.
template <class Found>
bool find(std::optional<Found> (*find)(const Engine&, const Layout&, const Settings&, const std::atomic<bool>&),
          const AnalysisInputs& inputs, LayoutRecord& layout) {
  if (layout.layout->boxes.empty()) return true;
  const double begin = inputs.processor_seconds();
  std::optional<Found> found = find(inputs.engine, *layout.layout, inputs.settings, inputs.abort);
  if (!found) return false;
  found->cpu_seconds = inputs.processor_seconds() - begin;
  layout.found.put(std::move(*found));
  return true;
}

void margins_json(nlohmann::ordered_json& json, const LayoutRecord& layout) {
  const auto& margins = layout.found.value<LayoutMargins>();
  for (std::size_t i = 0; i < kDirectionCount; ++i) {
    const std::string direction(kMarginDirections.at(i).name);
    json["margins_g"][direction] = margins.margin.at(i);
    json["critical_boxes"][direction] = margins.critical_box.at(i);
    json["margins_within_limits_g"][direction] = margins.margin_within_limits.at(i);
    json["critical_boxes_within_limits"][direction] = margins.critical_box_within_limits.at(i);
  }
  json["cpu_seconds"] = margins.cpu_seconds;
}

void spread_json(nlohmann::ordered_json& json, const LayoutRecord& layout) {
  const auto& spread = layout.found.value<MarginSpread>();
  for (std::size_t i = 0; i < kDirectionCount; ++i)
    json["margins_5_50_95_g"][std::string(kMarginDirections.at(i).name)] = {spread.low.at(i), spread.median.at(i),
                                                                            spread.high.at(i)};
  json["cpu_seconds"] = json["cpu_seconds"].get<double>() + spread.cpu_seconds;
}

/// One line per layout and direction, with the spread where the file has it.
std::optional<Error> write_margin_csv(ResultsReader& results, const std::function<void(std::string_view)>& write) {
  const ResultsInfo& info = results.info();
  const bool has_spread = info.has(kMarginSpread.tables);
  const Result<std::vector<LayoutMargins>> margins = read_layouts<LayoutMargins>(results, 0, info.layouts.size());
  if (!margins) return margins.error();
  Result<std::vector<MarginSpread>> spreads = std::vector<MarginSpread>(info.layouts.size());
  if (has_spread) spreads = read_layouts<MarginSpread>(results, 0, info.layouts.size());
  if (!spreads) return spreads.error();
  write(fmt::format("layout,direction,margin_g,critical_box,margin_within_limits_g,critical_box_within_limits{}\r\n",
                    has_spread ? ",low_g,median_g,high_g" : ""));
  for (std::size_t i = 0; i < margins->size(); ++i)
    for (std::size_t direction = 0; direction < kDirectionCount; ++direction) {
      const LayoutMargins& layout = (*margins)[i];
      std::string line = fmt::format(
          "{},{},{},{},{},{}", csv_field(info.layouts[i]), kMarginDirections.at(direction).name,
          csv_number(layout.margin.at(direction)), layout.critical_box.at(direction),
          csv_number(layout.margin_within_limits.at(direction)), layout.critical_box_within_limits.at(direction));
      if (has_spread)
        for (const auto* quantile : {&(*spreads)[i].low, &(*spreads)[i].median, &(*spreads)[i].high})
          line += "," + csv_number(quantile->at(direction));
      write(line + "\r\n");
    }
  return std::nullopt;
}

}  // namespace

const Analysis kMargins = {
    .key = "Margins",
    .option = "Also find how many g each layout stands, in four directions",
    .enabled = [](const Settings& settings) { return settings.screening.margins; },
    .why_not = why_no_margins,
    .method = {.of_layout = [](const AnalysisInputs& inputs,
                               LayoutRecord& layout) { return find(find_margins, inputs, layout); }},
    .tables = tables_of_layouts<LayoutMargins>(
        {.name = "margins", .asked_by = "`Margins`", .page = "margins.md", .file_order = -4, .csv = write_margin_csv}),
    .table = margin_table,
    .layout_json = margins_json};

const Analysis kMarginSpread = {
    .enabled = [](const Settings& settings) { return settings.screening.margins && settings.screening.replicas > 0; },
    .method = {.of_layout = [](const AnalysisInputs& inputs,
                               LayoutRecord& layout) { return find(find_margin_spread, inputs, layout); }},
    .tables = tables_of_layouts<MarginSpread>(
        {.name = "margin_spread", .asked_by = "both `Margins` and `Replicas`", .page = "margins.md", .file_order = -3}),
    .layout_json = spread_json};

}  // namespace holdfast::internal
