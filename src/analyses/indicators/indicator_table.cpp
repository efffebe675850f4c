#include "analyses/indicators/indicators.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "analyses/layouts_shown.hpp"
#include "io/input/text_lines.hpp"
#include "io/results/found_tables.hpp"

namespace holdfast::internal {

namespace {

/// A share in per cent.
std::string share_text(double share) {
  const double percent = std::round(100.0 * share);
  return fmt::format("{:.0f} %", percent == 0.0 ? 0.0 : percent);  // no zero with a sign
}

}  // namespace

Result<std::string> indicator_table(ResultsReader& results) {
  const ResultsInfo& info = results.info();
  const std::size_t shown = std::min(info.layouts.size(), kLayoutsShown);
  const Result<std::vector<LayoutIndicators>> indicators = read_layouts<LayoutIndicators>(results, 0, shown);
  if (!indicators) return indicators.errors();

  std::size_t width = std::string_view("layout").size();
  for (std::size_t i = 0; i < shown; ++i) width = std::max(width, printable(info.layouts[i]).size());
  std::string text =
      "\nindicators, of geometry alone: fill and centre of gravity in per cent of the container, along and across from "
      "its middle;\n  bad base and bad sides in per cent of the boxes\n";
  text += fmt::format("  {:<{}}    fill   along  across  height  bad base  bad sides\n", "layout", width);
  for (std::size_t i = 0; i < shown; ++i) {
    const LayoutIndicators& layout = (*indicators)[i];
    if (std::isnan(layout.fill)) continue;
    // From the floor up, which says more than from the middle.
    text += fmt::format("  {:<{}}  {:>6}  {:>6}  {:>6}  {:>6}  {:>8}  {:>9}\n", printable(info.layouts[i]), width,
                        share_text(layout.fill), share_text(layout.centre_offset.x()),
                        share_text(layout.centre_offset.y()), share_text(layout.centre_offset.z() + 0.5),
                        share_text(layout.badly_based), share_text(layout.badly_braced));
  }
  if (info.layouts.size() > shown)
    text += fmt::format("  and {} more; `holdfast summary --csv` writes all\n", info.layouts.size() - shown);
  return text;
}

}  // namespace holdfast::internal
