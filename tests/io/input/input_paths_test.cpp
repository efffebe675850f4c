#include "io/input/input_paths.hpp"

#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "io/input/memory_file.hpp"

namespace input_paths_test {

using namespace holdfast::internal;
using namespace holdfast::internal::test;

namespace {

namespace fs = std::filesystem;

constexpr const char* kLayout = "1 2\n0 0 0 80 59 106 1\n";
constexpr const char* kAcceleration = "# t\n0 1 0 0 0\n";
constexpr const char* kConfig = "[Contact]\nRestitution = 0\n";

/// A folder that is removed together with its object.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    static int count = 0;
    path_ = fs::temp_directory_path() / ("holdfast_paths_" + std::to_string(getpid()) + '_' + std::to_string(++count));
    fs::create_directories(path_);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }

  std::string write(const std::string& name, const std::string& text) const {
    fs::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path(name);
  }
  std::string path(const std::string& name) const { return (path_ / name).string(); }
  std::string path() const { return path_.string(); }

 private:
  fs::path path_;
};

std::vector<std::string> found(const Result<std::vector<std::string>>& result) {
  return result ? *result : Messages{"error", result.error().message()};
}

Result<std::vector<std::string>> layouts(std::vector<std::string> paths, std::vector<Error>& warnings,
                                         const std::string& list = "") {
  std::istringstream stream(list);
  return layout_paths(paths, stream, warnings);
}

}  // namespace

TEST_CASE("input_paths: the first lines show the kind of a file", "[io][input_paths]") {
  CHECK(classify(kLayout) == InputKind::layout);
  CHECK(classify("1 2\n0 0 0 80 59 106 1 extra\n") == InputKind::layout);
  CHECK(classify("1 2 3 4 5\n0 0 0 80 59 106 1\n") == InputKind::layout);
  CHECK(classify("0 0 0 80 59 106 1\n") == InputKind::layout);
  CHECK(classify(kAcceleration) == InputKind::acceleration);
  CHECK(classify("0 1 0 0 0") == InputKind::acceleration);
  CHECK(classify("0 1 0 0 0\n1 1 0 0\n") == InputKind::acceleration);
  CHECK(classify("\xEF\xBB\xBF# c\r\n\r\n0 1 0 0 0\r\n") == InputKind::acceleration);
  CHECK(classify(kConfig) == InputKind::config);
  CHECK(classify("; c\n# c\nBoxBox=1\n") == InputKind::config);
  CHECK(classify("1\n0 0 nan 80 1,5 106 wood\n") == InputKind::layout);
  CHECK(classify("0 1 zero 0 0\n") == InputKind::acceleration);
  CHECK(classify("3 1 # seed=12\n0 0 0 80 59 106 1\n") == InputKind::layout);
  CHECK(classify("seed=12 boxes=1\n0 0 0 80 59 106 1\n") == InputKind::layout);
  CHECK(classify("BoxBox = 0.5\nBoxWall = 0.5\n") == InputKind::config);
  CHECK(classify("0 1 0 0 0 # a=0\n") == InputKind::acceleration);
  CHECK(classify("1 2 \r\n\t0\t0 0 80  59 106 1x # c\r\n") == InputKind::layout);
  CHECK(classify("time duration x y z\n0 1 0 0 0") == InputKind::acceleration);
  CHECK(classify("A licence in words.\nThese are seven words or some more.\n") == InputKind::unknown);
  CHECK(classify("These are five words exactly\n") == InputKind::unknown);
  CHECK(classify("") == InputKind::unknown);
  CHECK(classify("# only a comment\n") == InputKind::unknown);
  CHECK(classify("some words\nand more\n") == InputKind::unknown);
  CHECK(classify(std::string("\x89HDF\0\n1 2 3 4 5", 15)) == InputKind::unknown);
}

TEST_CASE("input_paths: a long comment and a long file are classified by their beginning", "[io][input_paths]") {
  const TemporaryFolder folder;
  std::string comment;
  for (int i = 0; i < 1000; ++i) comment += "# line of a comment\n";
  CHECK(classify_file(folder.write("a", comment + kLayout)) == InputKind::layout);
  std::string large = "1\n";
  while (large.size() < 100000) large += "0 0 0 80 59 106 1\n";
  CHECK(classify_file(folder.write("b", large)) == InputKind::layout);
  CHECK(classify_file(folder.write("d", "1\n0 0 0 80." + std::string(1000000, '0') + " 59 106 1\n")) ==
        InputKind::layout);
  CHECK(classify_file(folder.write("c", std::string(200000, '1'))) == InputKind::unknown);
  CHECK(classify_file(folder.path("missing")) == InputKind::unknown);
}

