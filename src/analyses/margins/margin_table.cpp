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
#include "io/results/load_names.hpp"

namespace holdfast::internal {

namespace {

/// The margins of a layout beside what a norm needs, g; nothing is needed where that is 0. What is judged is the margin
/// within the limits, as worlds are; files of an earlier version have only that in place.
struct Judged {
  const LayoutMargins& margins;
  const MarginSpread& spread;
  const std::array<double, kDirectionCount>& needed;
  bool has_limits = true;

  double margin(std::size_t direction) const {
    return has_limits ? margins.margin_within_limits.at(direction) : margins.margin.at(direction);
  }
  std::uint32_t critical_box(std::size_t direction) const {
    return has_limits ? margins.critical_box_within_limits.at(direction) : margins.critical_box.at(direction);
  }

  /// What share of what is needed the layout stands in a direction; without a norm, its margin.
  double share(std::size_t direction) const {
    const bool any = std::any_of(needed.begin(), needed.end(), [](double need) { return need > 0.0; });
    const double need = any ? needed.at(direction) : 1.0;
    return need > 0.0 ? margin(direction) / need : std::numeric_limits<double>::infinity();
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

/// Rounded down: a load stands what the text says.
std::string size_text(double margin) {
  constexpr double kRounding = 1e-6;  // of a number that has two digits, times 100
  const double hundredths = std::floor(100.0 * margin + kRounding);
  return fmt::format("{:.2f}{}", hundredths / 100.0, margin < kLargestMargin ? "" : "+");
}

/// What is needed, with a third digit where it has one.
std::string need_text(double need) {
  constexpr double kRounding = 1e-9;
  const bool has_two = std::abs(need - std::round(100.0 * need) / 100.0) < kRounding;
  return fmt::format("{:.{}f}", need, has_two ? 2 : 3);
}

/// In place, and within the limits where the file has that.
std::string cell_of(const Judged& layout, std::size_t direction) {
  const std::string in_place = size_text(layout.margins.margin.at(direction));
  return layout.has_limits ? fmt::format("{} / {:>5}", in_place, size_text(layout.margin(direction))) : in_place;
}

/// @param number of the layout in the run
std::string verdict_of(const Judged& layout, std::uint64_t number, LoadNames& names) {
  const std::size_t direction = layout.weakest();
  const std::uint32_t box = layout.critical_box(direction);
  if (layout.margin(direction) < 0.0) return "unstable, " + names.box_text(number, box);
  if (box == 0) return "-";
  const std::string range = std::isnan(layout.spread.low.at(direction))
                                ? ""
                                : fmt::format(", {} to {} g", size_text(layout.spread.low.at(direction)),
                                              size_text(layout.spread.high.at(direction)));
  const double need = layout.needed.at(direction);
  const std::string lack = need > layout.margin(direction) ? fmt::format("; needs {} g", number_text(need)) : "";
  return fmt::format("{}, {}{}{}", kMarginDirections.at(direction).name, names.box_text(number, box), range, lack);
}

constexpr int kCellWidth = 15;

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
  const bool has_limits = info.version >= 3;
  const auto judged = [&](std::size_t i) { return Judged{(*margins)[i], (*spreads)[i], needed, has_limits}; };
  for (std::size_t i = 0; i < margins->size(); ++i)
    if (!std::isnan(judged(i).least())) order.push_back(i);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return judged(a).least() < judged(b).least(); });
  const std::size_t shown = std::min(order.size(), kLayoutsShown);

  const std::string needed_name = norm ? fmt::format("needed by {}", norm->name()) : "layout";
  std::size_t width = needed_name.size();
  for (std::size_t i = 0; i < shown; ++i) width = std::max(width, printable(info.layouts[order[i]]).size());
  std::string text = fmt::format(
      "\nmargins: the largest acceleration, in g and lasting, under which every box stays in its place (5 mm){}\n",
      has_limits ? " / within the limits" : "");
  text += fmt::format("  {:<{}}", "layout", width);
  for (const MarginDirection& direction : kMarginDirections) text += fmt::format("{:>{}}", direction.name, kCellWidth);
  text += has_spread ? "  weakest, and from 5 to 95 % of its replicas\n" : "  weakest\n";
  if (norm) {
    text += fmt::format("  {:<{}}", needed_name, width);
    for (const double need : needed) text += fmt::format("{:>{}}", need_text(need), kCellWidth);
    text += '\n';
  }
  LoadNames names(results);
  for (std::size_t i = 0; i < shown; ++i) {
    text += fmt::format("  {:<{}}", printable(info.layouts[order[i]]), width);
    for (std::size_t direction = 0; direction < kDirectionCount; ++direction)
      text += fmt::format("{:>{}}", cell_of(judged(order[i]), direction), kCellWidth);
    text += "  " + verdict_of(judged(order[i]), info.layout_begin + order[i], names) + '\n';
  }
  if (order.size() > shown) text += fmt::format("  and {} more that stand better\n", order.size() - shown);
  return text;
}

}  // namespace holdfast::internal
