#include "app/stored_bearing.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "analyses/bearing/bearing.hpp"
#include "app/reading_guard.hpp"
#include "core/model/verdict.hpp"
#include "io/results/results_columns.hpp"
#include "io/results/stored_layout.hpp"

namespace holdfast::internal {

namespace {

/// Layouts with a world in which the load does not hold.
Result<std::vector<bool>> failing_layouts(ResultsReader& results) {
  const ResultsInfo& info = results.info();
  const auto layouts = results.stored("/worlds/layout", 0, info.world_count);
  if (!layouts) return layouts.errors();
  const auto verdicts = results.stored("/summary/worlds/verdict", 0, info.world_count);
  if (!verdicts) return verdicts.errors();
  const auto layout = values_of<std::uint64_t>(*layouts);
  const auto verdict = values_of<std::uint8_t>(*verdicts);
  std::vector<bool> fails(info.layouts.size(), false);
  for (std::size_t i = 0; i < std::min(layout.size(), verdict.size()); ++i) {
    const bool holds = verdict[i] == static_cast<std::uint8_t>(Verdict::stayed) ||
                       verdict[i] == static_cast<std::uint8_t>(Verdict::not_needed);
    if (!holds && layout[i] < fails.size()) fails[layout[i]] = true;
  }
  return fails;
}

bool has_limit(const Layout& layout) {
  return std::any_of(layout.boxes.begin(), layout.boxes.end(), [](const Box& box) { return box.bearing_limit; });
}

}  // namespace

Result<std::string> bearing_json(ResultsReader& results, std::size_t most) {
  const Result<std::vector<bool>> fails = failing_layouts(results);
  if (!fails) return fails.errors();
  auto shown = static_cast<std::size_t>(std::count(fails->begin(), fails->end(), true));
  std::vector<std::pair<std::size_t, Layout>> limited;
  for (std::size_t i = 0; i < fails->size(); ++i) {
    if (!(*fails)[i] && shown++ >= most) continue;
    Result<Layout> layout = stored_layout(results, i);
    if (!layout) return layout.errors();
    if (has_limit(*layout)) limited.emplace_back(i, std::move(*layout));
  }
  nlohmann::json json = nlohmann::json::object();
  if (limited.empty()) return json.dump();
  const Result<Settings> settings = stored_materials(results);
  if (!settings) return settings.errors();
  reading_has_ended();
  for (const auto& [i, layout] : limited) {
    nlohmann::json& boxes = json[std::to_string(i)] = nlohmann::json::array();
    for (const BearingRange& range : find_bearing(layout, *settings)) boxes.push_back({range.least, range.largest});
  }
  return json.dump();
}

}  // namespace holdfast::internal
