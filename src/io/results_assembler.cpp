#include "io/results_assembler.hpp"

#include <atomic>
#include <filesystem>
#include <memory>
#include <vector>

#include "io/durable_file.hpp"
#include "io/results_columns.hpp"
#include "io/results_inputs.hpp"
#include "io/results_part.hpp"
#include "io/summary_tables.hpp"
#include "io/table_writer.hpp"

namespace holdfast {

namespace {

/// The finished parts, opened when needed; so many are kept open that usually each is opened once.
class Parts {
 public:
  Parts(const std::string& path, const std::string& fingerprint, const std::atomic<bool>* stop)
      : path_(path), ranges_(check_parts(path, fingerprint)), kept_(ranges_.size()), stop_(stop) {}

  const std::vector<PartRange>& ranges() const { return ranges_; }
  AxisCounts end() const { return ranges_.empty() ? AxisCounts{} : ranges_.back().end; }

  std::shared_ptr<h5::File> open(std::size_t part) {
    if (kept_[part]) return kept_[part];
    auto file = std::make_shared<h5::File>(h5::File::open(part_path(path_, part + 1)));
    constexpr std::size_t kMostKept = 64;
    if (part < kMostKept) kept_[part] = file;
    return file;
  }

  /// Fails when the user wants no more.
  void check_stop() const {
    if (stop_ != nullptr && *stop_) throw h5::Failure(Error{.file = path_, .what = "is not finished: stopped"});
  }

  /// Removes them from the disk.
  void remove() {
    kept_.clear();
    remove_parts(path_);
  }

 private:
  std::string path_;
  std::vector<PartRange> ranges_;
  std::vector<std::shared_ptr<h5::File>> kept_;
  const std::atomic<bool>* stop_;
};

/// Makes indices that count from the part's first entry count from the run's.
void shift_indices(std::vector<std::byte>& stored, std::uint64_t begin) {
  std::vector<std::uint64_t> indices = values_of<std::uint64_t>(stored);
  for (std::uint64_t& index : indices) index += begin;
  if (!indices.empty()) std::memcpy(stored.data(), indices.data(), stored.size());
}

/// Texts padded to `from` bytes each, padded to `to` instead.
std::vector<std::byte> repad(std::span<const std::byte> stored, std::size_t from, std::size_t to) {
  std::vector<std::byte> padded(stored.size() / from * to);
  for (std::size_t i = 0; i * from < stored.size(); ++i)
    std::memcpy(padded.data() + i * to, stored.data() + i * from, from);
  return padded;
}

void assemble_table(const h5::File& file, const DatasetSpec& spec, Parts& parts) {
  const bool text = spec.type == ElementType::text;
  std::size_t text_size = 1;
  for (std::size_t part = 0; text && part < parts.ranges().size(); ++part)
    text_size = std::max(text_size, h5::Dataset::open(*parts.open(part), spec).number_bytes());

  TableWriter writer(file, spec, at(parts.end(), spec.axis), text_size);
  for (std::size_t part = 0; part < parts.ranges().size(); ++part) {
    parts.check_stop();
    const auto source = parts.open(part);
    const h5::Dataset dataset = h5::Dataset::open(*source, spec);
    if (dataset.length() != at(parts.ranges()[part].end, spec.axis) - at(parts.ranges()[part].begin, spec.axis))
      source->fail("has a column of another length than its table (" + std::string(spec.path) + ")");
    std::vector<std::byte> stored = dataset.read(0, dataset.length());
    if (spec.refers_to != spec.axis) shift_indices(stored, at(parts.ranges()[part].begin, spec.refers_to));
    if (text) stored = repad(stored, dataset.number_bytes(), text_size);
    writer.append(stored);
  }
  writer.finish();
}

/// Copies compressed chunks as they are. The chunk at a cut is in both parts; the later one has all of it.
void assemble_series(const h5::File& file, const DatasetSpec& spec, Parts& parts) {
  const auto& ranges = parts.ranges();
  h5::Dataset target = h5::Dataset::create(file, spec, at(parts.end(), spec.axis), 1);
  for (std::size_t part = 0; part < ranges.size(); ++part) {
    const std::uint64_t begin = at(ranges[part].begin, spec.axis) / kChunkEntries;
    const std::uint64_t end = part + 1 < ranges.size()
                                  ? at(ranges[part + 1].begin, spec.axis) / kChunkEntries
                                  : (at(ranges[part].end, spec.axis) + kChunkEntries - 1) / kChunkEntries;
    if (begin == end) continue;
    const auto source = parts.open(part);
    const h5::Dataset dataset = h5::Dataset::open(*source, spec);
    for (std::uint64_t chunk = begin; chunk < end; ++chunk) {
      parts.check_stop();
      target.write_chunk(chunk, dataset.read_chunk(chunk - begin));
    }
  }
}

void assemble_recorded(const h5::File& file, const RunDescription& run, Parts& parts) {
  ColumnSet of_run;
  append_accelerations(of_run, run.accelerations);
  for (const DatasetSpec& spec : kSchema) {
    if (spec.origin == Origin::derived) continue;
    if (spec.axis == Axis::accelerations || spec.axis == Axis::segments) {
      write_column(file, of_run[spec.path]);
    } else if (is_series(spec)) {
      assemble_series(file, spec, parts);
    } else {
      assemble_table(file, spec, parts);
    }
  }
}

void check_whole(const std::string& path, const RunDescription& run, const Parts& parts) {
  const std::uint64_t expected = run.layout_names.size() * run.accelerations.size();
  const std::uint64_t found = at(parts.end(), Axis::worlds);
  if (found == expected) return;
  throw h5::Failure(Error{.file = parts_folder(path),
                          .what = "does not hold all worlds of the run",
                          .value = std::to_string(found) + " of " + std::to_string(expected),
                          .accepted = "--resume simulates the missing ones"});
}

void write_file(h5::File& file, const RunDescription& run, Parts& parts) {
  write_run(file, run);
  write_range_begin(file, AxisCounts{});
  assemble_recorded(file, run, parts);
  {
    Result<ResultsReader> results = ResultsReader::attach(file);
    if (!results) throw h5::Failure(results.error());
    write_summary_tables(file, *results, run.thresholds);
  }
  // Last, so that a file has it only when all the rest is there.
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

}  // namespace holdfast
