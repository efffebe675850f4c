#include "core/model/layout_check.hpp"

#include <catch2/catch.hpp>
#include <limits>

#include "random.hpp"

namespace layout_check_test {

using namespace holdfast::internal;

namespace {

/// Boxes of 1 m³ with these lower corners, on lines 2, 3, ...
Layout cubes(const std::vector<Vec3>& corners) {
  Layout layout;
  for (const Vec3& corner : corners)
    layout.boxes.push_back({corner, corner + Vec3::Ones(), 1, static_cast<long>(layout.boxes.size()) + 2});
  return layout;
}

struct Outcome {
  std::vector<std::string> errors, warnings;
};

Outcome check(const Layout& layout, const Settings& settings = {}) {
  std::vector<Error> warnings;
  Outcome outcome;
  for (const Error& error : check_layout(layout, settings, "a.txt", warnings))
    outcome.errors.push_back(error.message());
  for (const Error& warning : warnings) outcome.warnings.push_back(warning.message());
  return outcome;
}

using Messages = std::vector<std::string>;

}  // namespace

TEST_CASE("layout_check: touching boxes inside the container are valid", "[core][layout_check]") {
  const Outcome outcome = check(cubes({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {4.87, 1.33, 1.2}}));
  CHECK(outcome.errors.empty());
  CHECK(outcome.warnings.empty());
  CHECK(check(Layout{}).errors.empty());
}

TEST_CASE("layout_check: an overlap names both boxes, their lines and its depth", "[core][layout_check]") {
  CHECK(
      check(cubes({{1, 0, 0}, {0, 0, 0}, {0.5, 0.25, 0.75}})).errors ==
      Messages{
          "a.txt:4: box 3 overlaps box 2 of line 3: 250 mm deep; boxes may touch; up to 0.1 mm is taken as rounding",
          "a.txt:4: box 3 overlaps box 1 of line 2: 250 mm deep; boxes may touch; up to 0.1 mm is taken as rounding"});
}

TEST_CASE("layout_check: the friction of a mat is no percentage", "[core][layout_check]") {
  Layout layout = cubes({{0, 0, 0}, {1, 0, 0}});
  layout.boxes[1].mat = 0.6;
  CHECK(check(layout).errors.empty());
  layout.boxes[1].mat = 60.0;
  CHECK(check(layout).errors ==
        Messages{"a.txt:3: the friction of the mat of box 2 is not possible: 60; a number from 0 to 10"});
}

TEST_CASE("layout_check: a box inside another, and the same box twice, overlap", "[core][layout_check]") {
  Layout layout = cubes({{0, 0, 0}, {0, 0, 0}});
  CHECK(check(layout).errors.size() == 1);
  layout.boxes[1].corner_min = {0.4, 0.4, 0.4};
  layout.boxes[1].corner_max = {0.6, 0.6, 0.6};
  CHECK(check(layout).errors.size() == 1);
}

TEST_CASE("layout_check: up to 0.1 mm is taken as rounding and reported once", "[core][layout_check]") {
  const Outcome outcome = check(cubes({{-0.00002, 0, 0}, {0.9999, 0, 0}, {0, 0.99995, 0}}));
  CHECK(outcome.errors.empty());
  CHECK(outcome.warnings == Messages{"a.txt: overlaps and protrusions within the tolerance are ignored: 4, the largest "
                                     "0.08 mm; up to 0.1 mm is taken as rounding"});
  CHECK(check(cubes({{0, 0, 0}, {0.9999, 0, 0}})).errors.empty());
  CHECK(check(cubes({{0, 0, 0}, {0.9998, 0, 0}})).errors.size() == 1);
  CHECK(check(cubes({{0, 0, 0}, {1.0 - 1e-12, -1e-15, 0}})).warnings.empty());
}

TEST_CASE("layout_check: a box outside names the side and by how much", "[core][layout_check]") {
  const std::string size = "; the container is 587 x 233 x 220 cm";
  CHECK(check(cubes({{-0.25, 0, 0}})).errors ==
        Messages{"a.txt:2: box 1 is outside the container at the front: 250 mm" + size});
  CHECK(check(cubes({{5, 0, 0}})).errors ==
        Messages{"a.txt:2: box 1 is outside the container at the rear: 130 mm" + size});
  CHECK(check(cubes({{0, -0.5, 0}})).errors ==
        Messages{"a.txt:2: box 1 is outside the container at the left: 500 mm" + size});
  CHECK(check(cubes({{0, 1.5, 0}})).errors ==
        Messages{"a.txt:2: box 1 is outside the container at the right: 170 mm" + size});
  CHECK(check(cubes({{0, 0, -0.001}})).errors ==
        Messages{"a.txt:2: box 1 is outside the container at the floor: 1 mm" + size});
  CHECK(check(cubes({{0, 0, 1.5}})).errors ==
        Messages{"a.txt:2: box 1 is outside the container at the roof: 300 mm" + size});
}

TEST_CASE("layout_check: an open side is no boundary", "[core][layout_check]") {
  Settings settings;
  settings.container.open_sides = {"rear", "roof"};
  CHECK(check(cubes({{5, 0, 1.5}}), settings).errors.empty());
  CHECK(check(cubes({{-1, 0, 0}}), settings).errors.size() == 1);
}

TEST_CASE("layout_check: a box above a drop side may stand out, and one beyond the floor is named",
          "[core][layout_check]") {
  Settings settings;
  settings.container.drop_sides = {{"right", 0.6}};
  CHECK(check(cubes({{0, 1.5, 0.6}}), settings).errors.empty());
  CHECK(check(cubes({{0, 1.5, 0.5}}), settings).errors.size() == 1);
  settings.container.open_sides = {"rear"};
  const Outcome beyond = check(cubes({{0, 0, 0}, {6, 0, 0}, {5.5, 1.1, 0}}), settings);
  CHECK(beyond.errors.empty());
  CHECK(beyond.warnings == Messages{"a.txt: boxes are wholly beyond the floor: 1, the first is box 2; such a box falls "
                                    "unless others carry it"});
}

TEST_CASE("layout_check: a box that stands on a drop side, or on a floor without end, is not beyond the floor",
          "[core][layout_check]") {
  Settings settings;
  settings.container.drop_sides = {{"left", 0.6}};
  CHECK(check(cubes({{1, -1, 0.6}}), settings).warnings.empty());
  CHECK(check(cubes({{1, -1.04, 0.6}}), settings).warnings.empty());
  CHECK(check(cubes({{1, -1.05, 0.6}}), settings).warnings.size() == 1);
  settings.container.open_sides = {"rear"};
  CHECK(check(cubes({{5.87, 0, 0}}), settings).warnings.size() == 1);
  settings.container.bed_height = 0.0;
  CHECK(check(cubes({{5.87, 0, 0}}), settings).warnings.empty());
}

TEST_CASE("layout_check: fixed boxes may overlap each other, reach through a side, and carry what is beyond the floor",
          "[core][layout_check]") {
  Settings settings;
  settings.container.open_sides = {"rear"};
  settings.materials[2].fixed = true;
  Layout layout = cubes({{-0.5, 0, -0.2}, {0, 0, 0}, {6, 0, -1}, {6, 0, 0}});
  for (const std::size_t fixed : {0U, 1U, 2U}) layout.boxes[fixed].material = 2;
  const Outcome outcome = check(layout, settings);
  CHECK(outcome.errors.empty());
  CHECK(outcome.warnings.empty());
  layout.boxes[1].material = 1;
  CHECK(check(layout, settings).errors.size() == 1);
}

TEST_CASE("layout_check: zero, negative and non-finite extents", "[core][layout_check]") {
  Layout layout = cubes({{0, 0, 0}, {2, 0, 0}, {4, 0, 0}});
  layout.boxes[0].corner_max.z() = 0.0;
  layout.boxes[1].corner_max.x() = 1.5;
  layout.boxes[2].corner_max.y() = std::numeric_limits<double>::quiet_NaN();
  const std::string accepted = "; the second corner must be beyond the first along every axis, by more than 0.1 mm";
  CHECK(check(layout).errors == Messages{"a.txt:2: box 1 has no height: 0 cm" + accepted,
                                         "a.txt:3: box 2 has a negative length: -50 cm" + accepted,
                                         "a.txt:4: box 3 has a corner that is not finite"});
}

TEST_CASE("layout_check: a box no thicker than rounding is refused", "[core][layout_check]") {
  Layout layout = cubes({{0, 0, 0}, {2, 0, 0}});
  layout.boxes[0].corner_max.z() = 1e-300;
  layout.boxes[1].corner_max.z() = 0.0002;
  CHECK(check(layout).errors == Messages{"a.txt:2: box 1 has no height: 1e-298 cm; the second corner must be beyond "
                                         "the first along every axis, by more than 0.1 mm"});
}

TEST_CASE("layout_check: a centre of mass outside its box names box and material", "[core][layout_check]") {
  Layout layout = cubes({{0, 0, 0}, {2, 0, 0}});
  layout.boxes[1].material = 7;
  Settings settings;
  settings.materials[1].centre_of_mass = {0.5, -0.5, 0.0};
  CHECK(check(layout, settings).errors.empty());
  settings.materials[7].centre_of_mass = {0.0, 0.1, -0.51};
  CHECK(check(layout, settings).errors ==
        Messages{"a.txt:3: box 2 has its centre of mass outside, by CentreOfMass of [Material 7]: 0 10 -51 cm; at most "
                 "half of the box to either side, 50 x 50 x 50 cm"});
}

TEST_CASE("layout_check: many errors are counted, not listed", "[core][layout_check]") {
  const Outcome outcome = check(cubes(std::vector<Vec3>(100, Vec3::Zero())));
  REQUIRE(outcome.errors.size() == 21);
  CHECK(outcome.errors.back() == "a.txt: further errors: 4930");
}

TEST_CASE("layout_check: the sweep finds the same pairs as a check of all pairs", "[core][layout_check]") {
  Layout layout;
  Random random(1);
  for (long i = 0; i < 200; ++i) {
    const Vec3 corner = random.vector(0, 2) + Vec3(random.between(0, 3), 0, 0);
    layout.boxes.push_back({corner, corner + Vec3(random.between(0.1, 0.4), 0.2, 0.2), 1, i});
  }
  std::size_t expected = 0;
  for (std::size_t a = 0; a < layout.boxes.size(); ++a)
    for (std::size_t b = a + 1; b < layout.boxes.size(); ++b)
      expected += ((layout.boxes[a].corner_max.cwiseMin(layout.boxes[b].corner_max) -
                    layout.boxes[a].corner_min.cwiseMax(layout.boxes[b].corner_min))
                       .minCoeff() > kLayoutTolerance)
                      ? 1U
                      : 0U;
  Settings settings;
  settings.container.size = {9, 9, 9};
  const Outcome outcome = check(layout, settings);
  REQUIRE(expected > 20);
  CHECK(outcome.errors.back() == "a.txt: further errors: " + std::to_string(expected - 20));
}

}  // namespace layout_check_test
