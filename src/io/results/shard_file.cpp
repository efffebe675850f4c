#include "io/results/shard_file.hpp"

#include <fmt/format.h>

#include <array>
#include <cstring>
#include <utility>

#include "io/results/hdf5_file.hpp"
#include "io/results/results_inputs.hpp"
#include "io/results/results_part.hpp"

namespace holdfast::internal {

namespace {

/// Columns of 64-bit numbers that name entries of the file by their index, and the axis of these entries.
constexpr std::array<std::pair<std::string_view, Axis>, 6> kIndexColumns = {
    {{"/worlds/layout", Axis::layouts},
     {"/worlds/box_begin", Axis::boxes},
     {"/worlds/sample_begin", Axis::samples},
     {"/worlds/row_begin", Axis::rows},
     {"/boxes/world", Axis::worlds},
     {"/inputs/layouts/box_begin", Axis::layout_boxes}}};

/// Adds a number to each index in a column's stored form; modulo 2^64, so that it may be negative.
void shift(std::vector<std::byte>& stored, std::uint64_t by) {
  for (std::size_t place = 0; place + sizeof(std::uint64_t) <= stored.size(); place += sizeof(std::uint64_t)) {
    std::uint64_t index = 0;
    std::memcpy(&index, stored.data() + place, sizeof index);
    index += by;
    std::memcpy(stored.data() + place, &index, sizeof index);
  }
}

/// The first entry of a row of a table, from its column of first entries; at the end of the table, that of the axis.
std::uint64_t first_entry(const h5::File& file, std::string_view column, std::uint64_t row, Axis axis) {
  const h5::Dataset begins = h5::Dataset::open(file, dataset_spec(column));
  if (row == begins.length()) return h5::Dataset::open(file, representative(axis)).length();
  return values_of<std::uint64_t>(begins.read(row, 1)).at(0);
}

/// Entries of the file before a layout.
AxisCounts entries_before(const h5::File& file, std::uint64_t layout, std::uint64_t accelerations) {
  const std::uint64_t world = layout * accelerations;
  AxisCounts counts{};
  at(counts, Axis::layouts) = layout;
  at(counts, Axis::worlds) = world;
  at(counts, Axis::boxes) = first_entry(file, "/worlds/box_begin", world, Axis::boxes);
  at(counts, Axis::samples) = first_entry(file, "/worlds/sample_begin", world, Axis::samples);
  at(counts, Axis::rows) = first_entry(file, "/worlds/row_begin", world, Axis::rows);
  at(counts, Axis::layout_boxes) = first_entry(file, "/inputs/layouts/box_begin", layout, Axis::layout_boxes);
  return counts;
}

/// A part of a column of numbers.
template <class T>
std::vector<T> numbers(const h5::File& file, std::string_view path, std::uint64_t begin, std::uint64_t end) {
  return values_of<T>(h5::Dataset::open(file, dataset_spec(path)).read(begin, end - begin));
}

/// Fails unless the entries of every world and layout begin where those of the one before end.
void check_indices(const h5::File& file, const AxisCounts& first, const AxisCounts& last, std::uint64_t accelerations) {
  const auto check = [&](std::string_view path, std::uint64_t stored, std::uint64_t expected) {
    if (stored != expected)
      h5::fail(file.path(), "is damaged: " + std::string(path) + " does not follow from the counts",
               "simulate the shard again");
  };
  const std::uint64_t begin = at(first, Axis::worlds);
  const std::uint64_t end = at(last, Axis::worlds);
  const auto layout = numbers<std::uint64_t>(file, "/worlds/layout", begin, end);
  const auto box_begin = numbers<std::uint64_t>(file, "/worlds/box_begin", begin, end);
  const auto box_count = numbers<std::uint32_t>(file, "/worlds/box_count", begin, end);
  const auto sample_begin = numbers<std::uint64_t>(file, "/worlds/sample_begin", begin, end);
  const auto sample_count = numbers<std::uint32_t>(file, "/worlds/sample_count", begin, end);
  const auto row_begin = numbers<std::uint64_t>(file, "/worlds/row_begin", begin, end);
  const auto world = numbers<std::uint64_t>(file, "/boxes/world", at(first, Axis::boxes), at(last, Axis::boxes));
  AxisCounts next = first;
  for (std::size_t i = 0; i < layout.size(); ++i) {
    check("/worlds/layout", layout[i], (begin + i) / accelerations);
    check("/worlds/box_begin", box_begin[i], at(next, Axis::boxes));
    check("/worlds/sample_begin", sample_begin[i], at(next, Axis::samples));
    check("/worlds/row_begin", row_begin[i], at(next, Axis::rows));
    for (std::uint32_t box = 0; box < box_count[i]; ++box) {
      const std::uint64_t place = at(next, Axis::boxes) - at(first, Axis::boxes) + box;
      check("/boxes/world", place < world.size() ? world[place] : UINT64_MAX, begin + i);
    }
    at(next, Axis::boxes) += box_count[i];
    at(next, Axis::samples) += sample_count[i];
    at(next, Axis::rows) += std::uint64_t{sample_count[i]} * box_count[i];
  }
  const std::uint64_t first_layout = at(first, Axis::layouts);
  const std::uint64_t last_layout = at(last, Axis::layouts);
  const auto layout_begin = numbers<std::uint64_t>(file, "/inputs/layouts/box_begin", first_layout, last_layout);
  const auto layout_count = numbers<std::uint32_t>(file, "/inputs/layouts/box_count", first_layout, last_layout);
  for (std::size_t i = 0; i < layout_begin.size(); ++i) {
    check("/inputs/layouts/box_begin", layout_begin[i], at(next, Axis::layout_boxes));
    at(next, Axis::layout_boxes) += layout_count[i];
  }
  check("the length of /boxes", at(last, Axis::boxes), at(next, Axis::boxes));
  check("the number of samples", at(last, Axis::samples), at(next, Axis::samples));
  check("the number of rows", at(last, Axis::rows), at(next, Axis::rows));
  check("the number of boxes of layouts", at(last, Axis::layout_boxes), at(next, Axis::layout_boxes));
}

}  // namespace

std::string shards_folder(const std::string& results_path) { return results_path + ".shards"; }

std::string shard_path(const std::string& results_path, std::uint64_t part, std::uint64_t parts) {
  return fmt::format("{}/shard-{}-of-{}.h5", shards_folder(results_path), part, parts);
}

Result<ShardFile> ShardFile::open(const std::string& path) {
  return h5::caught_result(path, [&] {
    h5::be_quiet();
    const h5::File file = h5::File::open(path);
    if (h5::read_text_attribute(file, "/", "format") != kFormatName || !h5::has_attribute(file, "/", "shard"))
      h5::fail(path, "is no shard", "a results file of `holdfast screen --part K/N`");
    const std::uint64_t version = h5::read_count_attribute(file, "/", "format_version");
    if (version != kFormatVersion)
      h5::fail(path,
               fmt::format("has version {} of the format, and this program merges version {}", version, kFormatVersion),
               "simulate the shard again, or merge with the version that wrote it");
    ShardFile shard;
    shard.path_ = path;
    shard.run_ = read_run(file);
    const Shard& part = shard.shard().shard;
    if (part.part < 1 || part.part > part.parts || part.block < 1)
      h5::fail(path, "is damaged", "simulate the shard again");
    const h5::Dataset names = h5::Dataset::open(file, dataset_spec("/inputs/layouts/name"));
    std::uint64_t expected = 0;
    for (std::uint64_t block = part.part - 1; block < part.block_count(); block += part.parts)
      expected += std::min(part.block, part.layouts - block * part.block);
    const bool whole =
        h5::read_count_attribute(file, "/", "complete") == 1 && names.length() == expected &&
        h5::Dataset::open(file, representative(Axis::worlds)).length() == expected * shard.run_.accelerations.size();
    if (!whole) h5::fail(path, "does not have all of its layouts", "its command with --resume finishes it");
    shard.run_.layout_names = read_texts(file, "/inputs/layouts/name");
    shard.run_.layout_hashes = read_texts(file, "/inputs/layouts/sha256");
    shard.run_.record_series = h5::read_text_attribute(file, "/", "fingerprint").find(" series=1") != std::string::npos;
    return shard;
  });
}

Result<ColumnSet> ShardFile::read(std::uint64_t begin, std::uint64_t end, const AxisCounts& placed) const {
  return h5::caught_result(path_, [&] {
    h5::be_quiet();
    const h5::File file = h5::File::open(path_);
    const AxisCounts first = entries_before(file, begin, run_.accelerations.size());
    const AxisCounts last = entries_before(file, end, run_.accelerations.size());
    check_indices(file, first, last, run_.accelerations.size());
    ColumnSet columns;
    for (const DatasetSpec& spec : schema()) {
      if (spec.axis == Axis::accelerations || spec.axis == Axis::segments) continue;
      if (!includes(run_.analyses, spec)) continue;
      const h5::Dataset dataset = h5::Dataset::open(file, spec);
      std::vector<std::byte> stored = dataset.read(at(first, spec.axis), at(last, spec.axis) - at(first, spec.axis));
      for (const auto& [path, axis] : kIndexColumns)
        if (spec.path == path) shift(stored, at(placed, axis) - at(first, axis));
      columns[spec.path].append_stored(std::move(stored), dataset.number_bytes());
    }
    return columns;
  });
}

}  // namespace holdfast::internal
