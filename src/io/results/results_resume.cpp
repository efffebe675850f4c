#include "io/results/results_resume.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "io/results/hdf5_file.hpp"
#include "io/results/results_columns.hpp"
#include "io/results/results_inputs.hpp"
#include "io/results/results_part.hpp"
#include "io/results/results_reader.hpp"
#include "io/results/run_description.hpp"

namespace holdfast::internal {

namespace {

std::vector<std::string> read_texts(const h5::File& file, std::string_view path) {
  const h5::Dataset dataset = h5::Dataset::open(file, dataset_spec(path));
  return texts_of(dataset.read(0, dataset.length()), dataset.number_bytes());
}

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

WorldRecord record_of(const WorldRow& row, EndTable&& end) {
  WorldRecord world;
  world.layout = row.layout;
  world.acceleration = row.acceleration;
  world.outcome.status = row.status;
  world.outcome.stop_reason = row.stop_reason;
  world.outcome.end_time = row.end_time;
  world.outcome.counters = {row.steps,        row.steps_skipped,  row.solve_iterations,
                            row.max_residual, row.residual_scale, row.max_penetration};
  world.status_text = row.status_text;
  world.cpu_seconds = row.cpu_seconds;
  world.peak_total_kinetic_energy = row.peak_total_kinetic_energy;
  world.state_hash = row.state_hash;
  world.end = std::move(end);
  return world;
}

WorldDamage damage_of(ResultsReader& results, const WorldRow& row, std::uint32_t boxes_beyond) {
  Result<BoxDamage> boxes = results.box_damage(row.box_begin, row.box_count);
  if (!boxes) throw h5::Failure(boxes.error());
  return {boxes_beyond, std::move(*boxes)};
}

void visit_layouts(ResultsReader& results, const std::function<void(const LayoutRecord&)>& visit) {
  const ResultsInfo& info = results.info();
  std::vector<LayoutMargins> margins(info.layouts.size());
  if (info.has_margins) {
    auto read = results.margins(0, info.layouts.size());
    if (!read) throw h5::Failure(read.error());
    margins = std::move(*read);
  }
  std::vector<LayoutIndicators> indicators(info.layouts.size());
  if (info.has_indicators) {
    auto read = results.indicators(0, info.layouts.size());
    if (!read) throw h5::Failure(read.error());
    indicators = std::move(*read);
  }
  for (std::size_t i = 0; i < info.layouts.size(); ++i)
    visit(
        {info.layout_begin + i, std::make_shared<Layout>(Layout{.name = info.layouts[i]}), margins[i], indicators[i]});
}

void visit_file(const std::string& path, const FinishedVisitor& visitor) {
  Result<ResultsReader> results = ResultsReader::open(path);
  if (!results) throw h5::Failure(results.error());
  const bool has_layouts = results->info().has_margins || results->info().has_indicators;
  if (has_layouts && visitor.layout) visit_layouts(*results, visitor.layout);
  const std::uint64_t count = results->info().world_count;
  for (std::uint64_t begin = 0; begin < count; begin += kSliceWorlds) {
    const auto rows = results->worlds(begin, std::min(kSliceWorlds, count - begin));
    if (!rows) throw h5::Failure(rows.error());
    std::vector<WallForces> walls(rows->size());
    if (results->info().has_walls) {
      Result<std::vector<WallForces>> read = results->walls(begin, rows->size());
      if (!read) throw h5::Failure(read.error());
      walls = std::move(*read);
    }
    std::vector<ReplicaOutcome> replicas(rows->size());
    if (results->info().has_replicas) {
      auto read = results->replicas(begin, rows->size());
      if (!read) throw h5::Failure(read.error());
      replicas = std::move(*read);
    }
    std::vector<std::uint32_t> beyond;
    if (results->info().has_damage) {
      auto read = results->boxes_beyond(begin, rows->size());
      if (!read) throw h5::Failure(read.error());
      beyond = std::move(*read);
    }
    for (std::size_t i = 0; i < rows->size(); ++i) {
      const WorldRow& row = (*rows)[i];
      Result<EndTable> end = results->ends(row.box_begin, row.box_count);
      if (!end) throw h5::Failure(end.error());
      WorldRecord world = record_of(row, std::move(*end));
      world.walls = walls[i];
      world.replicas = std::move(replicas[i]);
      if (!beyond.empty()) world.damage = damage_of(*results, row, beyond[i]);
      visitor.world(world);
    }
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
