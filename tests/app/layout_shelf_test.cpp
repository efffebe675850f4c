#include "app/layout_shelf.hpp"

#include <catch2/catch.hpp>
#include <fstream>

#include "io/results/results_fixture.hpp"

using namespace holdfast;
using results_fixture::Folder;

TEST_CASE("layout_shelf: all who share a layout get the same, whatever becomes of its file", "[app][layout_shelf]") {
  const Folder folder;
  const std::vector<std::string> paths = {folder / "a.txt"};
  const auto write = [&](const char* text) { std::ofstream(paths[0]) << text; };
  const Settings settings;
  StageCosts costs;
  write("1 1\n0 0 0 80 59 106 1\n");
  const std::vector<std::string> hashes = hash_layouts(paths);
  LayoutShelf shelf(paths, hashes, settings, costs);
  const auto first = shelf.take(0, 2);
  CHECK(first->error.empty());
  CHECK(first->layout.boxes.size() == 1);
  write("1 2\n0 0 0 80 59 106 1\n0 60 0 80 119 106 1\n");
  CHECK(shelf.take(0, 2) == first);
  // Both have come: who takes it now reads it anew.
  CHECK(shelf.take(0, 1)->error == paths[0] +
                                       ": this layout has changed since the run began, and is left out; screen it "
                                       "again by itself");
}

TEST_CASE("layout_shelf: a layout that has changed since the run began cannot be used", "[app][layout_shelf]") {
  const Folder folder;
  const std::vector<std::string> paths = {folder / "a.txt", folder / "none.txt"};
  const auto write = [](const std::string& path) { std::ofstream(path) << "1 1\n0 0 0 80 59 106 1\n"; };
  write(paths[0]);
  const std::vector<std::string> hashes = hash_layouts(paths);
  CHECK(hashes[0].size() == 64);
  CHECK(hashes[1].empty());
  std::ofstream(paths[0], std::ios::app) << "# touched\n";
  write(paths[1]);
  const Settings settings;
  StageCosts costs;
  LayoutShelf shelf(paths, hashes, settings, costs);
  for (const std::size_t i : {0U, 1U}) {
    const auto read = shelf.take(i, 1);
    CHECK(read->error.find("has changed since the run began") != std::string::npos);
    // Of what it was then: that is what a resumed run compares with.
    CHECK(read->layout.sha256 == hashes[i]);
    CHECK(read->layout.boxes.empty());
  }
}

TEST_CASE("layout_shelf: a layout that cannot be used has its name and says why", "[app][layout_shelf]") {
  const Folder folder;
  const std::vector<std::string> paths = {folder / "none.txt"};
  const Settings settings;
  StageCosts costs;
  const std::vector<std::string> hashes = hash_layouts(paths);
  LayoutShelf shelf(paths, hashes, settings, costs);
  const auto read = shelf.take(0, 1);
  CHECK(read->layout.name == "none.txt");
  CHECK(read->error.find("none.txt: cannot be read") != std::string::npos);
}
