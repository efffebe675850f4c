#include "io/results/results_assembler.hpp"

#include <atomic>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "io/export/table_writer.hpp"
#include "io/results/durable_file.hpp"
#include "io/results/results_columns.hpp"
#include "io/results/results_inputs.hpp"
#include "io/results/results_part.hpp"

namespace holdfast::internal {

namespace {

/// The finished parts.
class Parts {
 public:
  Parts(const std::string& path, const std::string& fingerprint, const std::atomic<bool>* stop)
      : path_(path), ranges_(check_parts(path, fingerprint)), stop_(stop) {}

  const std::vector<PartRange>& ranges() const { return ranges_; }
  AxisCounts end() const { return ranges_.empty() ? AxisCounts{} : ranges_.back().end; }

  /// Path of the part to read next; fails if the user has stopped the run.
  std::string path(std::size_t part) const {
    if (stop_ != nullptr && *stop_)
      throw h5::Failure(Error{.file = path_, .what = "is not complete: assembling was stopped"});
    return part_path(path_, part + 1);
  }
  /// Passes a part to a reader; a failure gets its cure. The last part stays open for the next reader: closing a file
  /// discards what HDF5 has cached of its columns, and most runs have one part.
  template <class Work>
  void with(std::size_t part, Work&& work) {
    const std::string file = path(part);
    h5::with_cure(kCureOfPart, [&] {
      if (!open_ || open_->path() != file) {
        open_.reset();
        open_.emplace(h5::File::open(file));
      }
      work(*open_);
    });
  }

  /// Removes the parts from the disk.
  void remove() {
    open_.reset();
    remove_parts(path_);
  }

 private:
  std::string path_;
  std::vector<PartRange> ranges_;
  std::optional<h5::File> open_;
  const std::atomic<bool>* stop_;
};

/// Changes the padding of texts from `from` bytes to `to` bytes each.
std::vector<std::byte> repad(std::span<const std::byte> stored, std::size_t from, std::size_t to) {
  std::vector<std::byte> padded(stored.size() / from * to);
  for (std::size_t i = 0; i * from < stored.size(); ++i)
    std::memcpy(padded.data() + i * to, stored.data() + i * from, from);
  return padded;
}

/// A part's entries of a table column, in their stored form.
struct Piece {
  std::vector<std::byte> stored;
  std::size_t number_bytes = 1;
};

Piece read_piece(const h5::File& source, const DatasetSpec& spec, const PartRange& range) {
  const h5::Dataset dataset = h5::Dataset::open(source, spec);
  if (dataset.length() != at(range.end, spec.axis) - at(range.begin, spec.axis))
    source.fail("has a column whose length differs from that of its table (" + std::string(spec.path) + ")");
  return {dataset.read(0, dataset.length()), dataset.number_bytes()};
}

void write_pieces(const h5::File& file, const DatasetSpec& spec, std::uint64_t length,
                  const std::vector<Piece>& pieces) {
  const bool text = spec.type == ElementType::text;
  std::size_t text_size = 1;
  for (const Piece& piece : pieces) text_size = std::max(text_size, piece.number_bytes);
  TableWriter writer(file, spec, length, text_size);
  for (const Piece& piece : pieces)
    writer.append(text ? repad(piece.stored, piece.number_bytes, text_size) : piece.stored);
  writer.finish();
}

/// Datasets that are the same for all parts; they come from the description of the run.
bool is_of_run(const DatasetSpec& spec) { return spec.axis == Axis::accelerations || spec.axis == Axis::segments; }

/// Short columns that are read together and written one after the other: finding a column in a file takes longer than
/// reading a small one, and there may be thousands of parts.
class TableGroup {
 public:
  /// False if the group would need too much memory with this column.
  bool take(const DatasetSpec& spec, const Parts& parts) {
    constexpr std::uint64_t kMostBytes = std::uint64_t{16} << 20U;
    constexpr std::uint64_t kTextBytes = 64;  // approximate
    const std::uint64_t entry_bytes = (spec.type == ElementType::text ? kTextBytes : size_of(spec.type)) * spec.width;
    bytes_ += at(parts.end(), spec.axis) * entry_bytes;
    if (!specs_.empty() && bytes_ > kMostBytes) return false;
    specs_.push_back(&spec);
    return true;
  }

  void assemble(const h5::File& file, Parts& parts) const {
    std::vector<std::vector<Piece>> columns(specs_.size());
    for (std::size_t part = 0; part < parts.ranges().size(); ++part) {
      parts.with(part, [&](const h5::File& source) {
        for (std::size_t i = 0; i < specs_.size(); ++i)
          columns[i].push_back(read_piece(source, *specs_[i], parts.ranges()[part]));
      });
    }
    for (std::size_t i = 0; i < specs_.size(); ++i)
      write_pieces(file, *specs_[i], at(parts.end(), specs_[i]->axis), std::exchange(columns[i], {}));
  }

