#include "core/base/number_text.hpp"

#include <catch2/catch.hpp>

namespace number_text_test {

using holdfast::internal::number_text;
using holdfast::internal::parse_integer;
using holdfast::internal::parse_number;
using holdfast::internal::rounded_text;

TEST_CASE("number_text: the whole text must be a finite decimal number", "[core][number_text]") {
  CHECK(parse_number("12") == 12.0);
  CHECK(parse_number("-0.5") == -0.5);
  CHECK(parse_number("+1e-3") == 1e-3);
  CHECK(parse_number("1E3") == 1000.0);
  CHECK(parse_number(".5") == 0.5);
  for (const char* text : {"",    "+",     "-",  "+-1", "++1", "nan",   "inf",    "-inf",   "infinity", "0x10",
                           "1,5", "1.5.2", " 1", "1 ",  "1e",  "1e999", "-1e999", "1e-999", "12cm",     "one"}) {
    INFO(text);
    CHECK(parse_number(text) == std::nullopt);
  }
}

TEST_CASE("number_text: an integer has no decimal point and is in range", "[core][number_text]") {
  CHECK(parse_integer("12") == 12);
  CHECK(parse_integer("+12") == 12);
  CHECK(parse_integer("-3") == -3);
  for (const char* text : {"", "1.0", "1e3", "99999999999999999999", "0x10", "a"}) {
    INFO(text);
    CHECK(parse_integer(text) == std::nullopt);
  }
}

TEST_CASE("number_text: the text of a number is the shortest that reads as the same number", "[core][number_text]") {
  CHECK(number_text(0.1) == "0.1");
  CHECK(number_text(240.0) == "240");
  CHECK(number_text(0.70710678118654757) == "0.7071067811865476");
  CHECK(parse_number(number_text(0.70710678118654757)) == 0.70710678118654757);
  CHECK(rounded_text(12.345678) == "12.35");
  CHECK(rounded_text(587.0) == "587");
  CHECK(rounded_text(28200.0) == "28200");
  CHECK(rounded_text(-107553.2) == "-107553");
  CHECK(rounded_text(1e30) == "1e+30");
}

}  // namespace number_text_test
