#include "io/loads/load_file.hpp"

#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "io/input/memory_file.hpp"
#include "io/loads/load_json.hpp"
#include "io/loads/load_writer.hpp"

namespace load_file_test {

using namespace holdfast::internal;
using test::memory_file;
using test::Messages;
using test::messages_of;

namespace {

const std::string kFormats = std::string(HOLDFAST_SOURCE_DIR) + "/tests/io/loads/formats/";

TextFile format_file(const std::string& name) {
  Result<TextFile> file = read_text_file(kFormats + name);
  REQUIRE(file);
  return *file;
}

LoadsOfFile loads_of(const std::string& text, const Settings& settings = {}, const std::string& path = "a.csv") {
  Result<LoadsOfFile> loads = read_loads(memory_file(text, path), settings);
  if (!loads) FAIL(loads.error().message());
  return std::move(*loads);
}

Messages all_errors(const std::string& text, const Settings& settings = {}, const std::string& path = "a.csv") {
  const Result<LoadsOfFile> loads = read_loads(memory_file(text, path), settings);
  if (!loads) return messages_of(loads.errors());
  Messages messages;
  for (const ReadLoad& load : loads->loads)
    for (const std::string& message : messages_of(load.errors)) messages.push_back(message);
  return messages;
}

void check_vector(const nlohmann::json& expected, const Vec3& read) {
  const Vec3 wanted(expected.at(0), expected.at(1), expected.at(2));
  INFO(wanted.transpose() << " against " << read.transpose());
  CHECK((wanted - read).cwiseAbs().maxCoeff() < 2e-6);
}

/// Compares what is read of a file with its description.
/// @param trimmed the description has corners before overlaps are trimmed, m
void check_format(const std::string& name, const std::string& stem, const Settings& settings, double trimmed = 0.0) {
  INFO(name);
  std::ifstream description(kFormats + "expected/" + stem + ".json");
  const nlohmann::json expected = nlohmann::json::parse(description);
  const Result<LoadsOfFile> read = read_loads(format_file(name), settings);
  REQUIRE(read);
  REQUIRE(read->loads.size() == expected["loads"].size());
  for (std::size_t i = 0; i < read->loads.size(); ++i) {
    const ReadLoad& load = read->loads[i];
    const nlohmann::json& wanted = expected["loads"][i];
    INFO(messages_of(load.errors).size());
    REQUIRE(messages_of(load.errors) == Messages{});
    CHECK(load.layout.name == wanted["name"].get<std::string>());
    const Vec3 container = container_of(settings, load.layout).size;
    if (wanted["container"].is_array())
      check_vector(wanted["container"], container);
    else
      CHECK_FALSE(load.layout.container);
    REQUIRE(load.layout.boxes.size() == wanted["boxes"].size());
    for (std::size_t k = 0; k < load.layout.boxes.size(); ++k) {
      const Box& box = load.layout.boxes[k];
      const nlohmann::json& given = wanted["boxes"][k];
      if (trimmed == 0.0) {
        check_vector(given["corner_min"], box.corner_min);
        check_vector(given["corner_max"], box.corner_max);
      } else {
        const Vec3 low(given["corner_min"][0], given["corner_min"][1], given["corner_min"][2]);
        CHECK((low - box.corner_min).cwiseAbs().maxCoeff() < trimmed);
      }
      if (given.contains("name")) CHECK(box.name == given["name"].get<std::string>());
      if (given.contains("mass")) CHECK(box.mass == Approx(given["mass"].get<double>()));
      if (given.contains("material")) CHECK(box.material.text() == given["material"].get<std::string>());
      if (given.contains("order")) CHECK(box.order == given["order"].get<long>());
    }
  }
}

/// What is said of a file and its loads.
std::string said_of(const LoadsOfFile& loads) {
  std::string said;
  for (const Error& note : loads.notes) said += note.message() + '\n';
  for (const ReadLoad& load : loads.loads)
    for (const Error& warning : load.warnings) said += warning.message() + '\n';
  return said;
}

}  // namespace

TEST_CASE("load_file: a spreadsheet with semicolons and decimal commas", "[io][loads]") {
  check_format("spreadsheet_semicolon.csv", "spreadsheet_semicolon", {});
}

TEST_CASE("load_file: a planner's export, which counts from the door and has two containers", "[io][loads]") {
  Settings settings;
  SECTION("by its axes") { settings.loads.axes = parse_axes("-z x y"); }
  SECTION("by its format") { settings.loads.format = "planner"; }
  check_format("planner_export.csv", "planner_export", settings);
  const Result<LoadsOfFile> read = read_loads(format_file("planner_export.csv"), settings);
  CHECK(said_of(*read).find("1 item is not placed: Reel spare") != std::string::npos);
  CHECK(read->loads[0].layout.container->type == "40hc");
}

TEST_CASE("load_file: a file whose items are all not placed has no boxes", "[io][loads]") {
  for (const char* const text : {"name,x,y,z,length,width,height\na,,,,10,10,10\nb,,,,10,10,10\n",
                                 R"([{"id": "a", "x": "", "y": "", "z": "", "length": 1, "width": 1, "height": 1},
                                     {"id": "b", "x": "", "y": "", "z": "", "length": 1, "width": 1, "height": 1}])"}) {
    const Result<LoadsOfFile> read = read_loads({.path = "a", .name = "a", .text = text}, {});
    REQUIRE_FALSE(read);
    CHECK(read.error().message() == "a: has no boxes: 2 items are not placed");
  }
}

TEST_CASE("load_file: without axes the planner's export is told what it needs", "[io][loads]") {
  const Result<LoadsOfFile> read = read_loads(format_file("planner_export.csv"), {});
  REQUIRE(read);
  REQUIRE(read->loads[0].errors.size() == 1);
  CHECK(read->loads[0].errors[0].accepted.find("--axes \"-z x y\"") != std::string::npos);
}

TEST_CASE("load_file: a solver's bins, whose rows give sizes", "[io][loads]") {
  check_format("solver_bins.csv", "solver_bins", {});
}

TEST_CASE("load_file: orders as keys of JSON, units in keys, turned items", "[io][loads]") {
  check_format("order_plan.json", "order_plan", {});
}