TEST_CASE("input_paths: a folder gives its files of the kind in byte order", "[io][input_paths]") {
  const TemporaryFolder folder;
  for (const char* name : {"b.txt", "a.txt", "B.txt", "a10.txt", "a2.txt"}) folder.write(name, kLayout);
  folder.write("x_acceleration.txt", kAcceleration);
  folder.write("config.ini", kConfig);
  folder.write(".hidden", kLayout);
  folder.write("inner/c.txt", kLayout);
  folder.write("notes.md", "some words\n");
  std::vector<Error> warnings;
  CHECK(found(layouts({folder.path()}, warnings)) == Messages{folder.path("B.txt"), folder.path("a.txt"),
                                                              folder.path("a10.txt"), folder.path("a2.txt"),
                                                              folder.path("b.txt")});
  CHECK(messages_of(warnings) ==
        Messages{folder.path("notes.md") + ": left out, neither a layout, nor an acceleration, nor a config"});

  std::istringstream none;
  const std::vector<std::string> paths{folder.path()};
  CHECK(found(acceleration_paths(paths, none, warnings)) == Messages{folder.path("x_acceleration.txt")});
}

TEST_CASE("input_paths: named files are used in the given order, also twice", "[io][input_paths]") {
  const TemporaryFolder folder;
  const std::string b = folder.write("b", kLayout), a = folder.write("a", "no layout at all");
  const std::string other = folder.write("inner/b", kLayout);
  std::vector<Error> warnings;
  CHECK(found(layouts({b, a, other, b}, warnings)) == Messages{b, a, other, b});
  CHECK(warnings.empty());
}

TEST_CASE("input_paths: a list on standard input", "[io][input_paths]") {
  const TemporaryFolder folder;
  const std::string a = folder.write("a file", kLayout), b = folder.write("inner/b", kLayout);
  std::vector<Error> warnings;
  CHECK(found(layouts({"-"}, warnings, a + "\r\n\n  " + folder.path("inner") + "\n" + a)) == Messages{a, b, a});
  CHECK(found(layouts({b, "-", b}, warnings, a)) == Messages{b, a, b});
  CHECK(messages_of(layouts({"-"}, warnings, "\n")) ==
        Messages{"the list of paths on standard input is empty; one path per line"});
}

TEST_CASE("input_paths: every missing or empty path is an error", "[io][input_paths]") {
  const TemporaryFolder folder;
  const std::string only = folder.write("only/acceleration", kAcceleration);
  std::vector<Error> warnings;
  CHECK(messages_of(layouts({folder.path("x"), folder.path("only"), ""}, warnings)) ==
        Messages{folder.path("x") + ": no such file or folder", folder.path("only") + ": the folder has no layouts",
                 "an empty path"});
  std::istringstream none;
  const std::vector<std::string> layout_only{folder.path("inner")};
  folder.write("inner/layout", kLayout);
  CHECK(messages_of(acceleration_paths(layout_only, none, warnings)) ==
        Messages{folder.path("inner") + ": the folder has no accelerations"});
}

TEST_CASE("input_paths: inputs of all kinds", "[io][input_paths]") {
  const TemporaryFolder folder;
  folder.write("in/a", kAcceleration);
  folder.write("in/b", kConfig);
  folder.write("in/c", kLayout);
  const std::string words = folder.write("words", "some words");
  std::vector<Error> warnings;
  std::istringstream none;
  const std::vector<std::string> paths{words, folder.path("in")};
  const Result<std::vector<InputFile>> files = find_inputs(paths, none, warnings);
  REQUIRE(files);
  REQUIRE(files->size() == 4);
  CHECK((*files)[0].kind == InputKind::unknown);
  CHECK((*files)[1].kind == InputKind::acceleration);
  CHECK((*files)[2].kind == InputKind::config);
  CHECK((*files)[3].kind == InputKind::layout);
  CHECK((*files)[3].path == folder.path("in/c"));
}

TEST_CASE("input_paths: a batch folder has both kinds", "[io][input_paths]") {
  const TemporaryFolder folder;
  folder.write("2", kLayout);
  folder.write("1", kLayout);
  folder.write("3", kAcceleration);
  folder.write("c.ini", kConfig);
  std::vector<Error> warnings;
  const Result<BatchFolder> batch = read_batch_folder(folder.path(), true, warnings);
  REQUIRE(batch);
  CHECK(batch->layouts == Messages{folder.path("1"), folder.path("2")});
  CHECK(batch->accelerations == Messages{folder.path("3")});
  CHECK(warnings.empty());

  const std::string accepted = "; a batch is a folder with layouts and accelerations";
  CHECK(messages_of(read_batch_folder(folder.path("x"), true, warnings)) ==
        Messages{folder.path("x") + ": no such folder" + accepted});
  CHECK(messages_of(read_batch_folder(folder.path("1"), true, warnings)) ==
        Messages{folder.path("1") + ": not a folder" + accepted});
  folder.write("half/1", kLayout);
  CHECK(messages_of(read_batch_folder(folder.path("half"), true, warnings)) ==
        Messages{folder.path("half") + ": the folder has no accelerations"});
  folder.write("other/1", kAcceleration);
  CHECK(messages_of(read_batch_folder(folder.path("other"), true, warnings)) ==
        Messages{folder.path("other") + ": the folder has no layouts"});
}

}  // namespace input_paths_test
