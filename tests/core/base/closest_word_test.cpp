#include "core/base/closest_word.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <string>

namespace closest_word_test {

using holdfast::internal::closest_word;

TEST_CASE("closest_word: a typing error finds the word, another word finds nothing", "[core][closest_word]") {
  const std::array<std::string_view, 4> words{"BoxFriction", "GroundFriction", "Mass", "TimeoutInSeconds"};
  CHECK(closest_word("BoxFricton", words) == "BoxFriction");
  CHECK(closest_word("boxfriction", words) == "BoxFriction");
  CHECK(closest_word("BoxFirction", words) == "BoxFriction");
  CHECK(closest_word("TimeOutSeconds", words) == "TimeoutInSeconds");
  CHECK(closest_word("Masse", words) == "Mass");
  CHECK(closest_word("Colour", words) == std::nullopt);
  CHECK(closest_word("", words) == std::nullopt);
  CHECK(closest_word("x", words) == std::nullopt);
  CHECK(closest_word(std::string(100000, 'a'), words) == std::nullopt);
}

TEST_CASE("closest_word: a swap of neighbours is one error", "[core][closest_word]") {
  const std::array<std::string_view, 2> words{"form", "foam"};
  CHECK(closest_word("from", words) == "form");
}

}  // namespace closest_word_test
