#include "io/input/layout_files.hpp"

#include <catch2/catch.hpp>
#include <fstream>

#include "io/input/text_file.hpp"
#include "io/loads/load_json.hpp"
#include "io/results/results_fixture.hpp"

namespace layout_files_test {

using namespace holdfast::internal;
using results_fixture::Folder;

TEST_CASE("layout_files: all who share a layout get the same, whatever becomes of its file", "[io][layout_files]") {
  const Folder folder;
  const std::vector<std::string> paths = {folder / "a.txt"};
  const auto write = [&](const char* text) { std::ofstream(paths[0]) << text; };
  const Settings settings;
  write("1 1\n0 0 0 80 59 106 1\n");
  LayoutFiles files(paths, settings);
  const auto first = files.take(0, 2);
  CHECK(first->error.empty());
  CHECK(first->layout.boxes.size() == 1);
  write("1 2\n0 0 0 80 59 106 1\n0 60 0 80 119 106 1\n");
  CHECK(files.take(0, 2) == first);
  // Both have come: who takes it now reads it anew.
  CHECK(files.take(0, 1)->error == paths[0] +
                                       ": this layout has changed since the run began, and is left out; screen it "
                                       "again by itself");
}

TEST_CASE("layout_files: a layout that has changed since the run began cannot be used", "[io][layout_files]") {
  const Folder folder;
  const std::vector<std::string> paths = {folder / "a.txt", folder / "none.txt"};
  const auto write = [](const std::string& path) { std::ofstream(path) << "1 1\n0 0 0 80 59 106 1\n"; };
  write(paths[0]);
  const Settings settings;
  LayoutFiles files(paths, settings);
  const std::vector<std::string> hashes = files.hashes();
  CHECK(hashes[0].size() == 64);
  CHECK(hashes[1].empty());
  std::ofstream(paths[0], std::ios::app) << "# touched\n";
  write(paths[1]);
  for (const std::size_t i : {0U, 1U}) {
    const auto read = files.take(i, 1);
    CHECK(read->error.find("has changed since the run began") != std::string::npos);
    // Of what it was then: that is what a resumed run compares with.
    CHECK(read->layout.sha256 == hashes[i]);
    CHECK(read->layout.boxes.empty());
  }
}

TEST_CASE("layout_files: a layout that cannot be used has its name and says why", "[io][layout_files]") {
  const Folder folder;
  const std::vector<std::string> paths = {folder / "none.txt"};
  const Settings settings;
  LayoutFiles files(paths, settings);
  const auto read = files.take(0, 1);
  CHECK(read->layout.name == "none.txt");
  CHECK(read->error.find("none.txt: cannot be read") != std::string::npos);
}

TEST_CASE("layout_files: the loads of a file are layouts of their own, and shards take some of them",
          "[io][layout_files]") {
  const Folder folder;
  const std::string table = folder / "two.csv";
  const std::string text = folder / "one.txt";
  std::ofstream(table) << "load,x,y,z,length,width,height\nA,0,0,0,80,60,50\nB,0,0,0,90,60,50\nB,0,0,50,80,60,1e9\n";
  std::ofstream(text) << "1 1\n0 0 0 80 59 106 1\n";
  const Settings settings;
  LayoutFiles files({table, text}, settings);
  CHECK(files.names() == std::vector<std::string>{"two.csv#A", "two.csv#B", "one.txt"});
  CHECK(files.label(1) == table + "#B");
  CHECK(files.take(0, 2)->layout.boxes.size() == 1);
  CHECK(files.take(0, 2)->error.empty());
  CHECK(files.hashes()[0] == sha256_of(canonical_json(files.take(0, 1)->layout)));
  CHECK(files.take(1, 1)->error.find("two.csv:4") != std::string::npos);

  const std::vector<std::size_t> some = {2, 0};
  const std::shared_ptr<LayoutFiles> shard = files.chosen(some);
  CHECK(shard->names() == std::vector<std::string>{"one.txt", "two.csv#A"});
  CHECK(shard->hashes()[1] == files.hashes()[0]);
  CHECK(shard->take(0, 1)->layout.boxes.size() == 1);
}

}  // namespace layout_files_test