TEST_CASE("load_file: a packer's middles with y upwards, in metres as its truck tells", "[io][loads]") {
  Settings settings;
  settings.up_axis = UpAxis::y;
  check_format("packer_yup.json", "packer_yup", settings);
  CHECK(said_of(*read_loads(format_file("packer_yup.json"), settings)).find("taken as m") != std::string::npos);
}

TEST_CASE("load_file: crates that nest are trimmed at their tops, and keep their masses", "[io][loads]") {
  check_format("nested_crates.csv", "nested_crates", {});
}

TEST_CASE("load_file: inches, with an overlap of their rounding", "[io][loads]") {
  Settings settings;
  settings.loads.unit = 0.0254;
  check_format("inches.txt", "inches", settings, 1e-4);
  const std::string said = said_of(*read_loads(format_file("inches.txt"), settings));
  CHECK(said.find("box 2 and box 3 by 0.127 mm") != std::string::npos);
}

TEST_CASE("load_file: a load is the same in every kind of file", "[io][loads]") {
  Settings settings;
  settings.loads.format = "planner";
  std::vector<Layout> loads;
  const Result<LoadsOfFile> planned = read_loads(format_file("planner_export.csv"), settings);
  const Result<LoadsOfFile> spread = read_loads(format_file("spreadsheet_semicolon.csv"), {});
  for (const LoadsOfFile& file : {*planned, *spread})
    for (const ReadLoad& load : file.loads) loads.push_back(load.layout);
  loads[1].boxes[0].mat = 0.6;
  loads[1].boxes[0].fixed = true;
  loads[1].boxes[0].bearing_limit = 1200.0;
  loads[1].boxes[0].order = 7;
  for (const std::string path : {"out.json", "out.csv"}) {
    const Result<std::string> text = loads_text(loads, path);
    REQUIRE(text);
    const LoadsOfFile read = loads_of(*text, {}, path);
    REQUIRE(read.loads.size() == loads.size());
    for (std::size_t i = 0; i < loads.size(); ++i) {
      INFO(path << ' ' << i);
      CHECK(messages_of(read.loads[i].errors) == Messages{});
      CHECK(canonical_json(read.loads[i].layout) == canonical_json(loads[i]));
    }
    CHECK(read.loads[0].layout.name == path + "#Unit 1");
  }
  // A table tells loads by their names.
  CHECK(loads_text({loads[0], loads[0]}, "out.json"));
  CHECK_FALSE(loads_text({loads[0], loads[0]}, "out.csv"));
  CHECK_FALSE(loads_text(loads, "out.txt"));
  CHECK_FALSE(loads_text(loads, "out"));
  const LoadsOfFile plain = loads_of("1 1\n0 0 0 80 59.5 106 4\n", {}, "a.txt");
  CHECK(*loads_text({plain.loads[0].layout}, "b.txt") == "1 boxes\n0 0 0 80 59.5 106 4\n");
}

TEST_CASE("load_file: a text whose first line names its columns is a table", "[io][loads]") {
  const LoadsOfFile loads = loads_of("x y z length width height material weight\n0 0 0 80 60 50 2 12.5\n", {}, "a.txt");
  REQUIRE(loads.loads.size() == 1);
  const Box& box = loads.loads[0].layout.boxes.at(0);
  CHECK(box.corner_max == Vec3(0.8, 0.6, 0.5));
  CHECK(box.material.id() == 2);
  CHECK(box.mass == 12.5);
  // Any other first line is a header without meaning, whatever signs it has.
  for (const char* const header : {"seed=5; by hand", "a, b, c, d, e, f, g", "x y z", "3 boxes"})
    CHECK(load_syntax(std::string(header) + "\n0 0 0 80 60 50 2\n") == LoadSyntax::text);
}

TEST_CASE("load_file: titles before the header are passed over, blank columns have no meaning", "[io][loads]") {
  const LoadsOfFile loads = loads_of(
      "Load plan;;;;;;\nby hand;;;;;;\n;;;;;;\nArtikel;x;y;z;L\xC3\xA4nge (mm);Breite (mm);H\xC3\xB6he (mm)\n"
      "A;0;0;0;800;600;500\n;;;;;;\n");
  REQUIRE(loads.loads.size() == 1);
  CHECK(loads.loads[0].layout.boxes.size() == 1);
  CHECK(loads.loads[0].layout.boxes[0].corner_max == Vec3(0.8, 0.6, 0.5));
  CHECK(loads.loads[0].layout.boxes[0].name == "A");
}

TEST_CASE("load_file: titles do not have the columns that the user names, and the header must", "[io][loads]") {
  Settings settings;
  settings.loads.columns = "Tiefe = length";
  const std::string box = "x;y;z;Tiefe;width;height\n0;0;0;80;60;50\n";
  CHECK(loads_of("Load plan\n" + box, settings).loads[0].layout.boxes.size() == 1);
  settings.loads.columns = "Tief = length";
  CHECK(all_errors("Load plan\n" + box, settings) ==
        Messages{"a.csv:2: there is no column of that name: Tief; did you mean 'Tiefe'?"});
}

TEST_CASE("load_file: what cannot be read is named by line, column and header", "[io][loads]") {
  CHECK(all_errors("x;y;z;length;width;height\n0;0;0;80,5;60;50.5\n") ==
        Messages{"a.csv:2:15: the height is not a number (column height): 50.5; a number such as 80 or 12,5; the table "
                 "has decimal commas"});
  CHECK(all_errors("name,x,y,z,weight,mass,length,width,height\nA,0,0,0,1,2,3,4,5\n") ==
        Messages{"a.csv:1: two columns mean the same: weight and mass; leave one out: --columns \"mass = -\""});
  CHECK(all_errors("name,x,y,length,width,height,m\nA,0,0,1,2,3,4\n") ==
        Messages{
            "a.csv:1: the header does not tell the place along z: name, x, y, length, width, height, m; columns such "
            "as x, y, z, length, width, height; or --columns \"HEADER = x, ...\""});
  CHECK(all_errors("x,y,z,length,width,height,weight\n0,0,0,80,60,50,-4\n") ==
        Messages{"a.csv:2:16: the mass is not possible (column weight): -4; a number above 0"});
  CHECK(all_errors("x,y,z,length,width,height\n0,0,0,80,\"60,50\n") == Messages{"a.csv:2: a quote is never closed"});
  CHECK(all_errors("PK\x03\x04") ==
        Messages{"a.csv: is a spreadsheet file (.xlsx or .ods); text: save or export it as CSV (UTF-8)"});
  CHECK(all_errors("{\"a\": [1, }", {}, "a.json")[0].starts_with("a.json:1:11: the text is not JSON"));
  CHECK(
      all_errors("{\"items\": [{\"x\": 1, \"y\": 2, \"z\": 0}]}", {}, "a.json") ==
      Messages{"a.json: no list of boxes with places and sizes is found: the list /items of x, y, z lacks the "
               "length, the width, the height; a list of objects with keys such as x, y, z, length, width, height; or "
               "--columns \"KEY = x, ...\"; JSON of holdfast has the key 'holdfast'"});
}

