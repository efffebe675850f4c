#include "io/export/summary_tables.hpp"

#include <filesystem>
#include <map>

#include "io/export/table_writer.hpp"
#include "io/results/durable_file.hpp"
#include "io/results/results_columns.hpp"
#include "io/results/results_inputs.hpp"

namespace holdfast::internal {

namespace {

/// The datasets that identify the world and the box of each row of the summary.
constexpr std::array<std::string_view, 10> kNamingDatasets = {
    "/inputs/layouts/name", "/inputs/accelerations/name", "/worlds/layout",    "/worlds/acceleration", "/worlds/status",
    "/worlds/status_text",  "/worlds/box_begin",          "/worlds/box_count", "/boxes/world",         "/boxes/id"};

/// Copies a dataset in slices.
void copy_dataset(const h5::File& from, const h5::File& to, const DatasetSpec& spec) {
  const h5::Dataset source = h5::Dataset::open(from, spec);
  TableWriter writer(to, spec, source.length(), source.number_bytes());
  const std::uint64_t step = source.chunk_entries();
  for (std::uint64_t begin = 0; begin < source.length(); begin += step)
    writer.append(source.read(begin, std::min(step, source.length() - begin)));
  writer.finish();
}

void write_file(const h5::File& source, const std::string& path, const Thresholds& thresholds) {
  Result<ResultsReader> results = ResultsReader::attach(source);
  if (!results) throw h5::Failure(results.error());
  const ResultsInfo& info = results->info();
  if (!info.complete)
    throw h5::Failure(
        Error{.file = source.path(), .what = "is a part of an unfinished run", .accepted = "a complete results file"});
  h5::File file = h5::File::create(temporary_name(path));
  h5::write_attribute(file, "/", "format", std::string_view("holdfast summary"));
  h5::write_attribute(file, "/", "format_version", kFormatVersion);
  h5::write_attribute(file, "/", "source", source.path());
  h5::write_attribute(file, "/", "source_fingerprint", info.fingerprint);
  h5::write_attribute(file, "/", "source_created_utc", info.created_utc);
  h5::write_attribute(file, "/", "software", info.software);
  h5::write_attribute(file, "/", "engine", info.engine);
  for (const std::string_view name : kNamingDatasets) copy_dataset(source, file, dataset_spec(name));
  write_thresholds(file, thresholds);
  h5::write_attribute(file, "/summary", "judged", std::string_view(info.judged_at_end() ? "at the end" : "by peaks"));
  write_summary_tables(file, *results, thresholds);
  file.close();
  commit_temporary(path);
}

}  // namespace

void write_summary_tables(const h5::File& file, ResultsReader& results, const Thresholds& thresholds) {
  std::map<std::string_view, TableWriter> writers;
  for (const DatasetSpec& spec : schema()) {
    if (spec.origin != Origin::derived) continue;
    const ResultsInfo& info = results.info();
    writers.emplace(spec.path, TableWriter(file, spec, spec.axis == Axis::worlds ? info.world_count : info.box_count));
  }
  const auto append_of = [&](const auto& rows) {
    return [&](const OutcomeField& field, auto member) {
      Column column(dataset_spec(field.dataset));
      column.append(rows, member);
      writers.at(field.dataset).append(column.take());
    };
  };
  const auto error = derive_summary(results, thresholds, [&](const SummarySlice& slice) -> std::optional<Error> {
    return h5::caught(file.path(), [&] {
      visit_world_verdict<WorldVerdict>(append_of(slice.worlds));
      visit_box_verdict<BoxVerdict>(append_of(slice.boxes));
    });
  });
  if (error) throw h5::Failure(*error);
  for (auto& [path, writer] : writers) writer.finish();
}

std::optional<Error> write_summary(const std::string& results_path, const Thresholds& thresholds,
                                   const std::string& path) {
  const auto error = h5::caught(path, [&] {
    if (std::filesystem::exists(path)) {
      throw h5::Failure(Error{.file = path, .what = "exists already", .accepted = "the name of a new file"});
    }
    write_file(h5::File::open(results_path), path, thresholds);
  });
  std::error_code ignored;
  if (error) std::filesystem::remove(temporary_name(path), ignored);
  return error;
}

}  // namespace holdfast::internal
