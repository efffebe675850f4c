#include "io/input/layout_reader.hpp"

#include <catch2/catch.hpp>

#include "io/input/memory_file.hpp"

namespace layout_reader_test {

using namespace holdfast::internal;
using namespace holdfast::internal::test;

namespace {

Result<Layout> parse(const std::string& text, const Settings& settings = {}) {
  std::vector<Error> warnings;
  return parse_layout(memory_file(text), settings, warnings);
}

/// Messages for a file with a header and these box lines.
Messages errors_of(const std::string& boxes) { return messages_of(parse("1 2\n" + boxes)); }

constexpr const char* kNumber = "; a finite number of cm such as 80 or 12.5";

}  // namespace

TEST_CASE("layout_reader: the published example", "[io][layout_reader]") {
  std::vector<Error> warnings;
  const Result<Layout> layout = parse_layout(memory_file("26281964  18642852\n"
                                                         "0   0  0    80   59  106  1\n"
                                                         "80  0  0    160  59  106  1\n"
                                                         "80  0  106  160  59  212  7\n",
                                                         "in/a.txt"),
                                             Settings{}, warnings);
  REQUIRE(layout);
  CHECK(warnings.empty());
  CHECK(layout->name == "a.txt");
  CHECK(layout->sha256.size() == 64);
  CHECK(layout->header == "26281964  18642852");
  REQUIRE(layout->boxes.size() == 3);
  CHECK(layout->boxes[0].corner_max == Vec3(0.8, 0.59, 1.06));
  CHECK(layout->boxes[1].corner_min.x() == layout->boxes[0].corner_max.x());
  CHECK(layout->boxes[2].corner_min == Vec3(0.8, 0.0, 1.06));
  CHECK(layout->boxes[2].material == 7);
  CHECK(layout->boxes[2].line == 4);
}

TEST_CASE("layout_reader: white space, comments and forms of numbers are accepted", "[io][layout_reader]") {
  const Result<Layout> layout = parse(
      "\xEF\xBB\xBF\r\n# made by hand\r\n  7 \r\n\r\n\t0 0 0\t+8e1  5.9e+1 106.0 1 # first\r\n"
      "   # none\r\n80 0 0 160 59 106 0");
  REQUIRE(layout);
  CHECK(layout->header == "7");
  REQUIRE(layout->boxes.size() == 2);
  CHECK(layout->boxes[0].corner_max == Vec3(0.8, 0.59, 1.06));
  CHECK(layout->boxes[0].line == 5);
  CHECK(layout->boxes[1].line == 7);
}

TEST_CASE("layout_reader: further columns, which nothing names, are one error", "[io][layout_reader]") {
  CHECK(
      messages_of(parse("1\n0 0 0 9 9 9 1\n10 0 0 19 9 9 1 x y\n20 0 0 29 9 9 1 4\n")) ==
      Messages{"a.txt:3:17: more than seven columns, and nothing says what they mean: x; name all columns in the first "
               "line, such as: x1 y1 z1 x2 y2 z2 material weight"});
}

TEST_CASE("layout_reader: other units and axes are those of the settings", "[io][layout_reader]") {
  Settings settings;
  settings.loads.unit = 0.001;
  settings.loads.axes = parse_axes("-z x y");
  const Result<Layout> layout = parse("1\n100 0 70 200 50 470 1\n", settings);
  REQUIRE(layout);
  CHECK((layout->boxes[0].corner_min - Vec3(5.87 - 0.47, 0.1, 0)).norm() < 1e-12);
  CHECK((layout->boxes[0].corner_max - Vec3(5.87 - 0.07, 0.2, 0.05)).norm() < 1e-12);
}

TEST_CASE("layout_reader: coordinates must be finite decimal numbers", "[io][layout_reader]") {
  CHECK(errors_of("0 0 0 nan 9 9 1") == Messages{std::string("a.txt:2:7: x2 of box 1 is not a number: nan") + kNumber});
  CHECK(errors_of("0 0 0 9 inf 9 1") == Messages{std::string("a.txt:2:9: y2 of box 1 is not a number: inf") + kNumber});
  CHECK(errors_of("0x10 0 0 9 9 9 1") ==
        Messages{std::string("a.txt:2:1: x1 of box 1 is not a number: 0x10") + kNumber});
  CHECK(errors_of("0 1,5 0 9 9 9 1") == Messages{std::string("a.txt:2:3: y1 of box 1 is not a number: 1,5") + kNumber});
  CHECK(errors_of("0 0 1e999 9 9 9 1") ==
        Messages{std::string("a.txt:2:5: z1 of box 1 is not a number: 1e999") + kNumber});
  CHECK(errors_of("0 0 0 9 9 9cm 1") ==
        Messages{std::string("a.txt:2:11: z2 of box 1 is not a number: 9cm") + kNumber});
}

TEST_CASE("layout_reader: a corner outside any container is an error", "[io][layout_reader]") {
  Settings open;
  open.container.open_sides = {"front", "rear"};
  const std::string accepted = "; a number of cm from -1000000 to 1000000";
  CHECK(messages_of(parse("1\n-1e300 0 0 1000001 9 9 1", open)) ==
        Messages{"a.txt:2:1: x1 of box 1 is too far away: -1e300" + accepted,
                 "a.txt:2:12: x2 of box 1 is too far away: 1000001" + accepted});
  CHECK(parse("1\n-1000000 0 0 1000000 9 9 1", open));
}

TEST_CASE("layout_reader: the material is an integer from 0", "[io][layout_reader]") {
  for (const std::string bad : {"1.0", "-1", "wood", "2147483648", "99999999999999999999"}) {
    CHECK(errors_of("0 0 0 9 9 9 " + bad) ==
          Messages{"a.txt:2:13: the material of box 1 is not an id: " + bad + "; a whole number from 0 to 2147483647"});
  }
}

TEST_CASE("layout_reader: too few columns, no boxes, an empty file", "[io][layout_reader]") {
  CHECK(errors_of("  0 0 0 9 9 9") == Messages{"a.txt:2:3: box 1 has too few columns: 6; the seven columns are "
                                               "x1 y1 z1 x2 y2 z2 material"});
  CHECK(errors_of("") ==
        Messages{"a.txt: has no boxes; a layout is a header line, then one line per box: x1 y1 z1 x2 y2 z2 material"});
  CHECK(messages_of(parse(" \n# nothing\n")) ==
        Messages{"a.txt: is empty; a layout is a header line, then one line per box: x1 y1 z1 x2 y2 z2 material"});
}

TEST_CASE("layout_reader: a box in the place of the header is an error", "[io][layout_reader]") {
  CHECK(messages_of(parse("0 0 0 80 59 106 1\n80 0 0 160 59 106 1\n")) ==
        Messages{"a.txt:1:1: the header is missing, the first line is a box: 0 0 0 80 59 106 1; the first line is a "
                 "header of numbers, such as the seed and the number of boxes"});
  CHECK(parse("1 2 3 4 5 6 7.5\n0 0 0 80 59 106 1\n"));
  CHECK(parse("1 2 3 1 2 3 7\n0 0 0 80 59 106 1\n"));
}

TEST_CASE("layout_reader: all errors of a file are reported, up to a limit", "[io][layout_reader]") {
  const Messages two = errors_of("a 0 0 9 9 9 b\n0 0 0\n");
  REQUIRE(two.size() == 3);
  CHECK(two[0] == std::string("a.txt:2:1: x1 of box 1 is not a number: a") + kNumber);
  CHECK(two[1] == "a.txt:2:13: the material of box 1 is not an id: b; a whole number from 0 to 2147483647");
  CHECK(two[2] == "a.txt:3:1: box 2 has too few columns: 3; the seven columns are x1 y1 z1 x2 y2 z2 material");

  std::string many;
  for (int i = 0; i < 50; ++i) many += "0 0 0\n";
  const Messages capped = errors_of(many);
  REQUIRE(capped.size() == 21);
  CHECK(capped.back() == "a.txt: further errors: 30");
}

TEST_CASE("layout_reader: the geometry is checked", "[io][layout_reader]") {
  CHECK(errors_of("0 0 0 80 59 106 1\n79 0 0 160 59 106 1") ==
        Messages{
            "a.txt:3: box 2 overlaps box 1 of line 2: 10 mm deep; boxes may touch; up to 0.1 mm is taken as rounding"});
  CHECK(errors_of("0 0 0 80 59 0 1") == Messages{"a.txt:2: box 1 has no height: 0 cm; the second corner must be beyond "
                                                 "the first along every axis, by more than 0.1 mm"});
  CHECK(errors_of("0 0 0 600 59 100 1") ==
        Messages{"a.txt:2: box 1 is outside the container at the rear: 130 mm; the container is 587 x 233 x 220 cm"});
}

TEST_CASE("layout_reader: a layout with y up is rotated, not mirrored", "[io][layout_reader]") {
  Settings settings;
  settings.up_axis = UpAxis::y;
  // A box at the origin of the file, and one on top of it at the other end of z.
  const Result<Layout> layout = parse("1\n0 0 0 80 106 59 1\n0 106 174 80 212 233 1\n", settings);
  REQUIRE(layout);
  CHECK(layout->boxes[0].corner_min == Vec3(0.0, 2.33 - 0.59, 0.0));
  CHECK(layout->boxes[0].corner_max == Vec3(0.8, 2.33, 1.06));
  CHECK(layout->boxes[1].corner_min == Vec3(0.0, 0.0, 1.06));
  CHECK(layout->boxes[1].corner_max == Vec3(0.8, 2.33 - 1.74, 2.12));
  // The images of the file's axes are right-handed.
  const Vec3 x(1, 0, 0), y(0, 0, 1), z(0, -1, 0);
  CHECK(x.cross(y) == z);
}

TEST_CASE("layout_reader: a full width with y up touches both walls exactly", "[io][layout_reader]") {
  Settings settings;
  settings.up_axis = UpAxis::y;
  std::vector<Error> warnings;
  const TextFile file = memory_file("1\n0 0 0 587 220 77.7 1\n0 0 77.7 587 220 155.4 1\n0 0 155.4 587 220 233 1\n");
  const Result<Layout> layout = parse_layout(file, settings, warnings);
  REQUIRE(layout);
  CHECK(warnings.empty());
  CHECK(layout->boxes[0].corner_min.y() == layout->boxes[1].corner_max.y());
}

TEST_CASE("layout_reader: control characters in a file do not reach messages", "[io][layout_reader]") {
  CHECK(errors_of(std::string("\x89HDF\0 0 0 1 1 1 1", 17)).front() ==
        std::string("a.txt:2:1: x1 of box 1 is not a number: ?HDF?") + kNumber);
}

}  // namespace layout_reader_test
