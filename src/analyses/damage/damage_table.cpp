#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>
#include <vector>

#include "analyses/damage/damage.hpp"
#include "analyses/layouts_shown.hpp"
#include "io/input/text_lines.hpp"
#include "io/results/found_tables.hpp"
#include "io/results/load_names.hpp"

namespace holdfast::internal {

namespace {

/// The worst over the accelerations of a layout.
struct LayoutDamage {
  std::uint32_t boxes_beyond = 0;  ///< in the world with the most
  double peak_acceleration = 0.0;  ///< of any box, m/s²
  double velocity_change = 0.0;    ///< of any box, m/s
  std::uint64_t layout = 0;        ///< its number in the run
  std::uint32_t box = 0;           ///< with that velocity change: position in the layout file, from 1
  std::uint64_t acceleration = 0;  ///< in the world with that velocity change

  /// What lines are sorted by.
  auto rank() const { return std::tuple(boxes_beyond, velocity_change, peak_acceleration); }

  void add(const WorldRow& row, const WorldDamage& damage) {
    boxes_beyond = std::max(boxes_beyond, damage.boxes_beyond);
    for (std::size_t i = 0; i < damage.velocity_change.size(); ++i) {
      peak_acceleration = std::max(peak_acceleration, static_cast<double>(damage.peak_acceleration[i]));
      const auto change = static_cast<double>(damage.velocity_change[i]);
      if (change <= velocity_change) continue;
      velocity_change = change;
      layout = row.layout;
      box = static_cast<std::uint32_t>(i + 1);
      acceleration = row.acceleration;
    }
  }
};

/// All worlds of a file that were accelerated, layout by layout.
struct DamageLines {
  std::map<std::uint64_t, LayoutDamage> layouts;
  std::uint64_t worlds = 0;
  std::uint64_t exceeding = 0;  ///< worlds with a box beyond the boundary
};

Result<DamageLines> read_lines(ResultsReader& results) {
  DamageLines lines;
  const std::uint64_t count = results.info().world_count;
  for (std::uint64_t begin = 0; begin < count; begin += kSliceWorlds) {
    const Result<std::vector<WorldRow>> rows = results.worlds(begin, std::min(kSliceWorlds, count - begin));
    if (!rows) return rows.errors();
    const Result<std::vector<WorldDamage>> damage = read_worlds<WorldDamage>(results, begin, *rows, Depth::boxes);
    if (!damage) return damage.errors();
    for (std::size_t i = 0; i < rows->size(); ++i) {
      const WorldDamage& world = (*damage)[i];
      if (!world.known()) continue;
      lines.layouts[(*rows)[i].layout].add((*rows)[i], world);
      ++lines.worlds;
      if (world.boxes_beyond > 0) ++lines.exceeding;
    }
  }
  return lines;
}

std::string text_of(const DamageLines& lines, ResultsReader& results) {
  const ResultsInfo& info = results.info();
  LoadNames names(results);
  const auto shown = shown_layouts(lines.layouts, info, [](const LayoutDamage& line) { return line.rank(); });
  std::string text = "\ndamage: boxes beyond the boundary, and the hardest impact\n";
  text += fmt::format("  {:<{}}  boxes  peak (g)  impact (m/s)\n", "layout", shown.width);
  for (const auto& [name, line] : shown.lines) {
    text += fmt::format("  {:<{}}  {:>5}  {:>8.1f}  {:>12.2f}", name, shown.width, line.boxes_beyond,
                        line.peak_acceleration / kStandardGravity, line.velocity_change);
    if (line.box > 0)
      text += fmt::format("  {}, {}", names.box_text(line.layout, line.box),
                          printable(info.acceleration_name(line.acceleration)));
    text += "\n";
  }
  if (shown.hidden > 0) text += fmt::format("  and {} more; `holdfast summary --csv` writes all\n", shown.hidden);
  return text + fmt::format("  beyond the boundary in {} of {} accelerated worlds\n", lines.exceeding, lines.worlds);
}

}  // namespace

Result<std::string> damage_table(ResultsReader& results) {
  const Result<DamageLines> lines = read_lines(results);
  if (!lines) return lines.errors();
  return text_of(*lines, results);
}

}  // namespace holdfast::internal
