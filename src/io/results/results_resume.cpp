#include "io/results/results_resume.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "io/results/hdf5_file.hpp"
#include "io/results/load_names.hpp"
#include "io/results/results_columns.hpp"
#include "io/results/results_inputs.hpp"
#include "io/results/results_part.hpp"
#include "io/results/results_reader.hpp"
#include "io/results/run_description.hpp"

namespace holdfast::internal {

namespace {

void add_counts(const PartRange& range, Progress& progress) {
  progress.world_count = at(range.end, Axis::worlds);
  progress.box_count = at(range.end, Axis::boxes);
  progress.sample_count = at(range.end, Axis::samples);
  progress.row_count = at(range.end, Axis::rows);
  progress.layout_count = at(range.end, Axis::layouts);
  progress.layout_box_count = at(range.end, Axis::layout_boxes);
}

/// The hashes of all layouts, from the first part; those in the other parts must be the same.
void take_hashes(const h5::File& part, const PartRange& range, Progress& progress) {
  if (progress.part_count == 1) progress.layout_hashes = read_layout_hashes(part);
  const std::vector<std::string>& all = progress.layout_hashes;
  const std::vector<std::string> own = read_texts(part, "/inputs/layouts/sha256");
  const std::uint64_t begin = at(range.begin, Axis::layouts);
  if (begin > all.size() || own.size() > all.size() - begin ||
      !std::equal(own.begin(), own.end(), all.begin() + static_cast<std::ptrdiff_t>(begin)))
    throw h5::Failure(Error{.file = part.path(), .what = "is damaged: its layouts are not those of the run"});
}

Progress progress_of_finished_file(const std::string& path, const std::string& fingerprint) {
  const h5::File file = h5::File::open(path);
  check_same_run(file, fingerprint);
  Progress progress{.complete = true};
  add_counts(read_range(file), progress);
  progress.layout_hashes = read_texts(file, "/inputs/layouts/sha256");
  return progress;
}

void fail_if(const std::optional<Error>& error) {
  if (error) throw h5::Failure(*error);
}

/// Whether the file has analyses of layouts.
bool has_layouts(const RunTables& tables) {
  return std::any_of(tables.begin(), tables.end(), [](const AnalysisTables* table) { return table->read_layouts; });
}

void visit_layouts(ResultsReader& results, const FinishedVisitor& visitor) {
  const ResultsInfo& info = results.info();
  LoadNames names(results);
  std::vector<LayoutRecord> layouts;
  for (std::size_t i = 0; i < info.layouts.size(); ++i) {
    auto layout = std::make_shared<Layout>(Layout{.name = info.layouts[i]});
    for (const std::string& name : names.box_names(info.layout_begin + i)) layout->boxes.emplace_back().name = name;
    layouts.push_back({info.layout_begin + i, std::move(layout), {}});
    if (visitor.layout_begins) visitor.layout_begins(layouts.back());
  }
  if (!has_layouts(info.analyses) || !visitor.layout) return;
  for (const AnalysisTables* analysis : info.analyses)
    if (analysis->read_layouts != nullptr) fail_if(analysis->read_layouts(results, 0, layouts));
  for (const LayoutRecord& layout : layouts) visitor.layout(layout);
}

void visit_file(const std::string& path, const FinishedVisitor& visitor) {
  Result<ResultsReader> results = ResultsReader::open(path);
  if (!results) throw h5::Failure(results.error());
  const ResultsInfo& info = results->info();
  if (visitor.layout_begins || visitor.layout) visit_layouts(*results, visitor);
  for (std::uint64_t begin = 0; begin < info.world_count; begin += kSliceWorlds) {
    Result<std::vector<WorldRow>> rows = results->worlds(begin, std::min(kSliceWorlds, info.world_count - begin));
    if (!rows) throw h5::Failure(rows.error());
    std::vector<WorldRecord> worlds(rows->size());
    for (std::size_t i = 0; i < worlds.size(); ++i) {
      worlds[i].row = std::move((*rows)[i]);
      Result<EndTable> end = results->ends(worlds[i].row.box_begin, worlds[i].row.boxes);
      if (!end) throw h5::Failure(end.error());
      worlds[i].end = std::move(*end);
    }
    for (const AnalysisTables* analysis : info.analyses)
      if (analysis->read_worlds != nullptr) fail_if(analysis->read_worlds(*results, begin, worlds));
    for (const WorldRecord& world : worlds) visitor.world(world);
  }
}

}  // namespace

std::optional<Error> visit_finished(const std::string& path, const Progress& progress, const FinishedVisitor& visitor) {
  return h5::caught(path, [&] {
    if (progress.complete) return visit_file(path, visitor);
    for (std::uint64_t part = 1; part <= progress.part_count; ++part)
      h5::with_cure(kCureOfPart, [&] { visit_file(part_path(path, part), visitor); });
  });
}

Result<Progress> find_finished(const std::string& path, const std::string& fingerprint) {
  return h5::caught_result(path, [&] {
    remove_temporaries(path);
    if (std::filesystem::exists(path)) {
      Progress progress =
          h5::with_cure("--overwrite starts anew", [&] { return progress_of_finished_file(path, fingerprint); });
      remove_parts(path);  // the run may have been killed between assembling and removing them
      return progress;
    }
    Progress progress;
    for (const PartRange& range : check_parts(path, fingerprint)) {
      add_counts(range, progress);
      ++progress.part_count;
      h5::with_cure(kCureOfPart,
                    [&] { take_hashes(h5::File::open(part_path(path, progress.part_count)), range, progress); });
    }
    return progress;
  });
}

}  // namespace holdfast::internal
