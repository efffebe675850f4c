#include "io/results/summary.hpp"

#include <algorithm>
#include <cmath>

#include "io/results/hdf5_file.hpp"
#include "io/results/results_columns.hpp"
#include "io/results/results_fixture.hpp"

namespace summary_test {

using namespace results_fixture;

namespace {

template <class T>
std::vector<T> read_column(const std::string& path, std::string_view name) {
  const h5::File file = h5::File::open(path);
  const h5::Dataset dataset = h5::Dataset::open(file, dataset_spec(name));
  return values_of<T>(dataset.read(0, dataset.length()));
}

/// Fallen boxes of every simulated world, counted from the records.
std::vector<std::uint32_t> count_fallen(const Run& run, double drop) {
  std::vector<std::uint32_t> counts;
  for (const UnitRecord& unit : run.units)
    for (const WorldRecord& world : unit.worlds) {
      counts.push_back(world.row.stop_reason == StopReason::not_run ? kNotCounted : 0);
      for (const float peak : world.end.peak_drop) counts.back() += static_cast<double>(peak) > drop ? 1 : 0;
    }
  return counts;
}

}  // namespace

TEST_CASE("summary: fallen boxes are those of the records, with and without series", "[io][results]") {
  const Run run = make_run(mixed_shapes(), GENERATE(true, false));
  const Folder folder;
  const std::string path = folder / "results.h5";
  write_run_to(path, run, every_unit());
  CHECK(read_column<std::uint32_t>(path, "/summary/worlds/fallen_boxes") == count_fallen(run, 0.05));
}

TEST_CASE("summary: the time beyond a limit is by the limits of the run, and not known by others", "[io][results]") {
  const Run run = make_run({{2, 4}});
  const Folder folder;
  const std::string path = folder / "results.h5";
  write_run_to(path, run, never());
  CHECK(read_column<float>(path, "/summary/boxes/first_beyond") == std::vector<float>{0.0F, 0.1F, 0.0F, 0.1F});
  require_ok(write_summary(path, {.drop = 0.15, .move = 0.3, .tilt = 5}, folder / "other.h5"));
  for (const float time : read_column<float>(folder / "other.h5", "/summary/boxes/first_beyond"))
    CHECK(std::isnan(time));
  CHECK(read_column<std::uint32_t>(path, "/summary/worlds/critical_box") == std::vector<std::uint32_t>{1, 1});
}

TEST_CASE("summary: results for other thresholds are in another file that names its source", "[io][results]") {
  const Run run = make_run(mixed_shapes());
  const Folder folder;
  const std::string path = folder / "results.h5";
  const std::string other = folder / "other.h5";
  write_run_to(path, run, never());
  const std::string before = file_bytes(path);
  require_ok(write_summary(path, {.drop = 0.15, .move = 0.3, .tilt = 5}, other));
  CHECK(file_bytes(path) == before);
  CHECK(read_column<std::uint32_t>(other, "/summary/worlds/fallen_boxes") == count_fallen(run, 0.15));
  CHECK(read_column<std::uint64_t>(other, "/worlds/layout") == read_column<std::uint64_t>(path, "/worlds/layout"));
  const h5::File file = h5::File::open(other);
  CHECK(h5::read_text_attribute(file, "/", "source") == path);
  CHECK(h5::read_number_attribute(file, "/summary", "drop_threshold") == 0.15);

  const auto again = write_summary(path, {}, other);
  REQUIRE(again);
  CHECK(again->message().find("exists already") != std::string::npos);
}

TEST_CASE("summary: a part is refused, because it repeats boxes of the previous part", "[io][results]") {
  const Run run = make_run({{3, 4}, {5, 2}});
  const Folder folder;
  const std::string path = folder / "results.h5";
  const auto writer = require_value(ResultsWriter::open(path, run.description, {}, every_unit()));
  write_units(*writer, run, 0, run.units.size());
  const auto error = write_summary(path + ".parts/part-000002.h5", {}, folder / "out.h5");
  REQUIRE(error);
  CHECK(error->message().find("is a part of an unfinished run") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(folder / "out.h5"));
  // The summary of a part has its own worlds and boxes only.
  require_ok(write_summary_csv(path + ".parts/part-000002.h5", {}, folder / "csv"));
  const std::string boxes = file_bytes(folder / "csv/boxes.csv");
  CHECK(std::count(boxes.begin(), boxes.end(), '\n') == 1 + 2 * 5);
}

TEST_CASE("summary: CSV has one line per world and per box, quoted where needed", "[io][results]") {
  const Run run = make_run({{3, 4}, {0, 0}});
  const Folder folder;
  write_run_to(folder / "results.h5", run, never());
  require_ok(write_summary_csv(folder / "results.h5", {}, folder / "csv/here"));
  const std::string worlds = file_bytes(folder / "csv/here/worlds.csv");
  const std::string boxes = file_bytes(folder / "csv/here/boxes.csv");
  CHECK(std::count(worlds.begin(), worlds.end(), '\n') == 1 + 4);
  CHECK(std::count(boxes.begin(), boxes.end(), '\n') == 1 + 6);
  const WorldRecord& first = run.units[0].worlds[0];
  const std::string verdict = to_string(judge_world(first.row, first.end, by_run({})).verdict);
  CHECK(worlds.find("\r\n0,\"loading, \"\"0\"\".txt\",braking.txt,," + verdict + ",ok,,,,timeout,") !=
        std::string::npos);
  CHECK(worlds.find(",failed,bad_layout,überlappt: box 3 and box 7,,,not_run,0,,,,,,,,,,,,,,0,") != std::string::npos);
}

TEST_CASE("summary: the results of a missing file are an error", "[io][results]") {
  const Folder folder;
  CHECK(write_summary(folder / "none.h5", {}, folder / "out.h5"));
  CHECK(write_summary_csv(folder / "none.h5", {}, folder / "out"));
  CHECK_FALSE(std::filesystem::exists(folder / "out.h5"));
}

}  // namespace summary_test
