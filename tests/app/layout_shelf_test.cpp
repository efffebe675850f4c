#include "app/layout_shelf.hpp"

#include <catch2/catch.hpp>
#include <fstream>

#include "io/results_fixture.hpp"

using namespace holdfast;
using results_fixture::Folder;

TEST_CASE("layout_shelf: all who share a layout get the same, whatever becomes of its file", "[app][layout_shelf]") {
  const Folder folder;
  const std::vector<std::string> paths = {folder / "a.txt"};
  const auto write = [&](const char* text) { std::ofstream(paths[0]) << text; };
  const Settings settings;
  StageCosts costs;
  LayoutShelf shelf(paths, settings, costs);
  write("1 1\n0 0 0 80 59 106 1\n");
  const auto first = shelf.take(0, 2);
  CHECK(first->error.empty());
  CHECK(first->layout.boxes.size() == 1);
  write("1 2\n0 0 0 80 59 106 1\n0 60 0 80 119 106 1\n");
  CHECK(shelf.take(0, 2) == first);
  // Both have come: who takes it now is of another run.
  CHECK(shelf.take(0, 1)->layout.boxes.size() == 2);
}

TEST_CASE("layout_shelf: a layout that cannot be used has its name and says why", "[app][layout_shelf]") {
  const Folder folder;
  const std::vector<std::string> paths = {folder / "none.txt"};
  const Settings settings;
  StageCosts costs;
  LayoutShelf shelf(paths, settings, costs);
  const auto read = shelf.take(0, 1);
  CHECK(read->layout.name == "none.txt");
  CHECK(read->error.find("none.txt: cannot be read") != std::string::npos);
}
