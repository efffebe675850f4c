#include "io/results/results_removal.hpp"

#include <sys/stat.h>

#include <fstream>

#include "io/results/results_fixture.hpp"

namespace results_removal_test {

using namespace results_fixture;

TEST_CASE("results_removal: only a results file is replaced", "[io][results]") {
  const Folder folder;
  const std::string path = folder / "results.h5";
  SECTION("a text") { std::ofstream(path) << "some text"; }
  SECTION("a folder") { std::filesystem::create_directory(path); }
  SECTION("a pipe") { REQUIRE(::mkfifo(path.c_str(), 0600) == 0); }
  CHECK(remove_results(path));
  CHECK(std::filesystem::exists(path));
}

TEST_CASE("results_removal: results, an empty file and a missing file may be replaced", "[io][results]") {
  const Folder folder;
  const std::string path = folder / "results.h5";
  SECTION("results") { write_run_to(path, make_run({{3, 4}}), every_unit()); }
  SECTION("an empty file") { std::ofstream{path}; }
  SECTION("nothing") {}
  CHECK_FALSE(remove_results(path));
  CHECK_FALSE(std::filesystem::exists(path));
}

}  // namespace results_removal_test
