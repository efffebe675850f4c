#include "io/results/results_part.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>

#include "io/results/durable_file.hpp"
#include "io/results/run_description.hpp"

namespace holdfast::internal {

namespace {

std::string attribute_of(Axis axis) { return std::string(to_string(axis)) + "_begin"; }

void check_follows(const std::string& path, const PartRange& before, const PartRange& part) {
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    const auto axis = static_cast<Axis>(i);
    if (axis == Axis::accelerations || axis == Axis::segments) continue;
    const std::uint64_t expected = is_long(representative(axis)) ? chunk_begin(axis, before.end[i]) : before.end[i];
    if (part.begin[i] != expected || part.end[i] < before.end[i])
      h5::fail(path, "does not continue where the previous part ends (" + std::string(to_string(axis)) + ")");
  }
}

/// Chunks are copied unchanged: without this check, a wrong size would be noticed only after hours of simulation.
void check_chunks(const h5::File& file) {
  for (const Axis axis : kLongAxes)
    if (h5::Dataset::open(file, representative(axis)).chunk_entries() != chunk_entries(axis))
      file.fail("has a dataset of a wrong chunk size (" + std::string(representative(axis).path) + ")");
}

}  // namespace

std::string parts_folder(const std::string& results_path) { return results_path + ".parts"; }

std::string part_path(const std::string& results_path, std::uint64_t number) {
  return fmt::format("{}/part-{:06}.h5", parts_folder(results_path), number);
}

std::vector<std::uint64_t> list_parts(const std::string& results_path) {
  std::vector<std::uint64_t> numbers;
  const std::string folder = parts_folder(results_path);
  if (!std::filesystem::exists(folder)) return numbers;
  constexpr std::string_view kPrefix = "part-";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(kPrefix) || entry.path().extension() != ".h5") continue;
    std::uint64_t number = 0;
    std::from_chars(name.data() + kPrefix.size(), name.data() + name.size(), number);
    if (entry.path().string() == part_path(results_path, number)) numbers.push_back(number);
  }
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

void remove_parts(const std::string& results_path) {
  for (const std::uint64_t number : list_parts(results_path)) std::filesystem::remove(part_path(results_path, number));
  std::error_code not_empty;
  std::filesystem::remove(parts_folder(results_path), not_empty);
}

void remove_temporaries(const std::string& results_path) {
  std::filesystem::remove(temporary_name(results_path));
  if (!std::filesystem::exists(parts_folder(results_path))) return;
  std::vector<std::filesystem::path> stale;
  for (const auto& entry : std::filesystem::directory_iterator(parts_folder(results_path)))
    if (entry.path().extension() == ".tmp") stale.push_back(entry.path());
  for (const auto& file : stale) std::filesystem::remove(file);
}

void write_range_begin(const h5::File& file, const AxisCounts& begin) {
  for (std::size_t i = 0; i < kAxisCount; ++i)
    h5::write_attribute(file, "/", attribute_of(static_cast<Axis>(i)), begin[i]);
}

AxisCounts read_range_begin(const h5::File& file) {
  AxisCounts begin{};
  for (std::size_t i = 0; i < kAxisCount; ++i)
    begin[i] = h5::read_count_attribute(file, "/", attribute_of(static_cast<Axis>(i)));
  return begin;
}

PartRange read_range(const h5::File& file) {
  PartRange range{read_range_begin(file)};
  for (std::size_t i = 0; i < kAxisCount; ++i)
    range.end[i] = range.begin[i] + h5::Dataset::open(file, representative(static_cast<Axis>(i))).length();
  return range;
}

void check_same_run(const h5::File& file, const std::string& fingerprint) {
  const auto text = [&](const char* attribute) { return h5::read_text_attribute(file, "/", attribute); };
  const std::string difference = fingerprint_difference(text("fingerprint"), fingerprint);
  if (difference.empty()) return;
  throw h5::Failure(Error{.file = file.path(),
                          .what = "is of a run with other " + difference,
                          .value = "by " + printable(text("software") + ", commit " + text("git_commit")),
                          .accepted = "the same inputs and version can resume it, --overwrite starts anew"});
}

std::vector<PartRange> check_parts(const std::string& results_path, const std::string& fingerprint) {
  std::vector<PartRange> ranges;
  for (const std::uint64_t number : list_parts(results_path)) {
    const std::string path = part_path(results_path, number);
    if (number != ranges.size() + 1) {
      h5::fail(part_path(results_path, ranges.size() + 1), "is missing, although later parts exist",
               "remove " + parts_folder(results_path) + " to start anew");
    }
    ranges.push_back(h5::with_cure(kCureOfPart, [&] {
      const h5::File file = h5::File::open(path);
      check_same_run(file, fingerprint);
      const PartRange range = read_range(file);
      check_chunks(file);
      check_follows(path, ranges.empty() ? PartRange{} : ranges.back(), range);
      return range;
    }));
  }
  return ranges;
}

}  // namespace holdfast::internal
