#include "core/base/utf8.hpp"

#include <catch2/catch.hpp>
#include <string>

namespace utf8_test {

using namespace holdfast::internal;

TEST_CASE("utf8: a name that is kept stays the same when it is kept again", "[core][utf8]") {
  const std::string long_word(119, 'a');
  CHECK(kept_name("  Pump; left \t") == "Pump; left");
  CHECK(kept_name(long_word + " b") == long_word);  // white space where it is cut
  CHECK(kept_name(long_word + "ä") == long_word);   // a character of two bytes
  CHECK(kept_name("K\xFChlger\xE4t") == "K\xEF\xBF\xBDhlger\xEF\xBF\xBDt");
  for (const std::string& name :
       {long_word + " b", long_word + "\tb", std::string("\xEE\xEE x\n1\t2"), std::string(" \v")})
    CHECK(kept_name(kept_name(name)) == kept_name(name));
}

TEST_CASE("utf8: surrogates, overlong and cut characters are none", "[core][utf8]") {
  CHECK(utf8_length("a") == 1);
  CHECK(utf8_length("ä") == 2);
  CHECK(utf8_length("长") == 3);
  CHECK(utf8_length("\xF0\x9F\x9A\x9A") == 4);
  for (const char* const text : {"\x80", "\xC0\x80", "\xED\xA0\x80", "\xF4\x90\x80\x80", "\xE9\x95", "\xFF"})
    CHECK(utf8_length(text) == 0);
}

TEST_CASE("utf8: letters of ASCII alone become lower case", "[core][utf8]") {
  CHECK(lower_case("Kühl CONTAINER-40'HC ÄÖ") == "kühl container-40'hc ÄÖ");
  CHECK(lower_case("").empty());
}

}  // namespace utf8_test
