#include "analyses/walls/wall_forces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "analyses/layouts_shown.hpp"
#include "io/input/text_lines.hpp"
#include "io/results/found_tables.hpp"

namespace holdfast::internal {

namespace {

constexpr std::array<std::size_t, 4> kFourWalls = {1, 2, 3, 4};  ///< of `kContainerSides`: front, rear, left, right

/// The largest over the accelerations of a layout: share of the limit, or N where there is none.
struct LayoutWalls {
  std::array<double, kPushedCount> largest = {};
  std::size_t worst_wall = kFourWalls.front();
  std::uint64_t worst_acceleration = 0;

  double worst() const { return largest.at(worst_wall); }

  void add(const WallForces& walls, bool limited, std::uint64_t acceleration) {
    for (const std::size_t wall : kFourWalls) {
      const double value = limited ? walls.share_of_limit(wall) : walls.lasting_force.at(wall);
      if (value > worst()) {
        worst_wall = wall;
        worst_acceleration = acceleration;
      }
      largest.at(wall) = std::max(largest.at(wall), value);
    }
  }
};

/// All worlds of a file that were accelerated, layout by layout.
struct WallLines {
  std::map<std::uint64_t, LayoutWalls> layouts;
  bool limited = false;  ///< by a norm
  std::uint64_t worlds = 0;
  std::uint64_t exceeding = 0;  ///< worlds in which a wall is pressed beyond its limit

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

/// 12.5: kN; 83 %: of the limit.
std::string value_text(double value, bool limited) {
  return limited ? fmt::format("{:.0f} %", 100.0 * value) : fmt::format("{:.1f}", value / 1000.0);
}

std::string text_of(const WallLines& lines, const ResultsInfo& info) {
  const auto shown = shown_layouts(lines.layouts, info, [](const LayoutWalls& line) { return line.worst(); });
  std::string text = lines.limited ? "\nwalls: the largest force for 0.05 s, in per cent of the norm's test force\n"
                                   : "\nwalls: the largest force for 0.05 s, in kN\n";
  text += fmt::format("  {:<{}}", "layout", shown.width);
  for (const std::size_t wall : kFourWalls) text += fmt::format("  {:>6}", kContainerSides.at(wall).name);
  text += "  largest\n";
  for (const auto& [name, line] : shown.lines) {
    text += fmt::format("  {:<{}}", name, shown.width);
    for (const std::size_t wall : kFourWalls)
      text += fmt::format("  {:>6}", value_text(line.largest.at(wall), lines.limited));
    const std::string where = fmt::format("{}, {}", kContainerSides.at(line.worst_wall).name,
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
