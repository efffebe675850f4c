#include "io/results/results_reader.hpp"

#include <fstream>

#include "io/results/hdf5_file.hpp"
#include "io/results/results_fixture.hpp"

using namespace results_fixture;

namespace {

std::string message_of_open(const std::string& path) {
  const auto reader = ResultsReader::open(path);
  REQUIRE_FALSE(reader);
  return reader.error().message();
}

}  // namespace

TEST_CASE("results_reader: a file that is not a results file is a clear error", "[io][results]") {
  const Folder folder;
  CHECK(message_of_open(folder / "none.h5").find("No such file") != std::string::npos);
  std::ofstream(folder / "text.h5") << "not HDF5";
  CHECK(message_of_open(folder / "text.h5").find("cannot be opened as an HDF5 file") != std::string::npos);
  h5::File::create(folder / "other.h5").close();
  CHECK(message_of_open(folder / "other.h5").find("is not a results file") != std::string::npos);
}

TEST_CASE("results_reader: a later format is refused", "[io][results]") {
  const Folder folder;
  h5::File file = h5::File::create(folder / "later.h5");
  h5::write_attribute(file, "/", "format", kFormatName);
  h5::write_attribute(file, "/", "format_version", kFormatVersion + 1);
  file.close();
  CHECK(message_of_open(folder / "later.h5").find("later format version") != std::string::npos);
}

TEST_CASE("results_reader: a truncated file is an error", "[io][results]") {
  const Folder folder;
  const std::string path = folder / "results.h5";
  write_run_to(path, make_run({{3, 4}, {20, 31}}), never());
  for (std::uintmax_t size = std::filesystem::file_size(path) - 1; size > 0; size /= 2) {
    std::filesystem::resize_file(path, size);
    CHECK_FALSE(ResultsReader::open(path));
  }
}

TEST_CASE("results_reader: damage in the compressed data is an error", "[io][results]") {
  const Folder folder;
  const std::string path = folder / "results.h5";
  write_run_to(path, make_run({{3, 4}, {20, 31}}), never());
  haddr_t chunk = 0;
  {
    const h5::File file = h5::File::open(path);
    const h5::Id dataset(H5Dopen2(file.id(), "/series/force", H5P_DEFAULT), H5Dclose);
    const std::array<hsize_t, 2> first = {0, 0};
    REQUIRE(H5Dget_chunk_info_by_coord(dataset, first.data(), nullptr, &chunk, nullptr) >= 0);
  }
  std::fstream stream(path, std::ios::in | std::ios::out | std::ios::binary);
  stream.seekp(static_cast<std::streamoff>(chunk + 300));
  stream << "damaged";
  stream.close();
  ResultsReader reader = require_value(ResultsReader::open(path));
  const auto rows = require_value(reader.worlds(0, 4));
  const auto series = reader.series(rows[0]);
  REQUIRE_FALSE(series);
  CHECK(series.error().message().find("cannot be read (/series/force): inflate() failed") != std::string::npos);
  CHECK(reader.path_of(rows[0]));
}

TEST_CASE("results_reader: entries beyond the end are an error", "[io][results]") {
  const Folder folder;
  write_run_to(folder / "results.h5", make_run({{3, 4}}), never());
  ResultsReader reader = require_value(ResultsReader::open(folder / "results.h5"));
  CHECK_FALSE(reader.worlds(1, 2));
  CHECK_FALSE(reader.boxes(7, 1));
  CHECK(reader.worlds(2, 0));
}

TEST_CASE("results_reader: margins are read as they were found, over parts too", "[io][results]") {
  const Run run =
      make_run({{3, 4}, {2, 2}, {1, 1}}, true, {Analysis::verdicts, Analysis::margins, Analysis::margin_spread});
  const Folder folder;
  const std::string path = folder / "results.h5";
  write_run_to(path, run, every_unit());
  ResultsReader results = require_value(ResultsReader::open(path));
  REQUIRE(results.info().has_margins);
  const std::vector<LayoutMargins> margins = require_value(results.margins(0, 3));
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(margins[i].margin == run.units[i].layouts.front().margins.margin);
    CHECK(margins[i].critical_box == run.units[i].layouts.front().margins.critical_box);
    CHECK(margins[i].spread.low == run.units[i].layouts.front().margins.spread.low);
    CHECK(margins[i].spread.high == run.units[i].layouts.front().margins.spread.high);
  }
}

