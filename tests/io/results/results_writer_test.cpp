#include "io/results/results_writer.hpp"

#include <sys/resource.h>

#include <atomic>
#include <csignal>
#include <thread>

#include "io/results/hdf5_file.hpp"
#include "io/results/results_columns.hpp"
#include "io/results/results_fixture.hpp"
#include "io/results/summary.hpp"
#include "same_bits.hpp"

namespace results_writer_test {

using namespace results_fixture;

namespace {

void check_series(const Series& got, const Series& put) {
  CHECK(same_bits(got.time, put.time));
  CHECK(same_bits(got.container_acceleration, put.container_acceleration));
  CHECK(same_bits(got.total_kinetic_energy, put.total_kinetic_energy));
  CHECK(same_bits(got.fallen_count, put.fallen_count));
  CHECK(same_bits(got.displacement, put.displacement));
  CHECK(same_bits(got.orientation, put.orientation));
  CHECK(same_bits(got.angular_velocity, put.angular_velocity));
  CHECK(same_bits(got.linear_acceleration, put.linear_acceleration));
  CHECK(same_bits(got.force, put.force));
  CHECK(same_bits(got.kinetic_energy, put.kinetic_energy));
}

void check_world(ResultsReader& reader, const WorldRow& row, const WorldRecord& put) {
  CHECK(row.layout == put.row.layout);
  CHECK(row.acceleration == put.row.acceleration);
  CHECK(row.status == put.row.status);
  CHECK(row.message == put.row.message);
  CHECK(row.stop_reason == put.row.stop_reason);
  CHECK(row.end_time == put.row.end_time);
  CHECK(row.steps == put.row.steps);
  CHECK(row.steps_skipped == put.row.steps_skipped);
  CHECK(row.solve_iterations == put.row.solve_iterations);
  CHECK(row.cpu_seconds == put.row.cpu_seconds);
  CHECK(row.max_residual == put.row.max_residual);
  CHECK(row.residual_scale == put.row.residual_scale);
  CHECK(row.max_penetration == put.row.max_penetration);
  CHECK(row.state_hash == put.row.state_hash);
  CHECK(row.peak_total_kinetic_energy == put.row.peak_total_kinetic_energy);
  CHECK(row.engine == "bullet");
  REQUIRE(row.boxes == put.boxes.id.size());
  REQUIRE(row.sample_count == put.series.time.size());

  const BoxTable boxes = require_value(reader.boxes(row.box_begin, row.boxes));
  CHECK(same_bits(boxes.id, put.boxes.id));
  CHECK(same_bits(boxes.material, put.boxes.material));
  CHECK(same_bits(boxes.mass, put.boxes.mass));
  CHECK(same_bits(boxes.size, put.boxes.size));
  CHECK(same_bits(boxes.initial_position, put.boxes.initial_position));
  const EndTable ends = require_value(reader.ends(row.box_begin, row.boxes));
  visit_ends<EndTable>([&](const OutcomeField& field, auto member) {
    CAPTURE(field.name);
    CHECK(same_bits(ends.*member, put.end.*member));
  });
  check_series(require_value(reader.series(row)), put.series);
}

/// Compares the worlds of the run from `begin` on with all worlds of the file.
void check_file(const std::string& path, const Run& run, std::size_t unit_begin, std::size_t unit_end) {
  ResultsReader reader = require_value(ResultsReader::open(path));
  const auto rows = require_value(reader.worlds(0, reader.info().world_count));
  std::size_t world = 0;
  for (std::size_t unit = unit_begin; unit < unit_end; ++unit)
    for (const WorldRecord& put : run.units[unit].worlds) {
      REQUIRE(world < rows.size());
      check_world(reader, rows[world++], put);
    }
  CHECK(world == rows.size());
}

}  // namespace

TEST_CASE("results_writer: the file has the same bits as the records", "[io][results]") {
  const bool series = GENERATE(true, false);
  const Run run = make_run(mixed_shapes(), series);
  const Folder folder;
  const std::string path = folder / "results.h5";
  write_run_to(path, run, GENERATE(every_unit(), never()));
  check_file(path, run, 0, run.units.size());

  ResultsReader reader = require_value(ResultsReader::open(path));
  CHECK(reader.info().complete);
  CHECK(reader.info().layouts == run.description.layout_names);
  CHECK(reader.info().accelerations == std::vector<std::string>{"braking.txt", "missing.txt"});
  CHECK(reader.info().command_line == run.description.command_line);
  CHECK_FALSE(std::filesystem::exists(path + ".parts"));
  CHECK_FALSE(std::filesystem::exists(path + ".tmp"));
}

TEST_CASE("results_writer: the bytes of the file do not depend on where parts end", "[io][results]") {
  const Run run = make_run(mixed_shapes());
  const Folder folder;
  write_run_to(folder / "whole.h5", run, never());
  write_run_to(folder / "cut.h5", run, every_unit());
  CHECK(file_bytes(folder / "whole.h5") == file_bytes(folder / "cut.h5"));
}

TEST_CASE("results_writer: a run killed after any part and resumed gives the same bytes", "[io][results][slow]") {
  const Run run = make_run(mixed_shapes());
  const Folder folder;
  write_run_to(folder / "whole.h5", run, never());
  const std::string whole = file_bytes(folder / "whole.h5");
  for (std::size_t cut = 0; cut <= run.units.size(); ++cut) {
    CAPTURE(cut);
    const std::string path = folder / ("cut" + std::to_string(cut) + ".h5");
    {
      const PartLimits limits{.worlds = 4, .age = std::chrono::hours(1)};
      const auto writer = require_value(ResultsWriter::open(path, run.description, {}, limits));
      write_units(*writer, run, 0, cut);  // destroyed without finish, as by a kill
    }
    const Progress progress = require_value(find_finished(path, fingerprint(run.description)));
    CHECK(progress.world_count == cut / 2 * 4);
    CHECK(progress.layout_count == cut / 2 * 2);
    const auto writer = require_value(ResultsWriter::open(path, run.description, progress, never()));
    write_units(*writer, run, progress.layout_count, run.units.size());
    require_ok(writer->finish());
    require_ok(assemble(path, run.description));
    CHECK(file_bytes(path) == whole);
    CHECK(require_value(find_finished(path, fingerprint(run.description))).complete);
  }
}

TEST_CASE("results_writer: a part is a readable file by itself", "[io][results]") {
  const Run run = make_run(mixed_shapes());
  const Folder folder;
  const std::string path = folder / "results.h5";
  const auto writer = require_value(ResultsWriter::open(path, run.description, {}, every_unit()));
  write_units(*writer, run, 0, run.units.size());
  for (std::size_t unit = 0; unit < run.units.size(); ++unit) {
    const std::string part = path + ".parts/part-00000" + std::to_string(unit + 1) + ".h5";
    check_file(part, run, unit, unit + 1);
    ResultsReader reader = require_value(ResultsReader::open(part));
    CHECK_FALSE(reader.info().complete);
    CHECK(reader.info().world_begin == 2 * unit);
  }
}

TEST_CASE("results_writer: indices in a part are those of the run", "[io][results]") {
  const Run run = make_run({{3, 4}, {600, 31}, {5, 2}});
  const Folder folder;
  const std::string path = folder / "results.h5";
  const auto writer = require_value(ResultsWriter::open(path, run.description, {}, every_unit()));
  write_units(*writer, run, 0, run.units.size());
  const h5::File file = h5::File::open(path + ".parts/part-000003.h5");
  const auto first = [&](std::string_view name) {
    return values_of<std::uint64_t>(h5::Dataset::open(file, dataset_spec(name)).read(0, 1)).front();
  };
  CHECK(first("/worlds/box_begin") == 2 * 603);
  CHECK(first("/worlds/sample_begin") == 2 * 35);
  CHECK(first("/worlds/row_begin") == 2 * (3 * 4 + 600 * 31));
  CHECK(first("/inputs/layouts/box_begin") == 603);
  // All boxes of the run fit into one chunk, which the part repeats from its beginning.
  CHECK(h5::read_count_attribute(file, "/", "boxes_begin") == 0);
  const auto worlds = h5::Dataset::open(file, dataset_spec("/boxes/world"));
  REQUIRE(worlds.length() == 2 * 608);
  CHECK(values_of<std::uint64_t>(worlds.read(0, 4)) == std::vector<std::uint64_t>{0, 0, 0, 1});
  CHECK(values_of<std::uint64_t>(worlds.read(2 * 608 - 6, 6)) == std::vector<std::uint64_t>{4, 5, 5, 5, 5, 5});
}

TEST_CASE("results_writer: the summary in the file agrees with its records", "[io][results]") {
  const bool series = GENERATE(true, false);
  Run run = make_run(mixed_shapes(), series);
  run.description.thresholds.move = 0.3;
  const Folder folder;
  const std::string path = folder / "results.h5";
  write_run_to(path, run, every_unit());
  // Derived again from the worlds in the file, as for other thresholds.
  require_ok(write_summary(path, run.description.thresholds, folder / "again.h5"));
  const h5::File file = h5::File::open(path);
  const h5::File again = h5::File::open(folder / "again.h5");
  for (const DatasetSpec& spec : schema()) {
    if (spec.origin != Origin::derived) continue;
    CAPTURE(spec.path);
    const auto in = h5::Dataset::open(file, spec);
    const auto derived = h5::Dataset::open(again, spec);
    REQUIRE(in.length() > 0);
    REQUIRE(in.length() == derived.length());
    CHECK((in.read(0, in.length()) == derived.read(0, in.length())));
  }
}

TEST_CASE("results_writer: an open part is closed when it is old enough", "[io][results]") {
  const Run run = make_run({{3, 4}, {2, 2}});
  const Folder folder;
  const std::string path = folder / "results.h5";
  const auto writer = require_value(ResultsWriter::open(path, run.description));
  write_units(*writer, run, 0, 1);
  const auto now = std::chrono::steady_clock::now();
  require_ok(writer->close_part_if_due(now));
  CHECK_FALSE(std::filesystem::exists(path + ".parts/part-000001.h5"));
  require_ok(writer->close_part_if_due(now + std::chrono::seconds(3)));
  CHECK(std::filesystem::exists(path + ".parts/part-000001.h5"));
  require_ok(writer->close_part_if_due(now + std::chrono::seconds(9)));
  CHECK_FALSE(std::filesystem::exists(path + ".parts/part-000002.h5"));
}

TEST_CASE("results_writer: a timer may close parts while another thread writes", "[io][results]") {
  const Run run = make_run(mixed_shapes());
  const Folder folder;
  const std::string path = folder / "results.h5";
  const auto writer = require_value(ResultsWriter::open(path, run.description));
  std::atomic<bool> done = false;
  std::optional<Error> timer_error;
  std::thread timer([&] {
    while (!done && !timer_error)
      timer_error = writer->close_part_if_due(std::chrono::steady_clock::now() + std::chrono::hours(1));
  });
  std::optional<Error> error;
  for (const UnitRecord& unit : run.units)
    if (!error) error = write_unit(*writer, unit);
  done = true;
  timer.join();
  require_ok(error);
  require_ok(timer_error);
  require_ok(writer->finish());
  require_ok(assemble(path, run.description));
  check_file(path, run, 0, run.units.size());
}

TEST_CASE("results_writer: never overwrites results or the parts of an interrupted run", "[io][results]") {
  const Run run = make_run({{3, 4}});
  const Folder folder;
  const std::string path = folder / "results.h5";
  {
    const auto writer = require_value(ResultsWriter::open(path, run.description));
    write_units(*writer, run, 0, 1);
    require_ok(writer->finish());
  }
  const auto over_parts = ResultsWriter::open(path, run.description);
  REQUIRE_FALSE(over_parts);
  CHECK(over_parts.error().message().find("interrupted run") != std::string::npos);
  require_ok(assemble(path, run.description));
  const auto over_file = ResultsWriter::open(path, run.description);
  REQUIRE_FALSE(over_file);
  CHECK(over_file.error().message().find("exists already") != std::string::npos);
}

TEST_CASE("results_writer: a run without worlds gives a file with empty tables", "[io][results]") {
  const Run run = make_run({});
  const Folder folder;
  write_run_to(folder / "results.h5", run, never());
  check_file(folder / "results.h5", run, 0, 0);
}

namespace {

/// Limits the size of files to `bytes` during its lifetime, which looks like a full disk to the program.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  void (*handler_)(int);
  rlimit before_{};
};

}  // namespace

