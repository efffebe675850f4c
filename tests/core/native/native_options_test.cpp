#include "core/native/native_options.hpp"

#include <catch2/catch.hpp>
#include <string_view>
#include <type_traits>

namespace native_options_test {

using namespace holdfast::internal;

TEST_CASE("native_options: every field is visited once, under its name", "[core][native_options]") {
  native::NativeOptions options;
  options.small_island.slip_end_cuts = 1234;
  int fields = 0, efforts = 0;
  native::visit_fields(options, [&]<class Value>(std::string_view name, const Value& value) {
    ++fields;
    if constexpr (std::is_same_v<Value, native::Effort>) {
      ++efforts;
      native::visit_fields(value, [&](std::string_view of_effort, auto number) {
        if (name == "small_island") CHECK((number == 1234) == (of_effort == "slip_end_cuts"));
      });
    }
  });
  CHECK(fields == 7);
  CHECK(efforts == 2);
}

}  // namespace native_options_test