 private:
  std::vector<const DatasetSpec*> specs_;
  std::uint64_t bytes_ = 0;
};

/// Positions of the chunks of the long datasets in the parts: by dataset, then by part. 16 bytes per chunk.
using ChunkPlaces = std::vector<std::vector<std::vector<h5::ChunkPlace>>>;

/// The long datasets of a run, by their index among all.
std::vector<std::size_t> long_columns_of(const RunDescription& run) {
  std::vector<std::size_t> columns;
  for (std::size_t column = 0; column < long_datasets().size(); ++column)
    if (includes(run.analyses, schema()[long_datasets()[column]])) columns.push_back(column);
  return columns;
}

/// The chunk at the boundary of two parts is in both; in the later one it is complete.
ChunkPlaces find_chunks(const std::vector<std::size_t>& columns, Parts& parts) {
  ChunkPlaces places(long_datasets().size());
  const auto& ranges = parts.ranges();
  for (std::size_t part = 0; part < ranges.size(); ++part) {
    parts.with(part, [&](const h5::File& source) {
      for (const std::size_t column : columns) {
        const DatasetSpec& spec = schema()[long_datasets()[column]];
        const std::uint64_t entries = chunk_entries(spec.axis);
        const std::uint64_t begin = at(ranges[part].begin, spec.axis) / entries;
        const std::uint64_t end = part + 1 < ranges.size() ? at(ranges[part + 1].begin, spec.axis) / entries
                                                           : (at(ranges[part].end, spec.axis) + entries - 1) / entries;
        std::vector<h5::ChunkPlace>& found = places[column].emplace_back();
        if (begin == end) continue;
        const h5::Dataset dataset = h5::Dataset::open(source, spec);
        for (std::uint64_t chunk = begin; chunk < end; ++chunk) found.push_back(dataset.chunk_place(chunk - begin));
      }
    });
  }
  return places;
}

/// Copies compressed chunks without changing them.
void copy_chunks(const h5::File& file, const DatasetSpec& spec, const Parts& parts,
                 const std::vector<std::vector<h5::ChunkPlace>>& places) {
  h5::Dataset target = h5::Dataset::create(file, spec, at(parts.end(), spec.axis), 1);
  std::uint64_t chunk = 0;
  for (std::size_t part = 0; part < places.size(); ++part) {
    if (places[part].empty()) continue;
    const BytesOfFile source(parts.path(part));
    for (const h5::ChunkPlace& place : places[part]) target.write_chunk(chunk++, source.read(place.begin, place.bytes));
  }
}

void assemble_tables(const h5::File& file, const RunDescription& run, Parts& parts) {
  TableGroup tables;
  for (const DatasetSpec& spec : schema()) {
    if (is_long(spec) || is_of_run(spec) || !includes(run.analyses, spec)) continue;
    if (tables.take(spec, parts)) continue;
    std::exchange(tables, {}).assemble(file, parts);
    tables.take(spec, parts);
  }
  tables.assemble(file, parts);
}

/// Writes the datasets in a fixed order, so that the bytes of the file do not depend on where parts end.
void assemble_datasets(const h5::File& file, const RunDescription& run, Parts& parts) {
  ColumnSet of_run;
  append_accelerations(of_run, run.accelerations);
  for (const Column& column : of_run.columns())
    if (is_of_run(column.spec())) write_column(file, column);
  assemble_tables(file, run, parts);
  const std::vector<std::size_t> columns = long_columns_of(run);
  const ChunkPlaces places = find_chunks(columns, parts);
  for (const std::size_t column : columns) copy_chunks(file, schema()[long_datasets()[column]], parts, places[column]);
}

void check_whole(const std::string& path, const RunDescription& run, const Parts& parts) {
  const std::uint64_t expected = run.layout_names.size() * run.accelerations.size();
  const std::uint64_t found = at(parts.end(), Axis::worlds);
  if (found == expected) return;
  throw h5::Failure(Error{.file = parts_folder(path),
                          .what = "does not have all worlds of the run",
                          .value = std::to_string(found) + " of " + std::to_string(expected),
                          .accepted = "--resume simulates the missing ones"});
}

void write_file(h5::File& file, const RunDescription& run, Parts& parts) {
  write_run(file, run);
  write_range_begin(file, AxisCounts{});
  assemble_datasets(file, run, parts);
  // Last, so that only a complete file has it.
  h5::write_attribute(file, "/", "complete", std::uint64_t{1});
  file.close();
}

}  // namespace

std::optional<Error> assemble(const std::string& path, const RunDescription& run, const std::atomic<bool>* stop) {
  const std::string temporary = temporary_name(path);
  const auto error = h5::caught(path, [&] {
    Parts parts(path, fingerprint(run), stop);
    check_whole(path, run, parts);
    h5::File file = h5::File::create(temporary);
    write_file(file, run, parts);
    commit_temporary(path);
    parts.remove();
  });
  std::error_code ignored;
  if (error) std::filesystem::remove(temporary, ignored);
  return error;
}

}  // namespace holdfast::internal