TEST_CASE("load_file: of lists that may be boxes the one that tells most of them is named", "[io][loads]") {
  const Messages errors =
      all_errors(R"({"meta": [{"a": 1, "b": 2, "c": 3, "d": 4}], "items": [{"x": 1, "y": 2, "z": 0}]})", {}, "a.json");
  REQUIRE(errors.size() == 1);
  CHECK(errors[0].find("the list /items of x, y, z lacks the length") != std::string::npos);
}

TEST_CASE("load_file: mistakes of one load leave the others", "[io][loads]") {
  const LoadsOfFile loads = loads_of(
      "load,x,y,z,length,width,height\nA,0,0,0,80,60,50\nB,0,0,zero,80,60,50\nC,0,0,0,80,60,50\nA,80,0,0,80,60,50\n");
  REQUIRE(loads.loads.size() == 3);
  CHECK(loads.loads[0].layout.boxes.size() == 2);
  CHECK(messages_of(loads.loads[1].errors) ==
        Messages{"a.csv:3:7: the place is not a number (column z): zero; a number such as 80 or 12.5"});
  CHECK(loads.loads[2].errors.empty());
}

TEST_CASE("load_file: JSON of ours has its keys checked, and pointers in messages", "[io][loads]") {
  const std::string box = R"({"corner_min": [0, 0, 0], "corner_max": [1, 1, 1]})";
  CHECK(all_errors(R"({"holdfast": 1, "loads": [{"boxes": [)" + box + R"(], "nmae": "A"}]})", {}, "a.json") ==
        Messages{"a.json: /loads/0/nmae: unknown key: nmae; did you mean 'name'?"});
  CHECK(all_errors(R"({"holdfast": 1, "loads": [{"boxes": [{"corner_min": [0, 0, "x"], "corner_max": [1, 1, 1]}]}]})",
                   {}, "a.json") ==
        Messages{"a.json: /loads/0/boxes/0/corner_min/2: a number of corner_min is not a number: \"x\"; a list of "
                 "three numbers"});
  const LoadsOfFile lines = loads_of(
      "{\"holdfast\": 1, \"unit\": \"cm\"}\n{\"name\": \"A\", \"container\": \"40HC\", "
      "\"boxes\": [[0, 0, 0, 80, 60, 50, 3]]}\n{\"boxes\": 3}\n",
      {}, "a.jsonl");
  REQUIRE(lines.loads.size() == 2);
  CHECK(lines.loads[0].layout.name == "a.jsonl#A");
  CHECK(lines.loads[0].layout.container->type == "40hc");
  CHECK(lines.loads[0].layout.boxes[0].corner_max == Vec3(0.8, 0.6, 0.5));
  CHECK(messages_of(lines.loads[1].errors) ==
        Messages{"a.jsonl:3: /boxes: no list of boxes: 3; a list with at least one box"});
}

TEST_CASE("load_file: all mistakes of JSON of ours are told, each with its place", "[io][loads]") {
  const std::string text = R"({"loads": [
    {"boxes": [{"corner_min": [0, 0], "corner_max": [1, 1, 1], "mass": "heavy", "colour": {"r": [1, {"g": 2}]}},
               [0, 0, 0, 1, 1, 1], {"corner_min": {"x": 1}, "fixed": 1}, 7]},
    {"boxes": [[1, 0, 0, 2, 1, 1, 1]], "container": {"size": [6, 2.4, -1], "drop_sides": {"roof": 1}}},
    {"boxes": [[3, 0, 0, 4, 1, 1, 1]], "unit": "yd", "unit": "m"}, 3, {"name": "C", "boxes": []},
    {"boxes": [[1e7, 0, 0, 2e7, 1, 1, 1], [0, 0, 0, 1, 1, 1, 1.5]], "order": 1},
    {"boxes": [[4, 0, 0, 5, 1, 1, 1]], "container": {"open_sides": ["rear"], "drop_sides": {"rear": 0.6}}}],
    "holdfast": 1})";
  CHECK(all_errors(text, {}, "a.json") ==
        Messages{
            "a.json: /loads/0/boxes/0/corner_min: corner_min does not have three numbers: 2 numbers; a list of "
            "three numbers",
            "a.json: /loads/0/boxes/0/mass: mass is not a number: \"heavy\"; a number above 0, up to 1000000",
            "a.json: /loads/0/boxes/0/colour: unknown key: colour; accepted are corner_min, corner_max, name, "
            "material, mass, mat, centre_of_mass, fixed, order, bearing_limit",
            "a.json: /loads/0/boxes/1: does not have seven numbers; an object, or a list of seven numbers: two "
            "corners and a material",
            "a.json: /loads/0/boxes/2/corner_min: corner_min is not a list: an object; a list of three numbers",
            "a.json: /loads/0/boxes/2/fixed: fixed is neither true nor false: 1; true or false",
            "a.json: /loads/0/boxes/2: the box has no corner_max; corner_min and corner_max, each a list of three "
            "numbers",
            "a.json: /loads/0/boxes/3: no box: 7; an object, or a list of seven numbers: two corners and a material",
            "a.json: /loads/1/container/size/2: the size of the container is not possible: -1; three lengths "
            "of at least 1 mm, up to 1000000",
            "a.json: /loads/1/container/drop_sides/roof: a drop side that is no wall: roof; front, rear, left or right",
            "a.json: /loads/2/unit: unknown unit: \"yd\"; \"m\", \"dm\", \"cm\", \"mm\", \"in\" or \"ft\"",
            "a.json: /loads/2/unit: a key that is given twice: unit; each key once",
            "a.json: /loads/3: no load: 3; {\"name\": ..., \"boxes\": [...]}",
            "a.json: /loads/4: has no boxes; a list with at least one box",
            "a.json: /loads/5/boxes/0/0: not possible: 1e+07; an object, or a list of seven numbers: two corners and "
            "a material",
            "a.json: /loads/5/boxes/0/3: not possible: 2e+07; an object, or a list of seven numbers: two corners and "
            "a material",
            "a.json: /loads/5/boxes/1: the material is not an id: 1.5; a whole number from 0",
            "a.json: /loads/5/order: unknown key: order; accepted are name, container, unit, boxes",
            "a.json: /loads/6/container: a side is both open and a drop side: rear; each side in one of the two"});
  CHECK(all_errors(R"({"holdfast": 2, "loads": [{"boxes": [[0, 0, 0, 1, 1, 1, 1]]}]})", {}, "a.json") ==
        Messages{"a.json: /holdfast: a version that is not known: 2; 1"});
  CHECK(all_errors("{\"holdfast\": 1}\n{\"boxes\": [[0, 0, 0, 1, 1, 1, 1]]}\n{\"boxes\": [[}\n", {}, "a.jsonl")[0]
            .starts_with("a.jsonl:3:13: the text is not JSON"));
  CHECK(all_errors("{\"holdfast\": 1, \"loads\": [{\"boxes\": [[1e999]]}]}", {}, "a.json") ==
        Messages{"a.json:1:43: a number that is too large"});
  const std::string deep(1'000'000, '[');
  CHECK(all_errors("{\"holdfast\": 1, \"loads\": " + deep, {}, "a.json").size() == 1);
}

