#include "io/results/summary.hpp"

#include <algorithm>
#include <limits>

#include "io/results/hdf5_file.hpp"

namespace holdfast::internal {

namespace {

/// Largest number of boxes in a slice, which has at least one world and at most `kSliceWorlds`.
constexpr std::uint64_t kSliceBoxes = std::uint64_t{1} << 17U;

template <class T>
T value_of(Result<T>&& result) {
  if (!result) throw h5::Failure(result.error());
  return std::move(*result);
}

/// The boxes [begin, begin + count) of the table.
EndTable part_of(const EndTable& end, std::size_t begin, std::size_t count) {
  const auto cut = [&](const auto& column) {
    const auto from = column.begin() + static_cast<std::ptrdiff_t>(begin);
    return std::decay_t<decltype(column)>(from, from + static_cast<std::ptrdiff_t>(count));
  };
  return {cut(end.displacement),        cut(end.tilt),
          cut(end.kinetic_energy),      cut(end.peak_displacement),
          cut(end.peak_kinetic_energy), cut(end.settling_displacement)};
}

/// Times at which the boxes of a world first moved. A box whose peak displacement is below the threshold has no such
/// time, so that the series of most worlds need not be read.
/// @param times called for the other worlds
template <class Times>
void append_first_moves(const EndTable& end, const Thresholds& thresholds, BoxSummary& boxes, Times&& times) {
  const auto& peak = end.peak_displacement;
  const bool any =
      std::any_of(peak.begin(), peak.end(), [&](float p) { return !(static_cast<double>(p) <= thresholds.move); });
  const std::vector<float> found =
      any ? times() : std::vector<float>(peak.size(), std::numeric_limits<float>::quiet_NaN());
  boxes.first_move_time.insert(boxes.first_move_time.end(), found.begin(), found.end());
}

void append_world(const WorldVerdict& verdict, WorldSummary& worlds) {
  worlds.verdict.push_back(verdict.verdict);
  worlds.fallen_boxes.push_back(verdict.fallen_boxes);
  worlds.unstable_boxes.push_back(verdict.unstable_boxes);
  worlds.moved_boxes.push_back(verdict.moved_boxes);
  worlds.tilted_boxes.push_back(verdict.tilted_boxes);
  worlds.total_kinetic_energy.push_back(verdict.total_kinetic_energy);
  worlds.peak_kinetic_energy.push_back(verdict.peak_kinetic_energy);
  worlds.max_displacement.push_back(verdict.max_displacement);
  worlds.peak_displacement.push_back(verdict.peak_displacement);
}

void append_boxes(const EndTable& end, const Thresholds& thresholds, BoxSummary& boxes) {
  for (std::size_t i = 0; i < end.displacement.size(); ++i) {
    const BoxVerdict verdict = judge_box(end, i, thresholds);
    boxes.displacement.push_back(end.displacement[i]);
    boxes.max_displacement.push_back(end.peak_displacement[i]);
    boxes.drop.push_back(verdict.drop);
    boxes.tilt.push_back(end.tilt[i]);
    boxes.kinetic_energy.push_back(end.kinetic_energy[i]);
    boxes.peak_kinetic_energy.push_back(end.peak_kinetic_energy[i]);
    boxes.fallen.push_back(verdict.fallen ? 1 : 0);
    boxes.moved.push_back(verdict.moved ? 1 : 0);
    boxes.tilted.push_back(verdict.tilted ? 1 : 0);
    boxes.unstable.push_back(verdict.unstable ? 1 : 0);
  }
}

/// Takes as many of the rows as fit into a slice.
std::vector<WorldRow> take_slice(std::vector<WorldRow> rows) {
  std::uint64_t boxes = 0;
  std::size_t count = 0;
  while (count < rows.size() && (count == 0 || boxes + rows[count].box_count <= kSliceBoxes))
    boxes += rows[count++].box_count;
  rows.resize(count);
  return rows;
}

/// /boxes contains the boxes of one world after the other; a file in which it does not is damaged.
void check_ranges(const ResultsInfo& info, const SummarySlice& slice) {
  std::uint64_t next = slice.box_begin;
  for (std::size_t i = 0; i < slice.rows.size(); ++i) {
    const WorldRow& row = slice.rows[i];
    if (row.box_begin != next || row.box_count > info.box_count - next) {
      throw h5::Failure(Error{.file = info.path,
                              .what = "is damaged: the boxes of a world are not where they should be, world",
                              .value = std::to_string(slice.world_begin + i)});
    }
    next += row.box_count;
  }
}

SummarySlice derive_slice(ResultsReader& results, const Thresholds& thresholds, std::uint64_t world_begin,
                          std::uint64_t box_begin) {
  const std::uint64_t left = results.info().world_count - world_begin;
  SummarySlice slice;
  slice.world_begin = world_begin;
  slice.rows = take_slice(value_of(results.worlds(world_begin, std::min(left, kSliceWorlds))));
  slice.box_begin = box_begin;
  check_ranges(results.info(), slice);
  const std::uint64_t box_count = slice.rows.back().box_begin + slice.rows.back().box_count - slice.box_begin;
  const EndTable ends = value_of(results.ends(slice.box_begin, box_count));
  for (const WorldRow& row : slice.rows) {
    const EndTable end = part_of(ends, row.box_begin - slice.box_begin, row.box_count);
    append_world(judge_world(row.status, row.stop_reason, row.peak_total_kinetic_energy, end, thresholds),
                 slice.worlds);
    append_boxes(end, thresholds, slice.boxes);
    append_first_moves(end, thresholds, slice.boxes, [&] {
      const Series series = value_of(results.path_of(row));
      return first_move_times(series.time, series.displacement, row.box_count, thresholds);
    });
  }
  return slice;
}

}  // namespace

void append_summary(const WorldRecord& world, const Thresholds& thresholds, WorldSummary& worlds, BoxSummary& boxes) {
  append_world(judge_world(world.outcome.status, world.outcome.stop_reason, world.peak_total_kinetic_energy, world.end,
                           thresholds),
               worlds);
  append_boxes(world.end, thresholds, boxes);
  append_first_moves(world.end, thresholds, boxes, [&] {
    return first_move_times(world.series.time, world.series.displacement, world.end.displacement.size(), thresholds);
  });
}

std::optional<Error> derive_summary(ResultsReader& results, const Thresholds& thresholds,
                                    const std::function<std::optional<Error>(const SummarySlice&)>& visit) {
  return h5::caught("", [&] {
    const ResultsInfo& info = results.info();
    // A part may repeat boxes of worlds of the previous part.
    std::uint64_t box = info.complete || info.world_count == 0 ? 0 : value_of(results.worlds(0, 1)).front().box_begin;
    for (std::uint64_t world = 0; world < info.world_count;) {
      const SummarySlice slice = derive_slice(results, thresholds, world, box);
      if (const auto error = visit(slice)) throw h5::Failure(*error);
      world += slice.rows.size();
      box += slice.boxes.drop.size();
    }
    if (box != info.box_count)
      throw h5::Failure(Error{.file = info.path, .what = "is damaged: it has boxes that belong to no world"});
  });
}

}  // namespace holdfast::internal
