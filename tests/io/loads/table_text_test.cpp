#include "io/loads/table_text.hpp"

#include <catch2/catch.hpp>

namespace table_text_test {

using namespace holdfast::internal;

namespace {

using Rows = std::vector<std::vector<std::string>>;

Rows rows_of(std::string_view text, char separator) {
  TableText table(text, separator);
  Rows rows;
  while (table.next()) {
    rows.emplace_back();
    for (const TableCell& cell : table.row()) rows.back().emplace_back(cell.text);
  }
  return rows;
}

}  // namespace

TEST_CASE("table_text: cells, quotes and lines as RFC 4180 has them", "[io][loads]") {
  CHECK(rows_of("a,b\r\n1, 2 ,\n", ',') == Rows{{"a", "b"}, {"1", "2", ""}});
  CHECK(rows_of("\"a,b\",\"say \"\"no\"\"\"\n\"two\nlines\",x", ',') ==
        Rows{{"a,b", "say \"no\""}, {"two\nlines", "x"}});
  CHECK(rows_of("\xEF\xBB\xBF"
                "a;b\n\n;;\n# no data\n;1\n",
                ';') == Rows{{"a", "b"}, {"", "1"}});
  CHECK(rows_of("a\tb c\n\t2\n", '\t') == Rows{{"a", "b c"}, {"", "2"}});
  CHECK(rows_of("  a \t \"b c\"  d\n", ' ') == Rows{{"a", "b c", "d"}});
}

TEST_CASE("table_text: places of cells, also after quoted line ends", "[io][loads]") {
  TableText table("a,\"x\ny\",b\nc,d\n", ',');
  REQUIRE(table.next());
  CHECK(table.row()[1].column == 3);
  CHECK(table.row()[2].line == 2);
  CHECK(table.row()[2].column == 4);
  REQUIRE(table.next());
  CHECK(table.row()[1].line == 3);
  CHECK(table.row()[1].column == 3);
}

TEST_CASE("table_text: a quote that does not end, or ends within a cell", "[io][loads]") {
  for (const char* const text : {"a,\"b\n", "\"a\"b,c\n", "\"a\"\"\n"}) {
    TableText table(text, ',');
    CHECK_FALSE(table.next());
    CHECK_FALSE(table.error().empty());
  }
}

TEST_CASE("table_text: what separates cells", "[io][loads]") {
  CHECK(separator_of("a,b\n1,2\n") == ',');
  CHECK(separator_of("a;b\n1,5;2,5\n") == ';');
  CHECK(separator_of("a\tb\n1,5\t2,5\n") == '\t');
  CHECK(separator_of("\"a;b;c\",d\n") == ',');
  CHECK(separator_of("a b\n1 2\n") == ' ');
}

}  // namespace table_text_test
