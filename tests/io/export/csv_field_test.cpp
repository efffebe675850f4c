#include "io/export/csv_field.hpp"

#include <catch2/catch.hpp>

namespace csv_field_test {

using namespace holdfast::internal;

TEST_CASE("csv_field: what needs quotes has them, and no text is a formula", "[io][csv]") {
  CHECK(csv_field("BR8 ep.txt") == "BR8 ep.txt");
  CHECK(csv_field("a,b") == "\"a,b\"");
  CHECK(csv_field("5\" pipe") == "\"5\"\" pipe\"");
  CHECK(csv_field("") == "");
  CHECK(csv_field("=cmd|'/c calc'!A1") == "\"'=cmd|'/c calc'!A1\"");
  CHECK(csv_field("-1+1") == "\"'-1+1\"");
  CHECK(csv_field("@SUM(A1)") == "\"'@SUM(A1)\"");
  CHECK(csv_field("a-b=c") == "a-b=c");
}

}  // namespace csv_field_test
