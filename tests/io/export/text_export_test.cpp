#include "io/export/text_export.hpp"

#include <sstream>

#include "io/results/results_fixture.hpp"

namespace text_export_test {

using namespace results_fixture;

namespace {

/// The lines that are not comments.
std::vector<std::string> data_lines(const std::string& path) {
  std::istringstream stream(file_bytes(path));
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);)
    if (!line.starts_with('#')) lines.push_back(line);
  return lines;
}

}  // namespace

TEST_CASE("text_export: the three kinds of text files of StableCargo", "[io][results]") {
  Run run = make_run({{3, 4}, {2, 2}});
  run.description.layout_names = {"a.txt", "a.dat"};
  for (std::size_t i = 0; i < 2; ++i) {
    Layout renamed = *run.units[i].layouts[0].layout;
    renamed.name = run.description.layout_names[i];
    run.units[i].layouts[0].layout = std::make_shared<const Layout>(renamed);
  }
  const Folder folder;
  write_run_to(folder / "results.h5", run, never());
  require_ok(export_text(folder / "results.h5", folder / "text", "some/batch/"));
  CHECK(list_directory(folder / "text") ==
        std::vector<std::string>{"[BATCH-RESUMED]$batch", "[SOLUTION]$a$braking", "[SOLUTION]$a$missing",
                                 "[SOLUTION]$a~2$braking", "[SOLUTION]$a~2$missing", "[SOLUTION_RESUMED]$a$braking",
                                 "[SOLUTION_RESUMED]$a$missing", "[SOLUTION_RESUMED]$a~2$braking",
                                 "[SOLUTION_RESUMED]$a~2$missing"});

  const auto solution = data_lines(folder / "text/[SOLUTION]$a$braking");
  REQUIRE(solution.size() == 3 * 4);
  const WorldRecord& world = run.units[0].worlds[0];
  std::istringstream line(solution[4]);  // second sample, second box
  std::vector<double> numbers;
  for (double number = 0; line >> number;) numbers.push_back(number);
  REQUIRE(numbers.size() == 14);
  CHECK(numbers[0] == 2);
  CHECK(static_cast<float>(numbers[1]) == world.series.displacement[4].x);
  CHECK(static_cast<float>(numbers[6]) == world.series.force[4].z);
  CHECK(static_cast<float>(numbers[12]) == world.series.linear_acceleration[4].z);
  CHECK(numbers[13] == world.series.time[1]);

  CHECK(data_lines(folder / "text/[SOLUTION_RESUMED]$a$braking").size() == 1 + 3 + 1);
  const auto batch = data_lines(folder / "text/[BATCH-RESUMED]$batch");
  REQUIRE(batch.size() == 4);
  CHECK(batch[0].starts_with("a.txt\tbraking.txt\t"));
}

TEST_CASE("text_export: a world that was not simulated has nan as its results", "[io][results]") {
  const Folder folder;
  write_run_to(folder / "results.h5", make_run({{0, 0}}), never());
  require_ok(export_text(folder / "results.h5", folder / "text", "batch"));
  const auto batch = data_lines(folder / "text/[BATCH-RESUMED]$batch");
  REQUIRE(batch.size() == 2);
  CHECK(batch[0] == "loading, \"0\".txt\tbraking.txt\tnan\tnan");
}

TEST_CASE("text_export: a part is refused, and so is a folder that cannot be created", "[io][results]") {
  const Run run = make_run({{3, 4}});
  const Folder folder;
  const std::string path = folder / "results.h5";
  {
    const auto writer = require_value(ResultsWriter::open(path, run.description));
    write_units(*writer, run, 0, 1);
    require_ok(writer->finish());
  }
  CHECK(export_text(path + ".parts/part-000001.h5", folder / "text", "b"));
  require_ok(assemble(path, run.description));
  CHECK(export_text(path, path + "/text", "b"));
}

TEST_CASE("text_export: names too long for a file are reported before the run", "[io][results]") {
  const Folder folder;
  const std::string text = folder / "text";
  // "[SOLUTION_RESUMED]$" and "$" leave 235 bytes of 255.
  const std::string layout(200, 'l');
  require_ok(prepare_text_export(text, {"a.txt", layout + ".txt"}, {"b.txt", std::string(35, 'm') + ".txt"}, "batch"));
  CHECK(list_directory(text).empty());
  const auto error = prepare_text_export(text, {layout, layout}, {std::string(34, 'm')}, "batch");
  REQUIRE(error);  // the second layout ends in ~2
  CHECK(error->value == "[SOLUTION_RESUMED]$" + layout + "~2$" + std::string(34, 'm'));
  CHECK(prepare_text_export(text, {"a"}, {"b"}, std::string(245, 'd')));
  CHECK(prepare_text_export("/dev/null/text", {"a"}, {"b"}, "batch"));
}

}  // namespace text_export_test
