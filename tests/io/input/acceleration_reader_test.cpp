#include "io/input/acceleration_reader.hpp"

#include <catch2/catch.hpp>

#include "io/input/memory_file.hpp"

namespace acceleration_reader_test {

using namespace holdfast::internal;
using namespace holdfast::internal::test;

namespace {

Result<Acceleration> parse(const std::string& text) {
  std::vector<Error> warnings;
  return parse_acceleration(memory_file(text), warnings);
}

Messages errors_of(const std::string& text) { return messages_of(parse(text)); }

Messages warnings_of(const std::string& text) {
  std::vector<Error> warnings;
  REQUIRE(parse_acceleration(memory_file(text), warnings));
  return messages_of(warnings);
}

}  // namespace

TEST_CASE("acceleration_reader: the published example", "[io][acceleration_reader]") {
  const Result<Acceleration> acceleration = parse(
      "#Initial-Time / Duration / X / Y / Z\n"
      "0     1     0  0  0\n"
      "1     0.3   1  0  0\n"
      "1.3   12    2  0  0\n"
      "13.3  0.35  2  0  -1e-1\n");
  REQUIRE(acceleration);
  CHECK(acceleration->name == "a.txt");
  CHECK(acceleration->sha256.size() == 64);
  REQUIRE(acceleration->segments.size() == 4);
  CHECK(acceleration->segments[3].acceleration == Vec3(2, 0, -0.1));
  CHECK(acceleration->segments[3].line == 5);
  CHECK(acceleration->end_time() == Approx(13.65));
}

TEST_CASE("acceleration_reader: a first line may say that values are in g", "[io][acceleration_reader]") {
  const Result<Acceleration> acceleration = parse("# by hand\nunit g\n0 1 0.8 0 -0.5\n");
  REQUIRE(acceleration);
  CHECK(acceleration->segments[0].acceleration == 9.81 * Vec3(0.8, 0, -0.5));
  CHECK(acceleration->segments[0].line == 3);
  CHECK(parse("unit m/s2\n0 1 0.8 0 0\n")->segments[0].acceleration == Vec3(0.8, 0, 0));
  CHECK(messages_of(parse("unit k\n0 1 1 0 0\n").errors()) ==
        Messages{"a.txt:1:6: no unit of acceleration: k; unit g, or unit m/s2"});
  CHECK_FALSE(parse("0 1 1 0 0\nunit g\n"));
}

TEST_CASE("acceleration_reader: values that are as small as those of norms in g are told",
          "[io][acceleration_reader]") {
  CHECK(
      warnings_of("0 1 0 0 0\n1 1 0.8 0 0\n2 1 0 -0.5 0\n") ==
      Messages{"a.txt: the values are in m/s², and the largest along the floor is small: 0.8 m/s²; if they are in g: a "
               "first line 'unit g'; 'unit m/s2' says that they are meant"});
  CHECK(warnings_of("0 1 0.6 0 -1\n").size() == 1);
  for (const char* const text : {"0 1 7.848 0 0\n", "0 1 1 0 0\n", "0 1 2 0 0\n", "0 1 0 0 -1\n", "0 1 0.01 0 0\n",
                                 "unit g\n0 1 0.8 0 0\n", "unit m/s2\n0 1 0.8 0 0\n"})
    CHECK(warnings_of(text).empty());
}

TEST_CASE("acceleration_reader: gravity in z, as accelerometers record it, is told", "[io][acceleration_reader]") {
  CHECK(warnings_of("0 1 0 0 9.81\n1 1 7.848 0 9.7\n") ==
        Messages{"a.txt: z seems to have gravity in it, which loads have anyway: mean 9.755 m/s²; 0 on a level road; "
                 "take 9.81 m/s² off z, with its sign"});
  CHECK(warnings_of("unit g\n0 1 0.8 0 -1\n").size() == 1);
  for (const char* const text : {"0 1 7.848 0 0\n", "0 1 2 0 -7.848\n", "0 0.1 2 0 9.81\n0.1 1 2 0 0\n"})
    CHECK(warnings_of(text).empty());
}

TEST_CASE("acceleration_reader: white space, comments and gaps are accepted", "[io][acceleration_reader]") {
  const Result<Acceleration> acceleration = parse("\xEF\xBB\xBF\t0.5\t1 +1 0 0 # brake\r\n\r\n#\r\n  3 1 0 0 0");
  REQUIRE(acceleration);
  REQUIRE(acceleration->segments.size() == 2);
  CHECK(acceleration->segments[0].start == 0.5);
  CHECK(acceleration->segments[1].line == 4);
}

TEST_CASE("acceleration_reader: gaps and overlaps below an instant are closed", "[io][acceleration_reader]") {
  const Result<Acceleration> acceleration = parse("0 0.1 1 0 0\n0.1 0.2 2 0 0\n0.3 0.1 3 0 0\n0.4000000005 1 4 0 0\n");
  REQUIRE(acceleration);
  for (std::size_t i = 1; i < 4; ++i)
    CHECK(acceleration->segments[i].start ==
          acceleration->segments[i - 1].start + acceleration->segments[i - 1].duration);
}

TEST_CASE("acceleration_reader: overlap and order", "[io][acceleration_reader]") {
  CHECK(
      errors_of("0 1 0 0 0\n# c\n 0.75 1 1 0 0\n") ==
      Messages{"a.txt:3:2: the segment overlaps that of line 1: starts at 0.75 s; at least 1 s, where that one ends"});
  CHECK(
      errors_of("2 1 0 0 0\n0 1 1 0 0\n") ==
      Messages{
          "a.txt:2:1: the segment is before that of line 1: starts at 0 s; segments are in the order of their times"});
  CHECK(errors_of("2 1 0 0 0\n2 1 1 0 0\n") ==
        Messages{"a.txt:2:1: the segment overlaps that of line 1: starts at 2 s; at least 3 s, where that one ends"});
}

TEST_CASE("acceleration_reader: columns must be finite decimal numbers", "[io][acceleration_reader]") {
  CHECK(errors_of("zero 1 0 0 0") ==
        Messages{"a.txt:1:1: the initial time is not a number: zero; a finite number of s"});
  CHECK(errors_of("0 1,5 0 0 0") == Messages{"a.txt:1:3: the duration is not a number: 1,5; a finite number of s"});
  CHECK(errors_of("0 1 nan 0 0") == Messages{"a.txt:1:5: ax is not a number: nan; a finite number of m/s²"});
  CHECK(errors_of("0 1 0 -inf 0") == Messages{"a.txt:1:7: ay is not a number: -inf; a finite number of m/s²"});
  CHECK(errors_of("0 1 0 0 0x10") == Messages{"a.txt:1:9: az is not a number: 0x10; a finite number of m/s²"});
}

TEST_CASE("acceleration_reader: times must be in range", "[io][acceleration_reader]") {
  CHECK(errors_of("-1 1 0 0 0") == Messages{"a.txt:1:1: the initial time is negative: -1; a time of at least 0 s"});
  CHECK(errors_of("0 0 0 0 0") == Messages{"a.txt:1:3: the duration is too short: 0; a duration of at least 1e-9 s"});
  CHECK(errors_of("0 -2 0 0 0") == Messages{"a.txt:1:3: the duration is too short: -2; a duration of at least 1e-9 s"});
}

TEST_CASE("acceleration_reader: impossible values are errors", "[io][acceleration_reader]") {
  CHECK(errors_of("0 1e300 0 0 0") == Messages{"a.txt:1:3: the time is too large: 1e300; times of at most 1e6 s"});
  const std::string accepted = "; accelerations from -10000 to 10000 m/s²";
  CHECK(errors_of("0 1 0 1e300 0") == Messages{"a.txt:1:7: ay is too large: 1e300" + accepted});
  CHECK(errors_of("0 1 0 0 -10000.5") == Messages{"a.txt:1:9: az is too large: -10000.5" + accepted});
  CHECK(parse("0 1 10000 -10000 0"));
}

TEST_CASE("acceleration_reader: five columns, at least one segment", "[io][acceleration_reader]") {
  const std::string columns = "; the five columns are initial-time duration ax ay az";
  CHECK(errors_of("0 1 0 0") == Messages{"a.txt:1:1: too few columns: 4" + columns});
  CHECK(errors_of("0 1 0 0 0 0\n1 1") ==
        Messages{"a.txt:1:1: too many columns: 6" + columns, "a.txt:2:1: too few columns: 2" + columns});
  const std::string lines = "; an acceleration has one line per segment: initial-time duration ax ay az";
  CHECK(errors_of("") == Messages{"a.txt: is empty" + lines});
  CHECK(errors_of("# only a header\n") == Messages{"a.txt: has no segments" + lines});
}

}  // namespace acceleration_reader_test