TEST_CASE("load_file: lengths of a container begin at 1 mm, which is said with their place", "[io][loads]") {
  const std::string boxes = R"("boxes": [[1, 0, 0, 2, 1, 1, 1]])";
  const auto errors = [&](const std::string& container) {
    return all_errors(R"({"holdfast": 1, "loads": [{"container": {)" + container + "}, " + boxes + "}]}", {}, "a.json");
  };
  CHECK(errors(R"("drop_sides": {"rear": 0.001})") == Messages{});
  CHECK(errors(R"("drop_sides": {"left": 0.6, "rear": 0.0001})") ==
        Messages{"a.json: /loads/0/container/drop_sides/rear: the height of a drop side is not possible: 0.0001 m; a "
                 "length of at least 1 mm, up to 1000000 m"});
  CHECK(errors(R"("drop_sides": {"rear": 0})") ==
        Messages{"a.json: /loads/0/container/drop_sides/rear: the height of a drop side is not possible: 0; a length "
                 "of at least 1 mm, up to 1000000"});
  CHECK(errors(R"("size": [6, 2, 0.0005])") ==
        Messages{"a.json: /loads/0/container/size: the size of the container is not possible: 6 x 2 x 0.0005 m; three "
                 "lengths of at least 1 mm, up to 1000000 m"});
  // That of a file is in its first line.
  CHECK(all_errors(
            "{\"holdfast\": 1, \"unit\": \"mm\", \"container\": {\"drop_sides\": {\"left\": 0.1}}}\n{" + boxes + "}\n",
            {}, "a.jsonl") ==
        Messages{"a.jsonl:1: /container/drop_sides/left: the height of a drop side is not possible: 0.0001 m; a length "
                 "of at least 1 mm, up to 1000000 m"});
}

TEST_CASE("load_file: boxes that overlap or are outside are told with their places", "[io][loads]") {
  const std::string overlaps = "overlaps box 1: 500 mm deep; boxes may touch; up to 0.1 mm is taken as rounding";
  const std::string outside = "is outside the container at the rear: 130 mm; the container is 587 x 233 x 220 cm";
  const std::string boxes = R"({"boxes": [[0, 0, 0, 1, 1, 1, 1], [0.5, 0, 0, 1.5, 1, 1, 1],
                                          {"corner_min": [5, 0, 0], "corner_max": [6, 1, 1]}]})";
  CHECK(all_errors(R"({"holdfast": 1, "loads": [{"boxes": [[0, 0, 0, 1, 1, 1, 1]]}, )" + boxes + "]}", {}, "a.json") ==
        Messages{"a.json: /loads/1/boxes/2: box 3 " + outside, "a.json: /loads/1/boxes/1: box 2 " + overlaps});
  CHECK(all_errors("{\"holdfast\": 1}\n{\"boxes\": [[0, 0, 0, 1, 1, 1, 1], [0.5, 0, 0, 1.5, 1, 1, 1]]}\n", {},
                   "a.jsonl") == Messages{"a.jsonl:2: /boxes/1: box 2 " + overlaps});
  // The second item is not placed.
  const std::string items = R"("items": [{"x": 0, "y": 0, "z": 0, "l": 100, "w": 100, "h": 100},
                                         {"x": "", "y": "", "z": "", "l": 100, "w": 100, "h": 100},
                                         {"x": 50, "y": 0, "z": 0, "l": 100, "w": 100, "h": 100}])";
  CHECK(all_errors('{' + items + '}', {}, "a.json") == Messages{"a.json: /items/2: box 2 " + overlaps});
  const auto layer = [](int x, int z) {
    const std::string place = R"({"x": )" + std::to_string(x) + R"(, "y": 0, "z": )" + std::to_string(z);
    return R"({"items": [)" + place + R"(, "l": 100, "w": 100, "h": 100}]})";
  };
  CHECK(all_errors(R"({"layers": [)" + layer(0, 0) + ", " + layer(200, 0) + ", " + layer(500, 100) + "]}", {},
                   "a.json") == Messages{"a.json: /layers/2/items/0: box 3 " + outside});
  CHECK(all_errors("x,y,z,l,w,h\n0,0,0,100,100,100\n,,,100,100,100\n500,0,0,100,100,100\n") ==
        Messages{"a.csv:4: box 2 " + outside});
}

