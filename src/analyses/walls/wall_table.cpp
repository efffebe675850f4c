#include "analyses/walls/wall_forces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <vector>

#include "analyses/layouts_shown.hpp"
#include "io/input/text_lines.hpp"
#include "io/results/found_tables.hpp"

namespace holdfast::internal {

namespace {

constexpr std::array<std::size_t, 4> kFourWalls = {1, 2, 3, 4};  ///< of `kContainerSides`: front, rear, left, right

constexpr std::array<std::size_t, 5> kShown = {1, 2, 3, 4, kFixedBoxes};  ///< of `kPushedNames`

/// The largest over the accelerations of a layout: share of the limit, or N where there is none. A norm has no limit
/// for fixed boxes, so that these have N.
struct LayoutWalls {
  std::array<double, kPushedCount> largest = {};
  std::size_t worst_wall = kFourWalls.front();
  std::uint64_t worst_acceleration = 0;

  double worst() const { return largest.at(worst_wall); }

  void add(const WallForces& walls, bool limited, std::uint64_t acceleration) {
    for (const std::size_t side : kShown) {
      const bool is_share = limited && side != kFixedBoxes;
      const double value = is_share ? walls.share_of_limit(side) : walls.lasting_force.at(side);
      if (is_share == limited && value > worst()) {
        worst_wall = side;
        worst_acceleration = acceleration;
      }
      largest.at(side) = std::max(largest.at(side), value);  // what it was where the value is NaN
    }
  }
};

/// All worlds of a file that were accelerated, layout by layout.
struct WallLines {
  std::map<std::uint64_t, LayoutWalls> layouts;
  bool limited = false;  ///< by a norm
  std::uint64_t worlds = 0;
  std::uint64_t exceeding = 0;  ///< worlds in which a wall is pressed beyond its limit

  /// Whether any load presses boxes that are fixed to its container.
  bool has_fixed() const {
    return std::any_of(layouts.begin(), layouts.end(),
                       [](const auto& line) { return line.second.largest.at(kFixedBoxes) > 0.0; });
  }

  void add(const WorldRow& row, const WallForces& walls) {
    if (!walls.known()) return;
    limited = !std::isnan(walls.limit.at(kFourWalls.front()));
    layouts[row.layout].add(walls, limited, row.acceleration);
    ++worlds;
    if (std::any_of(kFourWalls.begin(), kFourWalls.end(), [&](std::size_t wall) { return walls.exceeds(wall); }))
      ++exceeding;
  }
};

Result<WallLines> read_lines(ResultsReader& results) {
  WallLines lines;
  const std::uint64_t count = results.info().world_count;
  for (std::uint64_t begin = 0; begin < count; begin += kSliceWorlds) {
    const Result<std::vector<WorldRow>> rows = results.worlds(begin, std::min(kSliceWorlds, count - begin));
    if (!rows) return rows.errors();
    const Result<std::vector<WallForces>> walls = read_worlds<WallForces>(results, begin, *rows);
    if (!walls) return walls.errors();
    for (std::size_t i = 0; i < rows->size(); ++i) lines.add((*rows)[i], (*walls)[i]);
  }
  return lines;
}

/// 12.5: kN; 83 %: of the limit; 12.5 kN: on fixed boxes beside walls with a limit.
std::string value_text(double value, std::size_t side, bool limited) {
  if (limited && side != kFixedBoxes) return fmt::format("{:.0f} %", 100.0 * value);
  return fmt::format("{:.1f}{}", value / 1000.0, limited ? " kN" : "");
}

std::string text_of(const WallLines& lines, const ResultsInfo& info) {
  const auto shown = shown_layouts(lines.layouts, info, [](const LayoutWalls& line) { return line.worst(); });
  const std::span sides = std::span(kShown).first(lines.has_fixed() ? kShown.size() : kFourWalls.size());
  const auto width = [&](std::size_t side) { return lines.limited && side == kFixedBoxes ? 8 : 6; };
  std::string text = fmt::format("\nwalls: the largest force for 0.05 s, in {}{}\n",
                                 lines.limited ? "per cent of the norm's test force" : "kN",
                                 lines.has_fixed() ? "; fixed: on all fixed boxes together" : "");
  text += fmt::format("  {:<{}}", "layout", shown.width);
  for (const std::size_t side : sides) text += fmt::format("  {:>{}}", kPushedNames.at(side), width(side));
  text += "  largest\n";
  for (const auto& [name, line] : shown.lines) {
    text += fmt::format("  {:<{}}", name, shown.width);
    for (const std::size_t side : sides)
      text += fmt::format("  {:>{}}", value_text(line.largest.at(side), side, lines.limited), width(side));
    const std::string where = fmt::format("{}, {}", kPushedNames.at(line.worst_wall),
                                          printable(info.acceleration_name(line.worst_acceleration)));
    text += fmt::format("  {}{}\n", line.worst() > 0.0 ? where : "-",
                        lines.limited && line.worst() > 1.0 ? ", exceeded" : "");
  }
  if (shown.hidden > 0) text += fmt::format("  and {} more that press less\n", shown.hidden);
  if (lines.limited) text += fmt::format("  exceeded in {} of {} accelerated worlds\n", lines.exceeding, lines.worlds);
  return text;
}

}  // namespace

Result<std::string> wall_table(ResultsReader& results) {
  const Result<WallLines> lines = read_lines(results);
  if (!lines) return lines.errors();
  return text_of(*lines, results.info());
}

}  // namespace holdfast::internal
