#include "io/results_resume.hpp"

#include <filesystem>

#include "io/hdf5_file.hpp"
#include "io/results_columns.hpp"
#include "io/results_part.hpp"
#include "io/run_description.hpp"

namespace holdfast {

namespace {

std::vector<std::string> read_texts(const h5::File& file, std::string_view path) {
  const h5::Dataset dataset = h5::Dataset::open(file, dataset_spec(path));
  return texts_of(dataset.read(0, dataset.length()), dataset.number_bytes());
}

void append_layouts(const h5::File& file, Progress& progress) {
  const std::vector<std::string> names = read_texts(file, "/inputs/layouts/name");
  const std::vector<std::string> hashes = read_texts(file, "/inputs/layouts/sha256");
  if (names.size() != hashes.size()) file.fail("has columns of different length under /inputs/layouts");
  for (std::size_t i = 0; i < names.size(); ++i) progress.layouts.emplace_back(names[i], hashes[i]);
}

void add_counts(const PartRange& range, Progress& progress) {
  progress.world_count = at(range.end, Axis::worlds);
  progress.box_count = at(range.end, Axis::boxes);
  progress.sample_count = at(range.end, Axis::samples);
  progress.row_count = at(range.end, Axis::rows);
  progress.layout_box_count = at(range.end, Axis::layout_boxes);
}

Progress progress_of_finished_file(const std::string& path, const std::string& fingerprint) {
  const h5::File file = h5::File::open(path);
  const std::string difference = fingerprint_difference(h5::read_text_attribute(file, "/", "fingerprint"), fingerprint);
  if (!difference.empty()) {
    throw h5::Failure(Error{.file = path,
                            .what = "is the results file of a run with other inputs (" + difference + " differ)",
                            .accepted = "the same inputs, or another results file"});
  }
  Progress progress{.complete = true};
  add_counts(read_range(file), progress);
  append_layouts(file, progress);
  return progress;
}

}  // namespace

Result<Progress> find_finished(const std::string& path, const std::string& fingerprint) {
  return h5::caught_result(path, [&] {
    remove_temporaries(path);
    if (std::filesystem::exists(path)) {
      Progress progress = progress_of_finished_file(path, fingerprint);
      remove_parts(path);  // a run that was killed after assembling did not come to it
      return progress;
    }
    Progress progress;
    for (const PartRange& range : check_parts(path, fingerprint)) {
      add_counts(range, progress);
      append_layouts(h5::File::open(part_path(path, ++progress.part_count)), progress);
    }
    return progress;
  });
}

}  // namespace holdfast
