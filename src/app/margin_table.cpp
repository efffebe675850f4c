#include "app/margin_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "core/engine/margin_search.hpp"
#include "io/input/text_lines.hpp"
#include "io/results/results_reader.hpp"

namespace holdfast::internal {

namespace {

constexpr std::size_t kLayoutsShown = 20;

/// The direction in which a layout stands least; the first of several.
std::size_t weakest(const LayoutMargins& margins) {
  const auto& all = margins.margin;
  return static_cast<std::size_t>(std::min_element(all.begin(), all.end()) - all.begin());
}

double least(const LayoutMargins& margins) { return margins.margin.at(weakest(margins)); }

std::string size_text(double margin) {
  return margin < kLargestMargin ? fmt::format("{:.2f}", margin) : fmt::format("{:.2f}+", margin);
}

std::string verdict_of(const LayoutMargins& margins) {
  const std::size_t direction = weakest(margins);
  const std::uint32_t box = margins.critical_box.at(direction);
  if (margins.margin.at(direction) < 0.0) return fmt::format("does not stand, box {}", box);
  if (box == 0) return "-";
  return fmt::format("{}, box {}", kMarginDirections.at(direction).name, box);
}

std::string line_of(std::string_view layout, std::size_t width, const LayoutMargins& margins) {
  std::string line = fmt::format("  {:<{}}", layout, width);
  for (const double margin : margins.margin) line += fmt::format("  {:>6}", size_text(margin));
  return line + "  " + verdict_of(margins) + "\n";
}

}  // namespace

Result<std::string> margin_table(const std::string& results_path) {
  Result<ResultsReader> results = ResultsReader::open(results_path);
  if (!results) return results.errors();
  const ResultsInfo& info = results->info();
  if (!info.has_margins) return std::string();
  const Result<std::vector<LayoutMargins>> margins = results->margins(0, info.layouts.size());
  if (!margins) return margins.errors();

  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < margins->size(); ++i)
    if (!std::isnan(least((*margins)[i]))) order.push_back(i);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return least((*margins)[a]) < least((*margins)[b]); });
  const std::size_t shown = std::min(order.size(), kLayoutsShown);

  std::size_t width = std::string_view("layout").size();
  for (std::size_t i = 0; i < shown; ++i) width = std::max(width, printable(info.layouts[order[i]]).size());
  std::string text = "\nmargins: the largest constant acceleration that a layout stands, in g\n";
  text += fmt::format("  {:<{}}", "layout", width);
  for (const MarginDirection& direction : kMarginDirections) text += fmt::format("  {:>6}", direction.name);
  text += "  weakest\n";
  for (std::size_t i = 0; i < shown; ++i)
    text += line_of(printable(info.layouts[order[i]]), width, (*margins)[order[i]]);
  if (order.size() > shown) text += fmt::format("  and {} more that stand better\n", order.size() - shown);
  return text;
}

}  // namespace holdfast::internal
