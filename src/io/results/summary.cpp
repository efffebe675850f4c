#include "io/results/summary.hpp"

#include <algorithm>

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
  EndTable part;
  visit_ends<EndTable>([&](const OutcomeField&, auto member) { part.*member = cut(end.*member); });
  return part;
}

/// Takes as many of the rows as fit into a slice.
std::vector<WorldRow> take_slice(std::vector<WorldRow> rows) {
  std::uint64_t boxes = 0;
  std::size_t count = 0;
  while (count < rows.size() && (count == 0 || boxes + rows[count].boxes <= kSliceBoxes)) boxes += rows[count++].boxes;
  rows.resize(count);
  return rows;
}

/// /boxes contains the boxes of one world after the other; a file in which it does not is damaged.
void check_ranges(const ResultsInfo& info, const SummarySlice& slice) {
  std::uint64_t next = slice.box_begin;
  for (std::size_t i = 0; i < slice.rows.size(); ++i) {
    const WorldRow& row = slice.rows[i];
    if (row.box_begin != next || row.boxes > info.box_count - next) {
      throw h5::Failure(Error{.file = info.path,
                              .what = "is damaged: the boxes of a world are not where they should be, world",
                              .value = std::to_string(slice.world_begin + i)});
    }
    next += row.boxes;
  }
}

SummarySlice derive_slice(ResultsReader& results, const Judging& judging, std::uint64_t world_begin,
                          std::uint64_t box_begin) {
  const std::uint64_t left = results.info().world_count - world_begin;
  SummarySlice slice;
  slice.world_begin = world_begin;
  slice.rows = take_slice(value_of(results.worlds(world_begin, std::min(left, kSliceWorlds))));
  slice.box_begin = box_begin;
  check_ranges(results.info(), slice);
  const std::uint64_t box_count = slice.rows.back().box_begin + slice.rows.back().boxes - slice.box_begin;
  slice.ends = value_of(results.ends(slice.box_begin, box_count));
  for (const WorldRow& row : slice.rows) {
    const EndTable end = part_of(slice.ends, row.box_begin - slice.box_begin, row.boxes);
    slice.worlds.push_back(judge_world(row, end, judging));
    const std::vector<BoxVerdict> boxes = judge_boxes(end, judging);
    slice.boxes.insert(slice.boxes.end(), boxes.begin(), boxes.end());
  }
  return slice;
}

}  // namespace

std::vector<BoxVerdict> judge_boxes(const EndTable& end, const Judging& judging) {
  std::vector<BoxVerdict> boxes;
  for (std::size_t i = 0; i < end.end_displacement.size(); ++i) boxes.push_back(judge_box(end, i, judging));
  return boxes;
}

std::optional<Error> derive_summary(ResultsReader& results, const Thresholds& thresholds,
                                    const std::function<std::optional<Error>(const SummarySlice&)>& visit) {
  return h5::caught("", [&] {
    const ResultsInfo& info = results.info();
    const Judging judging = info.judging(thresholds);
    // A part may repeat boxes of worlds of the previous part.
    std::uint64_t box = info.complete || info.world_count == 0 ? 0 : value_of(results.worlds(0, 1)).front().box_begin;
    for (std::uint64_t world = 0; world < info.world_count;) {
      const SummarySlice slice = derive_slice(results, judging, world, box);
      if (const auto error = visit(slice)) throw h5::Failure(*error);
      world += slice.rows.size();
      box += slice.boxes.size();
    }
    if (box != info.box_count)
      throw h5::Failure(Error{.file = info.path, .what = "is damaged: it has boxes that belong to no world"});
  });
}

}  // namespace holdfast::internal