TEST_CASE("load_file: a drop side beside a type leaves the type's other open sides open", "[io][loads]") {
  const LoadsOfFile read = loads_of(
      R"({"holdfast": 1, "loads": [{"container": {"type": "trailer-curtain", "drop_sides": {"left": 0.6}},
                                    "boxes": [[0, 0, 0, 1, 1, 1, 1]]}]})",
      {}, "a.json");
  REQUIRE(messages_of(read.loads[0].errors) == Messages{});
  CHECK(read.loads[0].layout.container->open_sides == std::vector<std::string>{"right"});
  CHECK(read.loads[0].layout.container->drop_sides.size() == 1);
}

TEST_CASE("load_file: warnings say which load of a file they mean", "[io][loads]") {
  const LoadsOfFile read = loads_of("load,x,y,z,l,w,h,kg\nA,0,0,0,120,80,100,300\nB,0,0,0,120,80,100,0.3\n");
  REQUIRE(read.loads.size() == 2);
  CHECK(read.loads[0].warnings.empty());
  REQUIRE_FALSE(read.loads[1].warnings.empty());
  CHECK(read.loads[1].warnings[0].file.ends_with("#B"));
}

TEST_CASE("load_file: boxes that overhang a drop side are not taken for those of a wider container", "[io][loads]") {
  const std::string planks = "x,y,z,l,w,h\n0,0,60,30,243,5\n100,0,60,30,243,5\n200,0,60,30,243,5\n";
  CHECK(all_errors(planks)[0].find("--container trailer-box holds them") != std::string::npos);
  Settings settings;
  settings.container.drop_sides = {{"left", 0.6}, {"right", 0.6}};
  CHECK(all_errors(planks, settings) == Messages{});
}

TEST_CASE("load_file: what JSON of ours says of all loads may come after them", "[io][loads]") {
  const LoadsOfFile loads = loads_of(
      R"({"loads": [{"boxes": [[0, 0, 0, 80, 60, 50, 3]]},
                    {"unit": "m", "container": {"size": [3, 2, 2]}, "boxes": [[0, 0, 0, 0.8, 0.6, 0.5, 3]]}],
          "container": {"size": [600, 240, 250]}, "unit": "cm", "holdfast": 1})",
      {}, "a.json");
  REQUIRE(loads.loads.size() == 2);
  CHECK(loads.loads[0].layout.name == "a.json");
  CHECK(loads.loads[1].layout.name == "a.json#2");
  CHECK(loads.loads[0].layout.container->size == Vec3(6, 2.4, 2.5));
  CHECK(loads.loads[1].layout.container->size == Vec3(3, 2, 2));
  for (const ReadLoad& load : loads.loads) CHECK(load.layout.boxes.at(0).corner_max == Vec3(0.8, 0.6, 0.5));
}

TEST_CASE("load_file: the form that a file was taken for", "[io][loads]") {
  const std::string row = "\n0 0 0 80 60 50 1\n";
  CHECK(loads_of("1 box" + row).form == "text");
  CHECK(loads_of("x y z length width height\n0 0 0 80 60 50\n").form == "blank-separated table");
  for (const auto& [separator, form] :
       {std::pair{",", "comma-separated table"}, std::pair{";", "semicolon-separated table"},
        std::pair{"\t", "tab-separated table"}}) {
    std::string table = "x y z length width height\n0 0 0 80 60 50\n";
    for (std::size_t at = table.find(' '); at != std::string::npos; at = table.find(' ', at))
      table.replace(at, 1, separator);
    CHECK(loads_of(table).form == form);
  }
  const std::string boxes = R"("boxes": [[0, 0, 0, 1, 1, 1, 1]])";
  CHECK(loads_of(R"({"holdfast": 1, "loads": [{)" + boxes + "}]}").form == "JSON");
  CHECK(loads_of("{\"holdfast\": 1}\n{" + boxes + "}\n").form == "JSON, one load per line");
  const std::string item = R"({"x": 0, "y": 0, "z": 0, "length": 80, "width": 60, "height": 50})";
  CHECK(loads_of("[" + item + "]").form == "JSON of another program");
  CHECK(loads_of(item + '\n' + item + '\n').form == "JSON of another program, one object per line");
  // A header may have any words: where the rest is no text either, it says why it was taken for one.
  CHECK(loads_of("2 boxes\n0 0 0 80\n").form == "text, since no line names the places and sizes of boxes");
  CHECK(loads_of("1 box\n0 0 0 80 60 50 wood\n").form == "text");
}

TEST_CASE("load_file: boxes that float, and would stand along other axes, are told", "[io][loads]") {
  // y is up in this file: two layers of boxes, all of which fit a container that is as high as it is wide.
  std::string text = "1\n";
  for (int layer = 0; layer < 3; ++layer)
    for (int i = 0; i < 4; ++i) {
      const auto number = [](int value) { return std::to_string(value) + ' '; };
      text += number(100 * i) + number(60 * layer) + number(50) + number(100 * i + 100) + number(60 * layer + 60) +
              number(130) + "1\n";
    }
  const LoadsOfFile loads = loads_of(text, {}, "a.txt");
  REQUIRE(loads.loads[0].errors.empty());
  CHECK(said_of(loads) ==
        "a.txt: nothing is beneath 12 of 12 boxes, as in a file whose height is another axis; all boxes stand with "
        "--axes \"x -z y\" where it counts from the right, --axes \"x z y\" from the left\n");
  Settings settings;
  settings.loads.axes = parse_axes("x y z");  // which says that it is meant
  CHECK(said_of(loads_of(text, settings, "a.txt")).empty());
  settings.loads.axes = parse_axes("x -z y");
  CHECK(said_of(loads_of(text, settings, "a.txt")).empty());
  // A load that would float along other axes too, one that stands, and one of which few boxes float.
  CHECK(said_of(loads_of("1\n0 50 50 80 100 90 1\n100 50 50 180 100 90 1\n", {}, "a.txt")).empty());
  CHECK(said_of(loads_of("1\n0 0 0 80 60 60 1\n0 0 60 80 60 120 1\n0 0 120 80 60 180 1\n", {}, "a.txt")).empty());
  CHECK(said_of(loads_of("1\n0 0 0 80 60 60 1\n0 0 60 80 60 120 1\n0 0 125 80 60 180 1\n", {}, "a.txt")).empty());
}

