#include "io/input/text_lines.hpp"

#include <catch2/catch.hpp>

namespace text_lines_test {

using namespace holdfast::internal;

TEST_CASE("text_lines: lines end with LF or CRLF and are counted from 1", "[io][text_lines]") {
  LineReader lines("\xEF\xBB\xBFone\r\n\ntwo");
  REQUIRE(lines.next());
  CHECK(lines.line() == "one");
  CHECK(lines.number() == 1);
  REQUIRE(lines.next());
  CHECK(lines.line().empty());
  REQUIRE(lines.next());
  CHECK(lines.line() == "two");
  CHECK(lines.number() == 3);
  CHECK_FALSE(lines.next());
  CHECK_FALSE(LineReader("").next());
}

TEST_CASE("text_lines: fields have their columns, and end at comments", "[io][text_lines]") {
  std::vector<Field> fields;
  split_fields("\t12  a b# c", fields);
  REQUIRE(fields.size() == 3);
  CHECK(fields[0].text == "12");
  CHECK(fields[0].column == 2);
  CHECK(fields[2].text == "b");
  CHECK(fields[2].column == 8);
  split_fields("  # nothing", fields);
  CHECK(fields.empty());
}

TEST_CASE("text_lines: the text in a message is short and printable", "[io][text_lines]") {
  CHECK(shown("12,5") == "12,5");
  CHECK(shown("a\x1b[2Jb\tc") == "a?[2Jb?c");
  CHECK(shown(std::string(61, 'x')) == std::string(60, 'x') + "...");
  CHECK(shown(std::string(60, 'x')) == std::string(60, 'x'));
  CHECK(shown(std::string(59, 'x') + "°°") == std::string(59, 'x') + "...");
  CHECK(shown("°C \xff\xc2") == "°C ??");
  CHECK(trimmed(" \ta b\r") == "a b");
  CHECK(trimmed(" ").empty());
}

}  // namespace text_lines_test
