#include "analyses/load_shift/load_shift.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "analyses/analysis.hpp"
#include "analyses/layouts_shown.hpp"
#include "analyses/load_shift/load_shift_recorder.hpp"
#include "io/export/csv_field.hpp"
#include "io/input/text_lines.hpp"
#include "io/results/found_tables.hpp"
#include "io/results/summary.hpp"

namespace holdfast::internal {

namespace {

constexpr WorldNumber kShiftNumbers[] = {
    {"load_shift", "f8", "Farthest that the load's centre of gravity is displaced, m; NaN without ``LoadShift``.",
     [](const Findings& found) { return found.value<LoadShift>().peak.norm(); }, "farthest_m"},
    {"load_shift_time", "f8", "When that is, s; NaN without ``LoadShift``.",
     [](const Findings& found) { return found.value<LoadShift>().peak_time; }, "time_s"},
    {"load_shift_end", "f8", "How far it is displaced at the end, m; NaN without ``LoadShift``.",
     [](const Findings& found) { return found.value<LoadShift>().end.norm(); }, "end_m"}};

std::string fields_of(const LoadShift& shift) {
  return fmt::format(",{},{},{}", csv_vector(shift.end), csv_vector(shift.peak), csv_number(shift.peak_time));
}

Result<CsvFields> shift_fields(ResultsReader& results, const SummarySlice& slice) {
  const Result<std::vector<LoadShift>> shifts = read_worlds<LoadShift>(results, slice.world_begin, slice.rows);
  if (!shifts) return shifts.errors();
  CsvFields fields;
  for (const LoadShift& shift : *shifts) fields.worlds.push_back(fields_of(shift));
  fields.boxes.resize(slice.boxes.size());
  return fields;
}

/// A length rounded to millimetres, m. Adding 0 turns −0 into 0, which is easier to read.
double millimetres(double length) { return std::round(1e3 * length) / 1e3 + 0.0; }

/// The world of a layout in which its load shifts farthest.
struct Farthest {
  LoadShift shift;
  std::uint64_t acceleration = 0;
};

/// The farthest shifts of layouts over their accelerations, the largest first.
Result<std::string> shift_table(ResultsReader& results) {
  const ResultsInfo& info = results.info();
  std::map<std::uint64_t, Farthest> layouts;
  for (std::uint64_t begin = 0; begin < info.world_count; begin += kSliceWorlds) {
    const Result<std::vector<WorldRow>> rows = results.worlds(begin, std::min(kSliceWorlds, info.world_count - begin));
    if (!rows) return rows.errors();
    const Result<std::vector<LoadShift>> shifts = read_worlds<LoadShift>(results, begin, *rows);
    if (!shifts) return shifts.errors();
    for (std::size_t i = 0; i < rows->size(); ++i) {
      const LoadShift& shift = (*shifts)[i];
      if (std::isnan(shift.peak_time)) continue;
      const auto [place, is_new] = layouts.try_emplace((*rows)[i].layout, Farthest{shift, (*rows)[i].acceleration});
      if (shift.peak.norm() > place->second.shift.peak.norm()) place->second = {shift, (*rows)[i].acceleration};
    }
  }
  const auto shown = shown_layouts(layouts, info, [](const Farthest& line) { return line.shift.peak.norm(); });
  std::string text = "\nload shift: how far the centre of gravity of the load is displaced, in m\n";
  text += fmt::format("  {:<{}}  farthest   along  across  upwards\n", "layout", shown.width);
  for (const auto& [name, farthest] : shown.lines) {
    const Vec3& peak = farthest.shift.peak;
    text += fmt::format("  {:<{}}  {:>8.3f}  {:>6.3f}  {:>6.3f}  {:>7.3f}  {}\n", name, shown.width, peak.norm(),
                        millimetres(peak.x()), millimetres(peak.y()), millimetres(peak.z()),
                        printable(info.acceleration_name(farthest.acceleration)));
  }
  if (shown.hidden > 0) text += fmt::format("  and {} more that shift less\n", shown.hidden);
  return text;
}

}  // namespace

const Analysis kLoadShift = {.key = "LoadShift",
                             .option = "Also record how far the centre of gravity of the load is displaced",
                             .enabled = [](const Settings& settings) { return settings.screening.load_shift; },
                             .method = {.recorder = [](const Settings& /*settings*/, const BoxView& boxes,
                                                       const StateView& settled) -> std::unique_ptr<AnalysisRecorder> {
                               return std::make_unique<LoadShiftRecorder>(boxes, settled);
                             }},
                             .tables = tables_of_worlds<LoadShift>(
                                 {.name = "load_shift",
                                  .asked_by = "`LoadShift`",
                                  .page = "load_shift.md",
                                  .file_order = 3,
                                  .world_headings = ",load_shift_end_x_m,load_shift_end_y_m,load_shift_end_z_m,"
                                                    "load_shift_peak_x_m,load_shift_peak_y_m,"
                                                    "load_shift_peak_z_m,load_shift_peak_time_s",
                                  .csv_fields = shift_fields}),
                             .table = shift_table,
                             .numbers = kShiftNumbers};

}  // namespace holdfast::internal