TEST_CASE("load_file: a load that fits only otherwise is told what mends it", "[io][loads]") {
  const auto only = [](const Messages& messages) {
    REQUIRE(messages.size() == 1);
    return messages[0];
  };
  // Metres as centimetres, millimetres as centimetres.
  CHECK(only(all_errors("1\n0 0 0 1.2 0.8 1 1\n1.2 0 0 2.4 0.8 1 1\n", {}, "a.txt")).find("--unit m;") !=
        std::string::npos);
  CHECK(only(all_errors("1\n0 0 0 1200 800 1000 1\n1200 0 0 2400 800 1000 1\n", {}, "a.txt")).find("--unit mm") !=
        std::string::npos);
  // Fourteen boxes beyond the rear are one error, and a longer container holds them.
  std::string row = "1\n";
  for (int i = 0; i < 10; ++i) row += std::to_string(110 * i) + " 0 0 " + std::to_string(110 * i + 110) + " 80 90 1\n";
  CHECK(only(all_errors(row, {}, "a.txt")).find("--container 40 holds them") != std::string::npos);
  // Sizes as second corners.
  CHECK(only(all_errors("1\n0 0 0 120 80 90 1\n120 0 0 120 80 90 1\n240 0 0 120 80 90 1\n", {}, "a.txt"))
            .find("x y z length width height") != std::string::npos);
  // y upwards, in a container that is longer than it is high.
  CHECK(only(all_errors("1\n0 0 0 100 210 230 1\n100 0 0 200 210 232 1\n", {}, "a.txt")).find("--axes \"x -z y\"") !=
        std::string::npos);
}

TEST_CASE("load_file: named materials that nothing describes are said where others are described", "[io][loads]") {
  Settings settings;
  const std::string text = "x,y,z,length,width,height,material\n0,0,0,80,60,50,carton\n80,0,0,80,60,50,steel\n";
  CHECK(said_of(loads_of(text, settings)).empty());
  settings.materials[MaterialName("carton")].friction = 0.4;
  CHECK(said_of(loads_of(text, settings)).find("not described: steel") != std::string::npos);
}

namespace {

/// What is read of a file: loads, boxes, kilograms, and where the first box ends, m.
std::string summary_of(const std::string& text, const Settings& settings = {}, const std::string& path = "a.csv") {
  const Result<LoadsOfFile> read = read_loads(memory_file(text, path), settings);
  if (!read) return read.error().message();
  std::size_t boxes = 0;
  double mass = 0.0;
  for (const ReadLoad& load : read->loads) {
    if (!load.errors.empty()) return load.errors[0].message();
    boxes += load.layout.boxes.size();
    for (const Box& box : load.layout.boxes) mass += box.mass.value_or(0.0);
  }
  std::ostringstream summary;
  const Vec3 end = read->loads.front().layout.boxes.front().corner_max;
  summary << read->loads.size() << " loads, " << boxes << " boxes, " << mass << " kg, first to " << end.x() << ' '
          << end.y() << ' ' << end.z();
  return summary.str();
}

/// A box of 1.2 m x 0.8 m x 1 m, 300 kg, at the origin.
const std::string kOneBox = "1 loads, 1 boxes, 300 kg, first to 1.2 0.8 1";

std::string container_type_of(const std::string& text, const std::string& path) {
  return loads_of(text, {}, path).loads[0].layout.container.value_or(ContainerShape()).type;
}

}  // namespace

TEST_CASE("load_file: units stand in headers, cells, a row of their own, titles and keys", "[io][loads]") {
  const std::string row = "\n0,0,0,120,80,100,300\n";
  CHECK(summary_of("x,y,z,length,width,height,weight" + row) == kOneBox);
  CHECK(summary_of("x,y,z,length,width,height,weight\ncm,cm,cm,cm,cm,cm,kg" + row) == kOneBox);
  CHECK(summary_of("x,y,z,length,width,height,weight\n0,0,0,120 cm,80 cm,100 cm,300 kg\n") == kOneBox);
  CHECK(summary_of("x,y,z,length (mm),width (mm),height (cm),weight (kgs)\n0,0,0,1200,800,100,300\n") == kOneBox);
  CHECK(summary_of("x (m),y (m),z (m),length (cm),width (cm),height (cm),kg" + row) == kOneBox);
  CHECK(summary_of("x (\"),y (\"),z (\"),length (\"),width (\"),height (\"),weight (lbs)\n0,0,0,10,20,30,100\n") ==
        "1 loads, 1 boxes, 45.3592 kg, first to 0.254 0.508 0.762");
  CHECK(
      summary_of("All dimensions in inches; weights in lbs\nx,y,z,length,width,height,weight\n0,0,0,10,20,30,100\n") ==
      "1 loads, 1 boxes, 45.3592 kg, first to 0.254 0.508 0.762");
  // None of these titles says the unit of the table.
  for (const std::string title : {"Date (MM/DD/YYYY)", "Printed with 20 mm margins", "53 ft trailer", "Pound Lane 5"}) {
    INFO(title);
    CHECK(summary_of(title + "\nx,y,z,length,width,height,weight" + row) == kOneBox);
  }
  CHECK(summary_of("x,y,z,length,width,height,weight\n0,0,0,120,80,100,300 kg\n120,0,0,120,80,100,0.2 t\n") ==
        "1 loads, 2 boxes, 500 kg, first to 1.2 0.8 1");
  CHECK(summary_of("x,y,z,length,width,height,weight\n0,0,0,120,80,100,300 kg\n120,0,0,120,80,100,200\n")
            .find("has no unit") != std::string::npos);
  // 0 is the same in all units.
  CHECK(summary_of(
            "x,y,z,length,width,height,weight\n0,0,0,1200 mm,80 cm,1 m,300 kg\n1200 mm,0,0,120 cm,80 cm,1 m,0.2 t\n") ==
        "1 loads, 2 boxes, 500 kg, first to 1.2 0.8 1");
  CHECK(summary_of(R"({"unit": "mm", "weightUnit": "t", "items": [{"x": 0, "y": 0, "z": 0, "length": 1200, "width": 800,
                       "height": 1000, "weight": 0.3}]})",
                   {}, "a.json") == kOneBox);
  CHECK(summary_of(R"([{"posXMm": 0, "posYMm": 0, "posZMm": 0, "lengthMm": 1200, "widthMm": 800, "heightMm": 1000,
                        "weight": {"value": 300, "unit": "kg"}}])",
                   {}, "a.json") == kOneBox);
}

