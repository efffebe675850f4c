#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/input/text_lines.hpp"
#include "io/results/results_reader.hpp"

namespace holdfast::internal {

/// Layouts that a table on the terminal shows, at most: the worst ones.
inline constexpr std::size_t kLayoutsShown = 20;

/// The lines of a table with one line per layout.
template <class Line>
struct ShownLayouts {
  std::vector<std::pair<std::string, Line>> lines;        ///< with the name of the layout, the worst one first
  std::size_t hidden = 0;                                 ///< layouts that are left out
  std::size_t width = std::string_view("layout").size();  ///< of the column of names
};

/// The `kLayoutsShown` layouts of the highest rank; those of equal rank in the order of the run.
///
/// @param layouts Line of each layout, by its number in the run.
/// @param info Names of the layouts.
/// @param rank Of a line: higher is worse.
template <class Line, class Rank>
ShownLayouts<Line> shown_layouts(const std::map<std::uint64_t, Line>& layouts, const ResultsInfo& info, Rank rank) {
  ShownLayouts<Line> shown;
  for (const auto& [layout, line] : layouts) shown.lines.emplace_back(printable(info.layout_name(layout)), line);
  std::stable_sort(shown.lines.begin(), shown.lines.end(),
                   [&](const auto& a, const auto& b) { return rank(a.second) > rank(b.second); });
  shown.hidden = shown.lines.size() - std::min(shown.lines.size(), kLayoutsShown);
  shown.lines.resize(shown.lines.size() - shown.hidden);
  for (const auto& [name, line] : shown.lines) shown.width = std::max(shown.width, name.size());
  return shown;
}

}  // namespace holdfast::internal
