#include "app/serve/layout_request.hpp"

#include <catch2/catch.hpp>

namespace layout_request_test {

using namespace holdfast::internal;

namespace {

const std::vector<std::string> kNames = {"brake.txt", "corner.txt"};

LayoutRequest good(std::string_view line) {
  const ReadRequest read = read_request(line, kNames);
  INFO(line);
  INFO((read.error ? read.error->message() : ""));
  REQUIRE(!read.error);
  return read.request;
}

struct Mistake {
  std::string line;
  long column;
  long box, number;  // from 1; 0: none
  std::string what, value;
};

}  // namespace

TEST_CASE("layout_request: boxes, and everything that is optional", "[app][layout_request]") {
  const LayoutRequest plain = good(R"({"boxes": [[0,0,0,1,2,3.5,1],[ -1e-3 ,0,0,1,2,3,2.0]]})");
  CHECK(plain.id == "null");
  CHECK(plain.numbers == std::vector<double>{0, 0, 0, 1, 2, 3.5, 1, -1e-3, 0, 0, 1, 2, 3, 2});
  CHECK(plain.options == RequestOptions{});

  const LayoutRequest all = good(
      R"({"series":true,"per_box":true,"accelerations":["corner.txt","brake.txt"],"unit":"cm","boxes":[],"id":7})");
  CHECK(all.id == "7");
  CHECK(all.numbers.empty());
  CHECK(all.options == RequestOptions{holdfast::LengthUnit::centimetre, {1, 0}, true, true});
  CHECK(good(R"({"unit":"m","boxes":[]})").options == RequestOptions{});
}

TEST_CASE("layout_request: a zero byte does not hide the rest of a line", "[app][layout_request]") {
  const std::string line = std::string("{\"boxes\":[]}") + '\0' + "{\"boxes\":1}";
  const ReadRequest read = read_request(line, kNames);
  REQUIRE(read.error);
  CHECK(read.error->what == "the line has a zero byte");
}

TEST_CASE("layout_request: an id is any JSON, and kept as it is written", "[app][layout_request]") {
  for (const std::string id :
       {"1", "-1.50e+3", "18446744073709551616123", "null", "true", "\"a \\\"b\\\" \\u00e4,\"",
        "[ 1, [2], {\"a\": []} ]", "{\"boxes\": [1, \"unit\"], \"x\": {\"id\": 3}}", "[]", "{}", "\"\""}) {
    CHECK(good("{\"id\" : " + id + " , \"boxes\":[]}").id == id);
    CHECK(good("{\"boxes\":[],\"id\":" + id + "}").id == id);
  }
}

TEST_CASE("layout_request: an id is JSON also where the line goes wrong after it", "[app][layout_request]") {
  for (const auto& [text, id] : std::vector<std::pair<std::string, std::string>>{
           {"1-2", "1"}, {"-01", "-0"}, {"1.5e+3.2", "1.5e+3"}, {"2+", "2"}, {"7e1e", "7e1"}}) {
    const ReadRequest read = read_request("{\"id\":" + text, kNames);
    CAPTURE(text);
    CHECK(read.error);
    CHECK(read.request.id == id);
  }
}

TEST_CASE("layout_request: an id stays on one line for any reader", "[app][layout_request]") {
  CHECK(good("{\"boxes\":[],\"id\":[1,\r\t2]}").id == "[1, \t2]");
}

TEST_CASE("layout_request: a mistake is named by its column, box and number", "[app][layout_request]") {
  const std::vector<Mistake> mistakes = {
      {"", 1, 0, 0, "the line ends within its JSON", ""},
      {"hello, world", 1, 0, 0, "the line is not JSON", "hello"},
      {"{\"boxes\": [[0,0,0,1,1,NaN,1]]}", 23, 1, 6, "the line is not JSON", "NaN"},
      {"{\"boxes\": [[0,0,0,1,1, -Infinity,1]]}", 24, 1, 6, "the line is not JSON", "-Infinity"},
      {"{\"boxes\": [[0,0,0,1,1,1e999,1]]}", 23, 1, 6, "a number that is too large", "1e999"},
      {"{\"boxes\": [[0,0,0,1,,1,1]]}", 21, 1, 5, "the line is not JSON", ",1"},
      {"{\"boxes\": [[0,0", 16, 1, 3, "the line ends within its JSON", ""},
      {"{\"boxes\": []} {}", 15, 0, 0, "the line is not JSON", "{"},
      {"[1]", 1, 0, 0, "the line is not an object", "["},
      {"3", 1, 0, 0, "the line is not an object", "3"},
      {"{}", 2, 0, 0, "boxes are missing", ""},
      {"{\"boxes\": 3}", 11, 0, 0, "boxes are not a list", "3"},
      {"{\"boxes\": {\"a\": [1]}}", 11, 0, 0, "boxes are not a list", "{"},
      {"{\"boxes\": [3]}", 12, 1, 0, "box 1 is neither a list nor an object", "3"},
      {"{\"boxes\": [[0,0,0,1,1,1,1], [0,0,0,1,1,1]]}", 29, 2, 0, "box 2 does not have seven numbers", "6 numbers"},
      {"{\"boxes\": [[0,0,0,1,1,1,1,8]]}", 12, 1, 0, "box 1 does not have seven numbers", "8 numbers"},
      {"{\"boxes\": [[0,0,0,1,\"1\",1,1]]}", 21, 1, 5, "y2 of box 1 is not a number", "\"1\""},
      {"{\"boxes\": [[0,0,0,1,1,1,null]]}", 25, 1, 7, "material of box 1 is not a number", "null"},
      {"{\"boxes\": [[0,[0],0,1,1,1,1]]}", 15, 1, 2, "y1 of box 1 is not a number", "["},
      {"{\"boxes\": [], \"unit\": \"yd\"}", 23, 0, 0, "unknown unit", "\"yd\""},
      {"{\"boxes\": [], \"boxes\": []}", 15, 0, 0, "a key that is given twice", "boxes"},
      {"{\"boxes\": [], \"serie\": 1}", 15, 0, 0, "unknown key", "serie"},
      {"{\"boxes\": [], \"series\": 1}", 25, 0, 0, "series is neither true nor false", "1"},
      {"{\"boxes\": [], \"per_box\": []}", 26, 0, 0, "per_box is neither true nor false", "["},
      {"{\"boxes\": [], \"accelerations\": [\"brake.txt\", \"b\"]}", 46, 0, 0, "unknown acceleration", "\"b\""},
      {"{\"boxes\": [], \"accelerations\": [[\"brake.txt\"]]}", 33, 0, 0, "unknown acceleration", "["},
      {"{\"boxes\": [], \"accelerations\": [\"brake.txt\", \"brake.txt\"]}", 46, 0, 0,
       "an acceleration that is named twice", "\"brake.txt\""},
      {"{\"boxes\": [], \"accelerations\": []}", 33, 0, 0, "no acceleration", ""},
      {"{\"boxes\": [], \"accelerations\": 1}", 32, 0, 0, "accelerations are not a list", "1"},
  };
  for (const Mistake& mistake : mistakes) {
    INFO(mistake.line);
    const ReadRequest read = read_request(mistake.line, kNames);
    REQUIRE(read.error);
    CHECK(read.error->what == mistake.what);
    CHECK(read.error->value == mistake.value);
    CHECK(read.error->column == mistake.column);
    CHECK(read.error->box == mistake.box);
    CHECK(read.error->box_number == mistake.number);
  }
}

TEST_CASE("layout_request: the id is known where a mistake comes before it", "[app][layout_request]") {
  CHECK(read_request(R"({"boxes": [[true]], "unit": 1, "id": [1, 2]})", kNames).request.id == "[1, 2]");
  CHECK(read_request(R"({"id": "a", "boxes": [[)", kNames).request.id == "\"a\"");
}

TEST_CASE("layout_request: lists that are as deep as a line is long", "[app][layout_request]") {
  const std::string deep(1'000'000, '[');
  CHECK(read_request(deep, kNames).error);
  CHECK(read_request("{\"boxes\":" + deep, kNames).error);
  const std::string id = deep + std::string(deep.size(), ']');
  CHECK(good("{\"boxes\":[],\"id\":" + id + "}").id == id);
}

TEST_CASE("layout_request: where a number stands in its line", "[app][layout_request]") {
  const std::string line = R"({"boxes": [[10,11,12,13,14,15,16], [ 20 , 21, 22,23,24,25,26 ]]})";
  const LayoutRequest request = good(line);
  for (int box = 0; box < 2; ++box)
    for (int number = 0; number < 7; ++number) {
      const long column = column_of(line, request, box, number);
      REQUIRE(column > 0);
      CHECK(line.substr(static_cast<std::size_t>(column) - 1, 2) == std::to_string(10 * (box + 1) + number));
    }
  CHECK(column_of(line, request, 1, -1) == 36);
  CHECK(column_of(line, request, -1, -1) == 0);
  CHECK(column_of(line, request, 2, 0) == 0);
}

}  // namespace layout_request_test