TEST_CASE("load_file: headers of other languages, and masses by a part of their header", "[io][loads]") {
  const std::string row = "\n0;0;0;120;80;100;300\n";
  for (const std::string words : {"Länge;Breite;Höhe;Bruttogewicht (kg)", "Longueur;Largeur;Hauteur;Poids brut",
                                  "Długość;Szerokość;Wysokość;Waga [kg]", "ДЛИНА, см;Ширина, см;Высота, см;Вес, кг",
                                  "长(cm);宽（cm）;高(cm);毛重(kg)", "L;B;H;kg", "largo;ancho;alto;G.W. (kg)"}) {
    INFO(words);
    CHECK(summary_of("X;Y;Z;" + words + row) == kOneBox);
  }
  // None of these is the mass of a box.
  for (const std::string word :
       {"max. weight on top", "tare weight", "weight limit", "Tragfähigkeit (kg)", "Max. weight (kg)", "Value (pounds)",
        "Weight class", "kg/m3", "Zone T", "Großkunde", "CO2 (kg)"}) {
    INFO(word);
    CHECK(summary_of("x;y;z;l;w;h;" + word + row) == "1 loads, 1 boxes, 0 kg, first to 1.2 0.8 1");
  }
  CHECK(summary_of("x;y;z;l;w;h;Netto (kg);Tara (kg);Brutto (kg)\n0;0;0;120;80;100;270;30;300\n") == kOneBox);
  CHECK(summary_of("x;y;z;l;w;h;weight;weight unit\n0;0;0;120;80;100;0.3;t\n") == kOneBox);
  Settings settings;
  settings.loads.columns = "Länge, außen = length, 重量 = mass";
  CHECK(summary_of("x;y;z;Länge, außen;w;h;重量" + row, settings) == kOneBox);
}

TEST_CASE("load_file: marks of thousands are told from those of decimals", "[io][loads]") {
  CHECK(summary_of("x;y;z;l (mm);w (mm);h (mm);kg\n0;0;0;1.200;800;1.000;300,00\n") == kOneBox);
  CHECK(summary_of("x;y;z;l;w;h;kg\n0;0;0;1'200;8'00;1'000;300\n", [] {
          Settings settings;
          settings.loads.unit = 0.001;
          return settings;
        }()) == kOneBox);
  const std::string masses =
      "x,y,z,l,w,h,kg\n0,0,0,120,80,100,\"1,300\"\n120,0,0,120,80,100,\"1,049\"\n240,0,0,120,80,100,";
  CHECK(summary_of(masses + "751\n") == "1 loads, 3 boxes, 3100 kg, first to 1.2 0.8 1");
  CHECK(summary_of(masses + "7510\n") == "1 loads, 3 boxes, 7512.35 kg, first to 1.2 0.8 1");
  CHECK(summary_of(masses + "7,5\n").starts_with("1 loads, 3 boxes"));
  CHECK(
      summary_of(
          "x;y;z;l;w;h;kg;mu\n0;0;0;120;80;100;1.250;0.35\n120;0;0;120;80;100;1.100;0.35\n240;0;0;120;80;100;800;0.3\n") ==
      "1 loads, 3 boxes, 802.35 kg, first to 1.2 0.8 1");
  CHECK(summary_of("x,y,z,l,w,h,kg\n0,0,0,\"120,0\",80,100,300\n") == kOneBox);
  // One is enough where lengths have decimal commas, and none where they have decimal points.
  CHECK(summary_of("x;y;z;l;w;h;kg\n0;0;0;120,0;80;100;1.250\n") == "1 loads, 1 boxes, 1250 kg, first to 1.2 0.8 1");
  CHECK(summary_of("x;y;z;l;w;h;kg\n0;0;0;120.0;80;100;1.250\n") == "1 loads, 1 boxes, 1.25 kg, first to 1.2 0.8 1");
  // A cell's unit is none of the three digits.
  CHECK(summary_of(
            "x;y;z;l;w;h;kg\n0 mm;0 mm;0 mm;1200 mm;800 mm;1000 mm;300 kg\n1,2 m;0 mm;0 mm;1,2 m;800 mm;1 m;1,3 t\n") ==
        "1 loads, 2 boxes, 1600 kg, first to 1.2 0.8 1");
  // Three decimals of metres stay decimals.
  CHECK(summary_of("x;y;z;l (m);w (m);h (m);kg\n0;0;0;1,200;0,800;1,000;300\n") == kOneBox);
}

TEST_CASE("load_file: parts of a load are one load unless their boxes overlap", "[io][loads]") {
  const auto two = [](const std::string& place) {
    return "pallet,x,y,z,l,w,h,kg\nA,0,0,0,120,80,100,150\nB," + place + ",120,80,100,150\n";
  };
  CHECK(summary_of(two("120,0,0")) == "1 loads, 2 boxes, 300 kg, first to 1.2 0.8 1");
  CHECK(summary_of(two("0,0,0")) == "2 loads, 2 boxes, 300 kg, first to 1.2 0.8 1");
  const auto item = [](int x) {
    return R"([{"x": )" + std::to_string(x) + R"(, "y": 0, "z": 0, "l": 120, "w": 80, "h": 100, "kg": 150}])";
  };
  CHECK(summary_of(R"({"layers": [{"boxes": )" + item(0) + R"(}, {"boxes": )" + item(120) + "}]}", {}, "a.json") ==
        "1 loads, 2 boxes, 300 kg, first to 1.2 0.8 1");
  CHECK(summary_of(R"({"bins": [{"boxes": )" + item(0) + R"(}, {"boxes": )" + item(0) + "}]}", {}, "a.json") ==
        "2 loads, 2 boxes, 300 kg, first to 1.2 0.8 1");
  // Trucks are loads, wherever their boxes are; a box at the place of another is a mistake, and no other load.
  CHECK(summary_of(R"({"trucks": [{"boxes": )" + item(0) + R"(}, {"boxes": )" + item(120) + "}]}", {}, "a.json") ==
        "2 loads, 2 boxes, 300 kg, first to 1.2 0.8 1");
  const std::string row =
      "pallet,x,y,z,l,w,h,kg\nA,0,0,0,120,80,100,150\nA,120,0,0,120,80,100,150\nA,240,0,0,120,80,100,150\n";
  CHECK(summary_of(row + "A,360,0,0,120,80,100,150\nB,0,0,0,120,80,100,150\n").find("box 5 overlaps box 1") !=
        std::string::npos);
  // Of merged cells only the first has the name of the load.
  CHECK(summary_of("truck,x,y,z,l,w,h\nA,0,0,0,120,80,100\n,120,0,0,120,80,100\nB,0,0,0,120,80,100\n") ==
        "2 loads, 3 boxes, 0 kg, first to 1.2 0.8 1");
  // A pallet with a weight is cargo, and not a container.
  CHECK(summary_of("type,x,y,z,l,w,h,kg\nPallet,0,0,0,120,80,100,150\nBox,120,0,0,120,80,100,150\n") ==
        "1 loads, 2 boxes, 300 kg, first to 1.2 0.8 1");
}

