#pragma once

#include <cassert>
#include <cstddef>
#include <span>
#include <type_traits>
#include <utility>

#include "io/results/analysis_tables.hpp"
#include "io/results/results_columns.hpp"
#include "io/results/results_reader.hpp"

/// Datasets, writing and reading of what an analysis finds, a type `Found`: its static member `describe(visit)` calls
/// `visit(content, &Found::member)` for every dataset. A member is one entry of a world or layout, or a column with
/// those of its boxes or samples.
namespace holdfast::internal {

/// How much of what was found of worlds or layouts is read: one entry of each, that of its boxes too, or everything.
enum class Depth : std::uint8_t { rows, boxes, samples };

template <class Found, class Member>
using EntryOfFound = EntryOf<std::decay_t<decltype(std::declval<Found>().*std::declval<Member>())>>;

/// Reads the datasets of consecutive rows of a table.
/// @param range_of of the rows' entries along an axis
template <class Found, class RangeOf>
Result<std::vector<Found>> read_found(ResultsReader& results, std::size_t rows, Depth depth, RangeOf&& range_of) {
  std::vector<Found> all(rows);
  std::optional<Error> error;
  Found::describe([&](const DatasetContent& content, auto member) {
    using Entry = EntryOfFound<Found, decltype(member)>;
    constexpr bool kIsColumn = !std::is_same_v<Entry, std::decay_t<decltype(all.front().*member)>>;
    const bool of_samples = content.axis == Axis::samples;
    if (content.since > results.info().version) return;  // it stays what it is in a new `Found`
    if (error || rows == 0 || (kIsColumn && depth < (of_samples ? Depth::samples : Depth::boxes))) return;
    const Result<EntryRange> range = range_of(content.axis);
    std::uint64_t count = 0;
    if (range)
      for (const std::size_t of_row : range->counts) count += of_row;
    const Result<std::vector<std::byte>> stored =
        range ? results.stored(content.path, range->begin, count) : range.errors();
    if (!stored) {
      error = stored.error();
      return;
    }
    const std::vector<Entry> entries = values_of<Entry>(*stored);
    auto next = entries.begin();
    for (std::size_t i = 0; i < rows; ++i) {
      if constexpr (kIsColumn) {
        const auto end = next + static_cast<std::ptrdiff_t>(range->counts[i]);
        (all[i].*member).assign(next, end);
        next = end;
      } else {
        all[i].*member = *next++;
      }
    }
  });
  if (error) return *error;
  return all;
}

/// Reads what was found of consecutive worlds.
/// @param begin row of the first one
template <class Found>
Result<std::vector<Found>> read_worlds(ResultsReader& results, std::uint64_t begin, std::span<const WorldRow> rows,
                                       Depth depth = Depth::rows) {
  return read_found<Found>(results, rows.size(), depth, [&](Axis axis) -> Result<EntryRange> {
    EntryRange range{begin, std::vector<std::size_t>(rows.size(), 1)};
    if (axis == Axis::worlds) return range;
    assert(axis == Axis::boxes || axis == Axis::samples);
    range.begin = axis == Axis::boxes ? rows.front().box_begin : rows.front().sample_begin;
    for (std::size_t i = 0; i < rows.size(); ++i)
      range.counts[i] = axis == Axis::boxes ? rows[i].boxes : rows[i].sample_count;
    return range;
  });
}

/// Reads what was found of consecutive layouts.
/// @param begin of the file
template <class Found>
Result<std::vector<Found>> read_layouts(ResultsReader& results, std::uint64_t begin, std::size_t count,
                                        Depth depth = Depth::rows) {
  return read_found<Found>(results, count, depth, [&](Axis axis) -> Result<EntryRange> {
    if (axis == Axis::layouts) return EntryRange{begin, std::vector<std::size_t>(count, 1)};
    return results.layout_boxes(begin, count);
  });
}

template <class Found>
std::vector<DatasetSpec> datasets_of() {
  std::vector<DatasetSpec> specs;
  Found::describe([&](const DatasetContent& content, auto member) {
    using Entry = EntryOfFound<Found, decltype(member)>;
    specs.push_back({content, element_type_of<Entry>(), width_of<Entry>()});
  });
  return specs;
}

template <class Found>
void append_found(ColumnSet& columns, const Findings& findings, bool series) {
  const auto& found = findings.value<Found>();
  Found::describe([&](const DatasetContent& content, auto member) {
    if (content.axis != Axis::samples || series) columns[content.path].append(found.*member);
  });
}

/// What the file has of an analysis of worlds.
template <class Found>
constexpr AnalysisTables tables_of_worlds(AnalysisTables tables) {
  tables.datasets = &datasets_of<Found>;
  tables.append_world = [](ColumnSet& columns, const WorldRecord& world, bool series) {
    append_found<Found>(columns, world.found, series);
  };
  tables.read_worlds = [](ResultsReader& results, std::uint64_t begin,
                          std::vector<WorldRecord>& worlds) -> std::optional<Error> {
    std::vector<WorldRow> rows;
    for (const WorldRecord& world : worlds) rows.push_back(world.row);
    Result<std::vector<Found>> found = read_worlds<Found>(results, begin, rows, Depth::boxes);
    if (!found) return found.error();
    for (std::size_t i = 0; i < worlds.size(); ++i)
      if (rows[i].stop_reason != StopReason::not_run) worlds[i].found.put(std::move((*found)[i]));
    return std::nullopt;
  };
  return tables;
}

/// What the file has of an analysis of layouts.
template <class Found>
constexpr AnalysisTables tables_of_layouts(AnalysisTables tables) {
  tables.datasets = &datasets_of<Found>;
  tables.append_layout = [](ColumnSet& columns, const LayoutRecord& layout) {
    append_found<Found>(columns, layout.found, false);
  };
  tables.read_layouts = [](ResultsReader& results, std::uint64_t begin,
                           std::vector<LayoutRecord>& layouts) -> std::optional<Error> {
    Result<std::vector<Found>> found = read_layouts<Found>(results, begin, layouts.size(), Depth::boxes);
    if (!found) return found.error();
    for (std::size_t i = 0; i < layouts.size(); ++i) layouts[i].found.put(std::move((*found)[i]));
    return std::nullopt;
  };
  return tables;
}

}  // namespace holdfast::internal