TEST_CASE("results_reader: wall forces are read as they were found, over parts too", "[io][results]") {
  const Run run = make_run({{3, 4}, {2, 20000}, {1, 1}}, true, {Analysis::verdicts, Analysis::wall_forces});
  const Folder folder;
  const std::string path = folder / "results.h5";
  write_run_to(path, run, every_unit());
  ResultsReader results = require_value(ResultsReader::open(path));
  REQUIRE(results.info().has_walls);
  const std::vector<WorldRow> rows = require_value(results.worlds(0, 6));
  const std::vector<WallForces> walls = require_value(results.walls(0, 6));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const WorldRecord& world = run.units[i / 2].worlds[i % 2];
    CHECK(walls[i].peak_force == world.walls.peak_force);
    CHECK(walls[i].peak_point == world.walls.peak_point);
    CHECK(walls[i].lasting_force == world.walls.lasting_force);
    CHECK(walls[i].impulse == world.walls.impulse);
    CHECK(require_value(results.series(rows[i])).side_force == world.series.side_force);
  }
}

TEST_CASE("results_reader: a series is read without wall forces where they were not asked for", "[io][results]") {
  const Folder folder;
  const std::string path = folder / "results.h5";
  write_run_to(path, make_run({{3, 4}}), never());
  ResultsReader results = require_value(ResultsReader::open(path));
  CHECK_FALSE(results.info().has_walls);
  const Series series = require_value(results.series(require_value(results.worlds(0, 1)).front()));
  CHECK(series.time.size() == 4);
  CHECK(series.side_force.empty());
}

TEST_CASE("results_reader: replicas are read as they were found, over parts too", "[io][results]") {
  const Run run = make_run({{3, 4}, {600, 2}, {0, 0}}, true, {Analysis::verdicts, Analysis::replicas});
  const Folder folder;
  const std::string path = folder / "results.h5";
  write_run_to(path, run, every_unit());
  ResultsReader results = require_value(ResultsReader::open(path));
  REQUIRE(results.info().has_replicas);
  const std::vector<ReplicaOutcome> replicas = require_value(results.replicas(0, 6));
  for (std::size_t i = 0; i < 6; ++i) {
    const ReplicaOutcome& expected = run.units[i / 2].worlds[i % 2].replicas;
    CHECK(replicas[i].failed == expected.failed);
    CHECK(replicas[i].share == expected.share);
    CHECK(replicas[i].wilson_high == expected.wilson_high);
    CHECK(replicas[i].verdict == expected.verdict);
  }
}

TEST_CASE("results_reader: damage is read as it was found, over parts too", "[io][results]") {
  const Run run = make_run({{3, 4}, {600, 2}, {0, 0}}, true, {Analysis::verdicts, Analysis::damage});
  const Folder folder;
  const std::string path = folder / "results.h5";
  write_run_to(path, run, every_unit());
  ResultsReader results = require_value(ResultsReader::open(path));
  REQUIRE(results.info().has_damage);
  const std::vector<WorldRow> rows = require_value(results.worlds(0, 6));
  const std::vector<std::uint32_t> beyond = require_value(results.boxes_beyond(0, 6));
  for (std::size_t i = 0; i < 6; ++i) {
    const WorldDamage& expected = run.units[i / 2].worlds[i % 2].damage;
    const BoxDamage found = require_value(results.box_damage(rows[i].box_begin, rows[i].box_count));
    CHECK(beyond[i] == expected.boxes_beyond);
    CHECK(found.peak_acceleration == expected.boxes.peak_acceleration);
    CHECK(found.velocity_change == expected.boxes.velocity_change);
    CHECK(found.beyond == expected.boxes.beyond);
  }
}

TEST_CASE("results_reader: indicators are read as they were found, over parts too", "[io][results]") {
  const Run run = make_run({{3, 4}, {600, 2}, {0, 0}, {5, 1}}, true, {Analysis::verdicts, Analysis::indicators});
  const Folder folder;
  const std::string path = folder / "results.h5";
  write_run_to(path, run, every_unit());
  ResultsReader results = require_value(ResultsReader::open(path));
  REQUIRE(results.info().has_indicators);
  const std::vector<LayoutIndicators> indicators = require_value(results.indicators(0, 4));
  for (std::size_t i = 0; i < 4; ++i) {
    const LayoutIndicators& expected = run.units[i].layouts.front().indicators;
    CHECK(indicators[i].centre_of_gravity == expected.centre_of_gravity);
    CHECK(indicators[i].badly_braced == expected.badly_braced);
    const LayoutIndicators boxes = require_value(results.box_indicators(i));
    CHECK(boxes.base_support == expected.base_support);
    CHECK(boxes.supported_sides == expected.supported_sides);
  }
}