TEST_CASE("results_writer: a failed write is an error, and finished parts remain readable", "[io][results]") {
  const Run run = make_run({{3, 4}, {600, 31}, {3, 4}});
  const Folder folder;
  const std::string path = folder / "results.h5";
  const auto writer = require_value(ResultsWriter::open(path, run.description, {}, every_unit()));
  write_units(*writer, run, 0, 1);
  {
    const FileSizeLimit limit(200'000);
    const auto error = write_unit(*writer, run.units[1]);
    REQUIRE(error);
    CHECK(error->message().find("part-000002.h5: cannot be written: File too large") != std::string::npos);
  }
  CHECK(writer->finish());
  CHECK(list_directory(path + ".parts") == std::vector<std::string>{"part-000001.h5"});
  check_file(path + ".parts/part-000001.h5", run, 0, 1);
}

TEST_CASE("results_assembler: after a failed write the parts remain, without a results file", "[io][results]") {
  const Run run = make_run({{3, 4}, {600, 31}, {3, 4}});
  const Folder folder;
  const std::string path = folder / "results.h5";
  const auto writer = require_value(ResultsWriter::open(path, run.description, {}, never()));
  write_units(*writer, run, 0, 3);
  require_ok(writer->finish());
  const rlim_t most = GENERATE(as<rlim_t>{}, 0, 1000, 30'000, 200'000, 1'000'000);
  {
    const FileSizeLimit limit(most);
    const auto error = assemble(path, run.description);
    REQUIRE(error);
    CAPTURE(most, error->message());
    CHECK(error->message().find("File too large") != std::string::npos);
  }
  CHECK_FALSE(std::filesystem::exists(path));
  CHECK_FALSE(std::filesystem::exists(path + ".tmp"));
  require_ok(assemble(path, run.description));
  check_file(path, run, 0, 3);
}

TEST_CASE("results_assembler: when stopped it does not change the parts", "[io][results]") {
  const Folder folder;
  const std::string path = folder / "results.h5";
  const Run run = make_run({{3, 4}, {5, 2}});
  {
    const auto writer = require_value(ResultsWriter::open(path, run.description, {}, every_unit()));
    write_units(*writer, run, 0, run.units.size());
  }
  std::atomic<bool> stop = true;
  CHECK(assemble(path, run.description, &stop));
  CHECK(list_directory(folder / "") == std::vector<std::string>{"results.h5.parts"});
  CHECK(list_directory(path + ".parts").size() == 2);
  stop = false;
  require_ok(assemble(path, run.description, &stop));
  CHECK(list_directory(folder / "") == std::vector<std::string>{"results.h5"});
}

}  // namespace results_writer_test
