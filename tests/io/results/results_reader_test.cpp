#include "io/results/results_reader.hpp"

#include "io/results/found_tables.hpp"

#include <fstream>

#include "io/results/hdf5_file.hpp"
#include "io/results/results_fixture.hpp"

namespace results_reader_test {

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
  CHECK(reader.ends(0, 1));
}

TEST_CASE("results_reader: entries beyond the end are an error", "[io][results]") {
  const Folder folder;
  write_run_to(folder / "results.h5", make_run({{3, 4}}), never());
  ResultsReader reader = require_value(ResultsReader::open(folder / "results.h5"));
  CHECK_FALSE(reader.worlds(1, 2));
  CHECK_FALSE(reader.boxes(7, 1));
  CHECK(reader.worlds(2, 0));
}

namespace {

/// Whether everything that is described of two values has the same bits.
template <class Found>
void check_same(const Found& a, const Found& b) {
  Found::describe([&](const DatasetContent& content, auto member) {
    Column of_a(dataset_spec(content.path));
    Column of_b(dataset_spec(content.path));
    of_a.append(a.*member);
    of_b.append(b.*member);
    CAPTURE(content.path);
    CHECK((of_a.take() == of_b.take()));
  });
}

const WorldRecord& world_of(const Run& run, std::size_t i) { return run.units[i / 2].worlds[i % 2]; }

}  // namespace

TEMPLATE_TEST_CASE("results_reader: what is found of layouts is read as it was, over parts too", "[io][results]",
                   LayoutMargins, MarginSpread, LayoutIndicators) {
  const Run run = make_run({{3, 4}, {600, 2}, {0, 0}, {5, 1}}, true, all_tables());
  const Folder folder;
  write_run_to(folder / "results.h5", run, every_unit());
  ResultsReader results = require_value(ResultsReader::open(folder / "results.h5"));
  CHECK(results.info().analyses == all_tables());
  const std::vector<TestType> found = require_value(read_layouts<TestType>(results, 0, 4, Depth::boxes));
  for (std::size_t i = 0; i < found.size(); ++i)
    check_same(found[i], run.units[i].layouts.front().found.value<TestType>());
}

TEMPLATE_TEST_CASE("results_reader: what is found of worlds is read as it was, over parts too", "[io][results]",
                   WallForces, ReplicaOutcome, WorldDamage) {
  const Run run = make_run({{3, 4}, {600, 2}, {0, 0}, {2, 20000}}, true, all_tables());
  const Folder folder;
  write_run_to(folder / "results.h5", run, every_unit());
  ResultsReader results = require_value(ResultsReader::open(folder / "results.h5"));
  const std::vector<WorldRow> rows = require_value(results.worlds(0, 8));
  const std::vector<TestType> found = require_value(read_worlds<TestType>(results, 0, rows, Depth::samples));
  for (std::size_t i = 0; i < found.size(); ++i) check_same(found[i], world_of(run, i).found.value<TestType>());
}

TEST_CASE("results_reader: a file has no analyses that were not asked for", "[io][results]") {
  const Folder folder;
  write_run_to(folder / "results.h5", make_run({{3, 4}}), never());
  ResultsReader results = require_value(ResultsReader::open(folder / "results.h5"));
  CHECK(results.info().analyses.empty());
  CHECK_FALSE(read_worlds<WallForces>(results, 0, require_value(results.worlds(0, 1))));
}

}  // namespace results_reader_test
