#include "io/input/announced_boxes.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <string>

#include "io/input/input_paths.hpp"
#include "io/input/layout_reader.hpp"
#include "io/input/memory_file.hpp"

namespace announced_boxes_test {

using namespace holdfast::internal;
using namespace holdfast::internal::test;

namespace {

using Count = std::optional<std::size_t>;

Count contradicted(const std::string& header, std::size_t found) {
  std::vector<Field> fields;
  split_fields(header, fields);
  return contradicted_count(fields, found);
}

}  // namespace

TEST_CASE("announced_boxes: a count in words must be that of the file", "[io][announced_boxes]") {
  CHECK(contradicted("7 boxes", 7) == Count());
  CHECK(contradicted("7 boxes", 6) == Count(7));
  CHECK(contradicted("7 boxes", 8) == Count(7));
  CHECK(contradicted("1 box # seed 4", 2) == Count(1));
  CHECK(contradicted("7 boxes of 3 kinds", 3) == Count(7));
}

TEST_CASE("announced_boxes: of two integers the second is the count, or the first", "[io][announced_boxes]") {
  CHECK(contradicted("30 77", 77) == Count());
  CHECK(contradicted("30 77", 30) == Count());
  CHECK(contradicted("30\t77", 76) == Count(77));
  CHECK(contradicted("30 0", 4) == Count(0));
  CHECK(contradicted("26281964 18642852", 3) == Count());
  CHECK(contradicted("26281964 20001", 3) == Count());
  CHECK(contradicted("26281964 20000", 3) == Count(20000));
}

TEST_CASE("announced_boxes: other headers announce nothing", "[io][announced_boxes]") {
  for (const char* header : {"", "7", "30 -7", "30 7.5", "1 2 3", "a loading of 7 boxes", "seed=12 boxes=1", "box 7"}) {
    INFO(header);
    CHECK(contradicted(header, 5) == Count());
  }
}

TEST_CASE("announced_boxes: a truncated layout gives a warning with both numbers", "[io][announced_boxes]") {
  std::vector<Error> warnings;
  REQUIRE(parse_layout(memory_file("# made by hand\n3 boxes\n0 0 0 9 9 9 1\n10 0 0 19 9 9 1\n"), Settings{}, warnings));
  CHECK(messages_of(warnings) ==
        Messages{"a.txt:2: the header announces 3 boxes and the file has 2, as in a truncated copy"});
}

TEST_CASE("announced_boxes: the layouts that come with the program agree with their headers", "[io][announced_boxes]") {
  const std::string source = HOLDFAST_SOURCE_DIR;
  std::size_t count = 0;
  for (const char* folder : {"/configs/layouts", "/bench/layouts", "/bench/layouts_unstable"}) {
    for (const auto& entry : std::filesystem::directory_iterator(source + folder)) {
      const Result<TextFile> file = read_text_file(entry.path().string());
      REQUIRE(file);
      std::vector<Error> warnings;
      CHECK(parse_layout(*file, Settings{}, warnings));
      CHECK(warnings.empty());
      ++count;
    }
  }
  CHECK(count > 30);
}

}  // namespace announced_boxes_test