TEST_CASE("load_file: containers are told by their names, sizes and titles", "[io][loads]") {
  const std::string table = "x,y,z,l,w,h\n0,0,0,120,80,100\n";
  CHECK(container_type_of("Container: 40' HC\n" + table, "a.csv") == "40hc");
  CHECK(container_type_of("container,x,y,z,l,w,h\n40HC,0,0,0,120,80,100\n", "a.csv") == "40hc");
  CHECK(container_type_of("container,x,y,z,l,w,h\n40,0,0,0,120,80,100\n", "a.csv").empty());
  const std::string items = R"("items": [{"x": 0, "y": 0, "z": 0, "l": 120, "w": 80, "h": 100}]})";
  CHECK(container_type_of(R"({"container": "40HC", )" + items, "a.json") == "40hc");
  CHECK(container_type_of(R"({"truck": {"name": "20GP"}, )" + items, "a.json") == "20");
  for (const std::string container :
       {R"("container": [1200, 235, 269])", R"("container": {"L": 1200, "W": 235, "H": 269})",
        R"("container": {"innerLength": 1200, "innerWidth": 235, "innerHeight": 269})",
        R"("bin": {"width": 235, "height": 269, "depth": 1200})"}) {
    INFO(container);
    check_vector({12.0, 2.35, 2.69},
                 loads_of('{' + container + ", " + items, {}, "a.json").loads[0].layout.container->size);
  }
}

TEST_CASE("load_file: rows that are no boxes, and rows of several", "[io][loads]") {
  const std::string head = "no,x,y,z,l,w,h,kg,status,quantity\n";
  const std::string box = "#1,0,0,0,120,80,100,300,placed,1\n";
  CHECK(summary_of("Plan 7,,,,,,,,,\nGross,17,kg,,,,,,,\n" + head + box) == kOneBox);
  CHECK(summary_of(head + box + head + "2,0,0,0,120,80,100,300,Not placed,1\n# no row\n") == kOneBox);
  CHECK(summary_of(head + box + "Total,0,0,0,0,0,0,300,,1\n") == kOneBox);
  CHECK(summary_of(head + box + "Total,120,0,0,120,80,100,200,,1\n") == "1 loads, 2 boxes, 500 kg, first to 1.2 0.8 1");
  const LoadsOfFile mats =
      loads_of("x,y,z,l,w,h,mat\n0,0,0,120,80,100,x\n120,0,0,120,80,100,no\n240,0,0,120,80,100,55 %\n");
  CHECK(mats.loads[0].layout.boxes[0].mat == 0.6);
  CHECK_FALSE(mats.loads[0].layout.boxes[1].mat);
  CHECK(*mats.loads[0].layout.boxes[2].mat == Approx(0.55));
  CHECK(said_of(loads_of(head + "1,0,0,0,120,80,100,300,placed,4\n")).find("1 row is of more than one box") !=
        std::string::npos);
}

TEST_CASE("load_file: what is probably not meant is said", "[io][loads]") {
  const auto said = [](const std::string& rows) { return said_of(loads_of("x,y,z,l,w,h,weight\n" + rows)); };
  CHECK(said("0,0,0,120,80,100,300\n").empty());
  CHECK(said("0,0,0,120,80,100,0.3\n").find("0.3125 kg/m³ on the average") != std::string::npos);
  CHECK(said("0,0,0,120,80,100,300000\n").find("312500 kg/m³ on the average") != std::string::npos);
  CHECK(said("0,0,0,120,80,100,300\n120,0,0,120,80,100,0\n").find("1 of 2 boxes have no weight") != std::string::npos);
  CHECK(said("0,0,0,120,80,100,n/a\n").find("no box has a weight") != std::string::npos);
  CHECK(said_of(loads_of("container,x,y,z,l,w,h,kg\n20GP,0,0,0,580,230,230,60000\n")).find("type 20 carries") !=
        std::string::npos);
  CHECK(summary_of("x,y,z,l,w,h\n0,0,0,1.2,0.8,1\n11,0,0,0.8,0.6,0.5\n").find("all boxes are shorter than 5 cm") !=
        std::string::npos);
  CHECK(summary_of("x,y,z,l,w,h\n0,0,0,1200,800,1000\n9000,0,0,1200,800,1000\n9000,1000,0,1200,800,1000\n")
            .find("--unit mm --container 40") != std::string::npos);
  // Middles that are called corners: in the container, and partly beyond its wall.
  CHECK(said("60,40,50,120,80,100,300\n").find("--columns \"x = cx, y = cy, z = cz\"") != std::string::npos);
}

TEST_CASE("load_file: py3dbp is told by its key, and its codes turn items", "[io][loads]") {
  const std::string item =
      R"({"name": "A", "width": 80, "height": 100, "depth": 120, "position": [0, 0, %], "rotation_type": 3})";
  std::string bins = R"({"width": 235, "height": 239, "depth": 590, "items": [)";
  for (const char* const place : {"0", "80", "160"}) {
    std::string row = item;
    row.replace(row.find('%'), 1, place);
    bins += row + (std::string_view(place) == "160" ? "]}" : ", ");
  }
  CHECK(summary_of(bins, {}, "a.json").find("--format py3dbp") != std::string::npos);
  Settings settings;
  settings.loads.format = "py3dbp";
  // Code 3 lays the depth along the width, the height upwards and the width along the length.
  CHECK(summary_of(bins, settings, "a.json") == "1 loads, 3 boxes, 0 kg, first to 0.8 1.2 1");
}

}  // namespace load_file_test
