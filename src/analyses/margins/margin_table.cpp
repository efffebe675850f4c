#include "analyses/analysis.hpp"
#include "analyses/margins/margins.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "analyses/layouts_shown.hpp"
#include "analyses/margins/margin_search.hpp"
#include "core/base/number_text.hpp"
#include "core/model/norms.hpp"
#include "io/input/text_lines.hpp"
#include "io/results/found_tables.hpp"

namespace holdfast::internal {

namespace {

/// The margins of a layout beside what a norm needs, g; nothing is needed where that is 0.
struct Judged {
  const LayoutMargins& margins;
  const MarginSpread& spread;
  const std::array<double, kDirectionCount>& needed;

  /// What share of what is needed the layout stands in a direction; without a norm, its margin.
  double share(std::size_t direction) const {
    const bool any = std::any_of(needed.begin(), needed.end(), [](double need) { return need > 0.0; });
    const double need = any ? needed.at(direction) : 1.0;
    return need > 0.0 ? margins.margin.at(direction) / need : std::numeric_limits<double>::infinity();
  }

  /// The direction of the least share; the first of several.
  std::size_t weakest() const {
    std::size_t least = 0;
    for (std::size_t i = 1; i < kDirectionCount; ++i)
      if (share(i) < share(least)) least = i;
    return least;
  }

  double least() const { return share(weakest()); }
};

std::string size_text(double margin) {
  return margin < kLargestMargin ? fmt::format("{:.2f}", margin) : fmt::format("{:.2f}+", margin);
}

std::string verdict_of(const Judged& layout) {
  const std::size_t direction = layout.weakest();
  const std::uint32_t box = layout.margins.critical_box.at(direction);
  if (layout.margins.margin.at(direction) < 0.0) return fmt::format("does not stand, box {}", box);
  if (box == 0) return "-";
  const std::string range =
      std::isnan(layout.spread.low.at(direction))
          ? ""
          : fmt::format(", {:.2f} to {:.2f} g", layout.spread.low.at(direction), layout.spread.high.at(direction));
  const double need = layout.needed.at(direction);
  const std::string lack =
      need > layout.margins.margin.at(direction) ? fmt::format("; needs {} g", number_text(need)) : "";
  return fmt::format("{}, box {}{}{}", kMarginDirections.at(direction).name, box, range, lack);
}

std::string line_of(std::string_view name, std::size_t width, const std::array<double, kDirectionCount>& margins,
                    std::string_view verdict) {
  std::string line = fmt::format("  {:<{}}", name, width);
  for (const double margin : margins) line += fmt::format("  {:>6}", size_text(margin));
  if (!verdict.empty()) line += "  ";
  return line.append(verdict) + '\n';
}

}  // namespace

Result<std::string> margin_table(ResultsReader& results) {
  const ResultsInfo& info = results.info();
  const bool has_spread = info.has(kMarginSpread.tables);
  const Result<std::vector<LayoutMargins>> margins = read_layouts<LayoutMargins>(results, 0, info.layouts.size());
  if (!margins) return margins.errors();
  Result<std::vector<MarginSpread>> spreads = std::vector<MarginSpread>(info.layouts.size());
  if (has_spread) spreads = read_layouts<MarginSpread>(results, 0, info.layouts.size());
  if (!spreads) return spreads.errors();

  const Result<ChosenNorm> norm = find_norm(info.norm);
  const auto needed = norm ? norm->needed_margins() : std::array<double, kDirectionCount>{};

  std::vector<std::size_t> order;
  const auto least = [&](std::size_t i) { return Judged{(*margins)[i], (*spreads)[i], needed}.least(); };
  for (std::size_t i = 0; i < margins->size(); ++i)
    if (!std::isnan(least(i))) order.push_back(i);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return least(a) < least(b); });
  const std::size_t shown = std::min(order.size(), kLayoutsShown);

  const std::string needed_name = norm ? fmt::format("needed by {}", norm->name()) : "layout";
  std::size_t width = needed_name.size();
  for (std::size_t i = 0; i < shown; ++i) width = std::max(width, printable(info.layouts[order[i]]).size());
  std::string text = "\nmargins: the largest constant acceleration that a layout stands, in g\n";
  text += fmt::format("  {:<{}}", "layout", width);
  for (const MarginDirection& direction : kMarginDirections) text += fmt::format("  {:>6}", direction.name);
  text += has_spread ? "  weakest, and from 5 to 95 % of its replicas\n" : "  weakest\n";
  if (norm) text += line_of(needed_name, width, needed, "");
  for (std::size_t i = 0; i < shown; ++i) {
    const LayoutMargins& layout = (*margins)[order[i]];
    text += line_of(printable(info.layouts[order[i]]), width, layout.margin,
                    verdict_of({layout, (*spreads)[order[i]], needed}));
  }
  if (order.size() > shown) text += fmt::format("  and {} more that stand better\n", order.size() - shown);
  return text;
}

}  // namespace holdfast::internal
