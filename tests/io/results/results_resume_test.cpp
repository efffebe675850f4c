#include "io/results/results_resume.hpp"

#include <hdf5.h>

#include <fstream>

#include "io/results/results_fixture.hpp"

namespace results_resume_test {

using namespace results_fixture;

namespace {

/// Writes all units of the run, one part each, and does not assemble them.
void write_parts(const std::string& path, const Run& run) {
  const auto writer = require_value(ResultsWriter::open(path, run.description, {}, every_unit()));
  write_units(*writer, run, 0, run.units.size());
}

std::string message_of(const Result<Progress>& progress) {
  REQUIRE_FALSE(progress);
  return progress.error().message();
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("results_resume: without files there is no progress", "[io][results]") {
  const Folder folder;
  const Progress progress = require_value(find_finished(folder / "results.h5", "x"));
  CHECK(progress.world_count == 0);
  CHECK_FALSE(progress.complete);
}

TEST_CASE("results_resume: finished parts are counted and left-over files removed", "[io][results]") {
  const Folder folder;
  const std::string path = folder / "results.h5";
  const Run run = make_run({{3, 4}, {0, 0}, {5, 2}});
  write_parts(path, run);
  std::ofstream(path + ".parts/part-000004.h5.tmp") << "half";
  std::ofstream(path + ".tmp") << "half";
  const Progress progress = require_value(find_finished(path, fingerprint(run.description)));
  CHECK(progress.part_count == 3);
  CHECK(progress.world_count == 6);
  CHECK(progress.box_count == 16);
  CHECK(progress.sample_count == 12);
  CHECK(progress.row_count == 2 * (12 + 10));
  CHECK(progress.layout_count == 3);
  CHECK(progress.layout_hashes == run.description.layout_hashes);
  CHECK(list_directory(path + ".parts").size() == 3);
  CHECK_FALSE(std::filesystem::exists(path + ".tmp"));
}

TEST_CASE("results_resume: parts and file of another run are refused, with the differences", "[io][results]") {
  const Folder folder;
  const std::string path = folder / "results.h5";
  const Run run = make_run({{3, 4}});
  write_parts(path, run);
  RunDescription other = run.description;
  other.config_text += "# a comment, which is no setting";
  other.host = "another";
  CHECK(fingerprint(other) == fingerprint(run.description));
  other.git_commit += "x";
  other.accelerations[0].sha256[5] = 'c';
  const std::string said = ": is of a run with other software, accelerations: by " + run.description.software +
                           ", commit " + run.description.git_commit +
                           "; the same inputs and version can resume it, --overwrite starts anew";
  CHECK(message_of(find_finished(path, fingerprint(other))) == path + ".parts/part-000001.h5" + said);
  require_ok(assemble(path, run.description));
  CHECK(message_of(find_finished(path, fingerprint(other))) == path + said);
}

TEST_CASE("results_resume: finished worlds are read as they were written", "[io][results]") {
  const Folder folder;
  const std::string path = folder / "results.h5";
  const Run run = make_run({{3, 4}, {2, 2}});
  write_parts(path, run);
  std::vector<WorldRecord> put;
  for (const UnitRecord& unit : run.units) put.insert(put.end(), unit.worlds.begin(), unit.worlds.end());
  std::size_t next = 0;
  const Progress progress = require_value(find_finished(path, fingerprint(run.description)));
  const auto compare = [&](const WorldRecord& got) {
    const WorldRecord& world = put.at(next++);
    visit_world_row<WorldRow>([&](const OutcomeField& field, auto member) {
      const bool of_file = field.scope == FieldScope::stored && field.dataset.find("_begin") != std::string_view::npos;
      if (of_file || field.name == "sample_count" || field.name == "engine") return;
      CAPTURE(field.name);
      if (field.type == "time") return;  // NaN where there is none
      CHECK(got.row.*member == world.row.*member);
    });
    CHECK(got.end.end_kinetic_energy == world.end.end_kinetic_energy);
  };
  CHECK_FALSE(visit_finished(path, progress, {.world = compare}));
  CHECK(next == put.size());
}

TEST_CASE("results_resume: a missing or damaged part is an error", "[io][results]") {
  const Folder folder;
  const std::string path = folder / "results.h5";
  const Run run = make_run({{3, 4}, {2, 2}, {5, 2}});
  write_parts(path, run);
  const std::string second = path + ".parts/part-000002.h5";
  SECTION("missing") {
    std::filesystem::remove(second);
    CHECK(contains(message_of(find_finished(path, fingerprint(run.description))), "part-000002.h5: is missing"));
    CHECK(assemble(path, run.description));
  }
  SECTION("damaged") {
    std::filesystem::resize_file(second, 5000);
    CHECK(contains(message_of(find_finished(path, fingerprint(run.description))), "cannot be opened as an HDF5 file"));
  }
  SECTION("a copy of another") {
    std::filesystem::copy_file(path + ".parts/part-000001.h5", second,
                               std::filesystem::copy_options::overwrite_existing);
    CHECK(contains(message_of(find_finished(path, fingerprint(run.description))), "does not continue where"));
  }
  SECTION("with chunks that cannot be copied unchanged") {
    const auto change = [](const char* part) {
      const hid_t file = H5Fopen(part, H5F_ACC_RDWR, H5P_DEFAULT);
      REQUIRE(H5Ldelete(file, "/boxes/world", H5P_DEFAULT) >= 0);
      const hsize_t length = 6 + 4 + 10;
      const hid_t space = H5Screate_simple(1, &length, nullptr);
      const std::vector<std::uint64_t> worlds(length);
      const hid_t dataset =
          H5Dcreate2(file, "/boxes/world", H5T_STD_U64LE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
      REQUIRE(H5Dwrite(dataset, H5T_NATIVE_UINT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, worlds.data()) >= 0);
      H5Dclose(dataset);
      H5Sclose(space);
      H5Fclose(file);
    };
    change((path + ".parts/part-000003.h5").c_str());
    CHECK(contains(message_of(find_finished(path, fingerprint(run.description))),
                   "part-000003.h5: has a dataset of a wrong chunk size (/boxes/world)"));
  }
  SECTION("cut off inside the data") {
    // HDF5 opens a part whose chunks extend beyond its end if the length of the file is as stored in it.
    const std::string first = path + ".parts/part-000001.h5";
    const auto size = std::filesystem::file_size(first);
    std::string bytes = file_bytes(first);
    std::ofstream(first, std::ios::binary) << bytes.substr(0, size / 2);
    CHECK_FALSE(find_finished(path, fingerprint(run.description)));
    CHECK(assemble(path, run.description));
    CHECK_FALSE(std::filesystem::exists(path));
  }
  SECTION("the last worlds missing") {
    std::filesystem::remove(path + ".parts/part-000003.h5");
    const auto error = assemble(path, run.description);
    REQUIRE(error);
    CHECK(contains(error->message(), "does not have all worlds of the run: 4 of 6"));
  }
}

TEST_CASE("results_resume: parts that a kill has left beside the finished file are removed", "[io][results]") {
  const Folder folder;
  const std::string path = folder / "results.h5";
  const Run run = make_run({{3, 4}, {5, 2}});
  write_parts(path, run);
  std::filesystem::copy(path + ".parts", folder / "kept");
  require_ok(assemble(path, run.description));
  std::filesystem::copy(folder / "kept", path + ".parts");
  CHECK(require_value(find_finished(path, fingerprint(run.description))).complete);
  CHECK_FALSE(std::filesystem::exists(path + ".parts"));
}

}  // namespace results_resume_test
