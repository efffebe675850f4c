#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "holdfast/holdfast.hpp"

namespace loads_test {

namespace {

using holdfast::Box;
using holdfast::Layout;
using holdfast::LayoutView;
using holdfast::Problem;
using holdfast::Screen;
using holdfast::WorldOutcome;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

const std::string kFormats = HOLDFAST_SOURCE_DIR "/tests/io/loads/formats/";

holdfast::Acceleration brake() { return {"brake", {{0.0, 0.5, {7.0, 0.0, 0.0}}}}; }

/// Two boxes, the upper one light or heavy.
const std::vector<double> kStack = {1.0, 1.0, 0.0, 1.5, 1.5, 0.5, 1.0, 1.0, 1.0, 0.5, 1.5, 1.5, 1.5, 1.0};

Layout stack() {
  return {.name = "stack", .boxes = {{{1.0, 1.0, 0.0}, {1.5, 1.5, 0.5}, 1}, {{1.0, 1.0, 0.5}, {1.5, 1.5, 1.5}, 1}}};
}

std::uint64_t hash_of(Screen& screen, const Layout& layout) { return screen.evaluate({layout}).front().state_hash; }

std::uint64_t hash_of(Screen& screen, const LayoutView& layout) {
  std::vector<WorldOutcome> worlds;
  screen.evaluate(std::span(&layout, 1), worlds);
  return worlds.front().state_hash;
}

template <class AnyLayout>
std::vector<Problem> problems_of(const AnyLayout& layout) {
  Screen screen({brake()}, {.accuracy = "screening"});
  try {
    hash_of(screen, layout);
  } catch (const holdfast::Error& error) {
    return error.problems();
  }
  return {};
}

}  // namespace

TEST_CASE("loads: masses, mats and a container of a view give the bits of those of boxes", "[api][loads]") {
  Screen screen({brake()}, {.accuracy = "screening"});
  const std::array<double, 2> masses = {50.0, kNan};
  const std::array<double, 2> mats = {kNan, 0.8};
  const std::array<const char*, 2> names = {"Pump", nullptr};
  LayoutView view{"stack", kStack};
  Layout layout = stack();
  const std::uint64_t plain = hash_of(screen, layout);
  CHECK(hash_of(screen, view) == plain);

  view.masses = masses;
  layout.boxes[0].mass = 50.0;
  const std::uint64_t with_masses = hash_of(screen, layout);
  CHECK(with_masses != plain);
  CHECK(hash_of(screen, view) == with_masses);

  view.mats = mats;
  layout.boxes[1].mat = 0.8;
  const std::uint64_t with_mats = hash_of(screen, layout);
  CHECK(with_mats != with_masses);
  CHECK(hash_of(screen, view) == with_mats);

  view.box_names = names;
  CHECK(hash_of(screen, view) == with_mats);
  view.container = "trailer-curtain";
  layout.container = holdfast::Container{"trailer-curtain"};
  CHECK(hash_of(screen, view) == hash_of(screen, layout));

  LayoutView whole{.name = "whole", .numbers = {}};
  whole.layout = &layout;
  CHECK(hash_of(screen, whole) == hash_of(screen, layout));
}

TEST_CASE("loads: a layout has its own unit", "[api][loads]") {
  Screen centimetres({brake()}, {.accuracy = "screening", .unit = holdfast::LengthUnit::centimetre});
  Screen metres({brake()}, {.accuracy = "screening"});
  Layout layout = stack();
  layout.container = holdfast::Container{.size = {{3.0, 2.0, 2.5}}};
  const std::uint64_t expected = hash_of(metres, layout);
  layout.unit = holdfast::LengthUnit::metre;
  CHECK(hash_of(centimetres, layout) == expected);
}

TEST_CASE("loads: what a box or a container has and cannot be is told with the box", "[api][loads]") {
  Layout layout = stack();
  layout.boxes[1].name = "Pump";
  layout.boxes[1].mass = -2.0;
  std::vector<Problem> problems = problems_of(layout);
  REQUIRE(problems.size() == 1);
  CHECK(problems[0].message == "stack: the mass of box 2 (Pump) is not possible: -2; a number above 0, up to 1000000");
  CHECK(problems[0].box == 1);
  CHECK(problems[0].box_column == -1);

  LayoutView view{"view", kStack};
  const std::array<double, 3> three = {1.0, 2.0, 3.0};
  view.masses = three;
  problems = problems_of(view);
  REQUIRE(problems.size() == 1);
  CHECK(problems[0].message == "view: there are not as many masses as boxes: 3; 2, or none");
  view.masses = {};
  view.container = "a barn";
  problems = problems_of(view);
  REQUIRE(problems.size() == 1);
  CHECK(problems[0].what == "no type of container");

  layout = stack();
  layout.container = holdfast::Container{.size = {{3.0, 0.0, 2.0}}, .open_sides = {{"floor"}}};
  problems = problems_of(layout);
  REQUIRE(problems.size() == 2);
  CHECK(problems[1].accepted == "front, rear, left, right or roof");
}

TEST_CASE("loads: a named material is one of the settings", "[api][loads]") {
  Screen screen({brake()},
                {.config = "[Material pallet]\nDensity = 500\n[Material 3]\nDensity = 500\n", .accuracy = "screening"});
  Layout named = stack();
  Layout numbered = stack();
  for (Box& box : named.boxes) box.material_name = "pallet";
  for (Box& box : numbered.boxes) box.material = 3;
  CHECK(hash_of(screen, named) == hash_of(screen, numbered));
  for (Box& box : numbered.boxes) box.material_name = "3";
  CHECK(hash_of(screen, named) == hash_of(screen, numbered));
}

TEST_CASE("loads: a file gives the loads that memory gives, bit for bit", "[api][loads]") {
  Screen screen({brake()}, {.accuracy = "screening"});
  std::vector<Problem> notes;
  const std::vector<Layout> read = holdfast::read_loads(kFormats + "spreadsheet_semicolon.csv", {}, &notes);
  REQUIRE(read.size() == 1);
  CHECK(notes.empty());
  CHECK(read[0].name == "spreadsheet_semicolon.csv");
  CHECK(read[0].boxes[0].name == "Pump; left");
  CHECK(read[0].boxes[0].material_name == "crate");
  CHECK(read[0].boxes[0].mass == 412.5);
  Layout made{.name = "made", .boxes = {}};
  for (const Box& box : read[0].boxes)
    made.boxes.push_back({.corner_min = box.corner_min, .corner_max = box.corner_max, .mass = box.mass});
  CHECK(hash_of(screen, made) == hash_of(screen, read[0]));

  const std::vector<Layout> planned = holdfast::read_loads(kFormats + "planner_export.csv", {.axes = "-z x y"}, &notes);
  REQUIRE(planned.size() == 2);
  REQUIRE(planned[0].container.has_value());
  CHECK(planned[0].container->type == "40hc");
  CHECK(notes.size() == 1);
  CHECK_THROWS_AS(holdfast::read_loads(kFormats + "planner_export.csv"), holdfast::Error);
  CHECK_THROWS_AS(holdfast::read_loads(kFormats + "planner_export.csv", {.axes = "x x y"}), holdfast::Error);
  CHECK_THROWS_AS(holdfast::read_loads(kFormats + "none.csv"), holdfast::Error);

  const std::vector<Layout> moved = holdfast::parse_loads(
      R"({"holdfast": 1, "loads": [{"boxes": [[0, 0, 0, 1, 1, 1, 1]]}]})", "text.json", {.container = "40hc"});
  REQUIRE(moved.size() == 1);
  CHECK(moved[0].container->type == "40hc");
}

TEST_CASE("loads: types of containers are known by name", "[api][loads]") {
  const std::vector<holdfast::ContainerType> types = holdfast::container_types();
  REQUIRE(types.size() > 5);
  CHECK(types[0].name == "20");
  CHECK(types[0].size == std::array{5.898, 2.352, 2.393});
}

}  // namespace loads_test
