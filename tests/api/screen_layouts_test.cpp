#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "holdfast/holdfast.hpp"

namespace screen_layouts_test {

namespace {

using holdfast::Layout;
using holdfast::LayoutView;
using holdfast::Problem;
using holdfast::Screen;
using holdfast::WorldOutcome;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

holdfast::Acceleration brake() { return {"brake", {{0.0, 0.5, {7.0, 0.0, 0.0}}}}; }

/// The problems of a layout of one box with these numbers.
std::vector<Problem> problems_of(const std::vector<double>& numbers, const holdfast::ScreenOptions& options = {}) {
  Screen screen({brake()}, options);
  const std::vector<LayoutView> layouts = {{"", numbers}};
  std::vector<WorldOutcome> worlds;
  try {
    screen.evaluate(layouts, worlds);
  } catch (const holdfast::Error& error) {
    return error.problems();
  }
  return {};
}

}  // namespace

TEST_CASE("screen: layouts in memory of the caller give the bits of layouts of boxes", "[api][screen]") {
  Screen screen({brake()}, {.accuracy = "screening"});
  const std::vector<Layout> layouts = {screen.read_layout(HOLDFAST_SOURCE_DIR "/configs/layouts/seed_example.txt"),
                                       {"one", {{{2.0, 1.0, 0.0}, {2.5, 1.5, 0.4}, 1}}}};
  std::vector<std::vector<double>> rows;
  std::vector<LayoutView> views;
  for (const Layout& layout : layouts) {
    std::vector<double>& numbers = rows.emplace_back();
    for (const holdfast::Box& box : layout.boxes) {
      numbers.insert(numbers.end(), box.corner_min.begin(), box.corner_min.end());
      numbers.insert(numbers.end(), box.corner_max.begin(), box.corner_max.end());
      numbers.push_back(box.material);
    }
  }
  for (const std::vector<double>& numbers : rows) views.push_back({"", numbers});
  const std::vector<WorldOutcome> expected = screen.evaluate(layouts);
  std::vector<WorldOutcome> worlds;
  screen.evaluate(views, worlds);
  REQUIRE(worlds.size() == 2);
  for (std::size_t i = 0; i < 2; ++i) CHECK(worlds[i].state_hash == expected[i].state_hash);
}

TEST_CASE("screen: a problem of a layout names layout, box and number", "[api][screen]") {
  const std::vector<Problem> not_finite = problems_of({2, 1, 0, 2.5, kNan, 0.5, 1});
  REQUIRE(not_finite.size() == 1);
  CHECK(not_finite[0].message == "layout 0: box 1 has a corner that is not finite");
  CHECK(not_finite[0].layout == 0);
  CHECK(not_finite[0].box == 0);
  CHECK(not_finite[0].box_column == 4);
  const std::vector<Problem> negative = problems_of({2, 1, 0, 2.5, 1.5, -0.5, 1});
  REQUIRE(negative.size() == 1);
  CHECK(negative[0].box_column == 5);
  CHECK(negative[0].what == "box 1 has a negative height");
  const std::vector<Problem> outside = problems_of({-0.5, 1, 0, 2.5, 1.5, 0.5, 1});
  REQUIRE(outside.size() == 1);
  CHECK(outside[0].box_column == 0);
  for (const double material : {-1.0, 0.5, 1e10, kNan}) {
    const std::vector<Problem> problems = problems_of({2, 1, 0, 2.5, 1.5, 0.5, material});
    REQUIRE(problems.size() == 1);
    CHECK(problems[0].what == "the material of box 1 is not an id");
    CHECK(problems[0].box_column == 6);
  }
  const std::vector<Problem> none = problems_of({});
  REQUIRE(none.size() == 1);
  CHECK(none[0].message == "layout 0: has no boxes; a layout has at least one");
  const std::vector<Problem> broken = problems_of({2, 1, 0, 2.5, 1.5, 0.5});
  REQUIRE(broken.size() == 1);
  CHECK(broken[0].what == "the layout is no whole number of boxes");
  CHECK(broken[0].box == -1);
  CHECK(broken[0].box_column == -1);
}

TEST_CASE("screen: problems of marked layouts are kept until the next call", "[api][screen]") {
  Screen screen({brake()}, {.bad_layouts = holdfast::BadLayouts::mark});
  const std::vector<double> good = {2, 1, 0, 2.5, 1.5, 0.5, 1};
  const std::vector<double> bad = {2, 1, 0, kNan, 1.5, 0.5, 1};
  const std::vector<LayoutView> layouts = {{"", good}, {"bad", bad}, {"", bad}};
  std::vector<WorldOutcome> worlds;
  screen.evaluate(layouts, worlds);
  REQUIRE(screen.problems().size() == 2);
  CHECK(screen.problems()[0].layout == 1);
  CHECK(screen.problems()[0].file == "bad");
  CHECK(screen.problems()[1].file == "layout 2");
  CHECK(worlds[2].message == screen.problems()[1].message);
  screen.evaluate(std::span(layouts).first(1), worlds);
  CHECK(screen.problems().empty());
}

TEST_CASE("screen: a layout of which the caller says what is wrong is a bad one", "[api][screen]") {
  const std::vector<double> good = {2, 1, 0, 2.5, 1.5, 0.5, 1};
  const holdfast::Problem problem{.what = "a wrong shape", .value = "(1, 6)", .accepted = "(boxes, 7)"};
  const std::vector<LayoutView> layouts = {{"", good}, {.name = "bad", .problem = &problem}};
  std::vector<WorldOutcome> worlds;
  Screen raising({brake()}, {});
  CHECK_THROWS_WITH(raising.evaluate(layouts, worlds), "bad: a wrong shape: (1, 6); (boxes, 7)");
  Screen marking({brake()}, {.bad_layouts = holdfast::BadLayouts::mark});
  marking.evaluate(layouts, worlds);
  CHECK(worlds[0].status == holdfast::status::ok);
  CHECK(worlds[1].status == holdfast::status::bad_layout);
  CHECK(worlds[1].message == "bad: a wrong shape: (1, 6); (boxes, 7)");
  REQUIRE(marking.problems().size() == 1);
  CHECK(marking.problems()[0].layout == 1);
}

TEST_CASE("screen: accelerations are added one by one", "[api][screen]") {
  Screen screen(holdfast::ScreenOptions{});
  const std::vector<Layout> layouts = {{"one", {{{2.0, 1.0, 0.0}, {2.5, 1.5, 0.5}, 1}}}};
  CHECK_THROWS_WITH(screen.evaluate(layouts), Catch::Contains("at least one acceleration"));
  screen.add_acceleration(brake());
  CHECK_THROWS_WITH(screen.add_acceleration({"none", {}}), Catch::Contains("none: the acceleration has no segments"));
  screen.add_acceleration({"second", {{0.0, 0.5, {1.0, 0.0, 0.0}}}});
  REQUIRE(screen.accelerations().size() == 2);
  CHECK(screen.accelerations()[1].name == "second");
  CHECK(screen.evaluate(layouts).size() == 2);
}

}  // namespace screen_layouts_test
