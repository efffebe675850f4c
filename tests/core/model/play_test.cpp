#include "core/model/play.hpp"

#include <catch2/catch.hpp>
#include <set>

#include "analyses/replicas/replica_draw.hpp"
#include "core/model/layout_check.hpp"
#include "random.hpp"
#include "scenes.hpp"

namespace play_test {

using namespace holdfast::internal;
using namespace holdfast::internal::scenes;

namespace {

using Room = std::array<double, 2>;

Settings container_of(const Vec3& size) {
  Settings settings;
  settings.container.size = size;
  return settings;
}

void check_room(const BoxPlay& play, const Room& back, const Room& forth) {
  for (const std::size_t side : {0U, 1U}) {
    CAPTURE(side);
    CHECK(play.back.at(side) == Approx(back.at(side)).margin(1e-12));
    CHECK(play.forth.at(side) == Approx(forth.at(side)).margin(1e-12));
  }
}

}  // namespace

TEST_CASE("play: a box alone has the gaps to the walls, up to the largest shift", "[play]") {
  const Layout layout = layout_of({box({0.01, 0.1, 0}, {1, 1, 1})});
  const std::vector<BoxPlay> play = play_of(layout, container_of({1.03, 1.2, 2}), 0.05);
  check_room(play.at(0), {0.01, 0.05}, {0.02, 0.05});
}

TEST_CASE("play: neighbours have half of the gap between them, and a box on another has all", "[play]") {
  const Layout layout = layout_of({box({0, 0, 0}, {1, 1, 1}), box({1.04, 0, 0}, {1, 1, 1}), box({0, 0, 1}, {1, 1, 1})});
  const std::vector<BoxPlay> play = play_of(layout, container_of({3, 1.02, 3}), 0.1);
  check_room(play.at(0), {0.0, 0.0}, {0.02, 0.02});
  check_room(play.at(1), {0.02, 0.0}, {0.1, 0.02});
  check_room(play.at(2), {0.0, 0.0}, {0.1, 0.02});
}

TEST_CASE("play: a fixed box has no play, and leaves its neighbour all of the gap", "[play]") {
  Settings settings = container_of({3, 1, 3});
  settings.materials[2].fixed = true;
  Layout layout = layout_of({box({0, 0, 0}, {1, 1, 1}), box({1.04, 0, 0}, {1, 1, 1})});
  layout.boxes[1].material = 2;
  const std::vector<BoxPlay> play = play_of(layout, settings, 0.1);
  check_room(play.at(0), {0.0, 0.0}, {0.04, 0.0});
  check_room(play.at(1), {0.0, 0.0}, {0.0, 0.0});
}

TEST_CASE("play: boxes at a corner of each other keep the larger of their two gaps", "[play]") {
  const Layout layout = layout_of({box({0, 0, 0}, {1, 1, 1}), box({1.01, 1.03, 0}, {1, 1, 1})});
  const std::vector<BoxPlay> play = play_of(layout, container_of({4, 4, 2}), 0.2);
  check_room(play.at(0), {0.0, 0.0}, {0.2, 0.015});
  check_room(play.at(1), {0.2, 0.015}, {0.2, 0.2});
}

TEST_CASE("play: boxes that touch or overlap by rounding do not approach each other", "[play]") {
  const double overlap = GENERATE(0.0, 5e-5);
  const Layout layout = layout_of(
      {box({0, 0, 0}, {1, 1, 1}), box({1.0 - overlap, 0, 0}, {1, 1, 1}), box({0, 0, 1.0 - overlap}, {1, 1, 1})});
  const std::vector<BoxPlay> play = play_of(layout, container_of({3, 1, 3}), 0.1);
  CHECK(play.at(0).forth[0] == 0.0);
  CHECK(play.at(1).back[0] == 0.0);
  CHECK(play.at(2).forth[0] == 0.1);
}

TEST_CASE("play: shifted layouts of boxes anywhere are good layouts", "[play]") {
  Settings settings;
  settings.container.size = {6, 2.4, 2.4};
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    Layout layout;
    // Boxes in a grid of cells, each anywhere in its cell, on two levels.
    for (int cell = 0; cell < 60; ++cell) {
      const int row = cell / 10 % 3;
      const int level = cell / 30;
      const Vec3 origin(0.6 * (cell % 10), 0.8 * row, 1.0 * level);
      const double length = 0.3 + 0.3 * random.between(0, 1);
      const double width = 0.4 + 0.4 * random.between(0, 1);
      const double x = (0.6 - length) * random.between(0, 1);
      const double y = (0.8 - width) * random.between(0, 1);
      const Vec3 corner = origin + Vec3(x, y, 0);
      layout.boxes.push_back({corner, corner + Vec3(length, width, 1.0), 1, cell + 2});
    }
    std::vector<Error> warnings;
    REQUIRE(check_layout(layout, settings, "grid", warnings).empty());
    const std::vector<BoxPlay> play = play_of(layout, settings, 0.5);
    std::set<double> places;
    for (std::uint32_t number = 1; number <= 10; ++number) {
      const Layout shifted = shifted_layout(layout, play, boxes_hash(layout), number);
      CHECK(check_layout(shifted, settings, "shifted", warnings).empty());
      places.insert(shifted.boxes.back().corner_min.x());
    }
    CHECK(places.size() == 10);
  }
}

TEST_CASE("play: shifts have the same bits on every machine", "[play]") {
  // Computed by the same formulas in Python.
  const Layout layout = layout_of({box({0, 0, 0}, {1, 1, 1})});
  const std::vector<BoxPlay> play = {{.back = {0.25, 0.0}, .forth = {0.5, 0.0}}};
  const Box shifted = shifted_layout(layout, play, 0x0123456789abcdefULL, 3).boxes.at(0);
  CHECK(shifted.corner_min.x() == 0x1.3080d9fef91e2p-2);
}

TEST_CASE("play: shifts fill the play evenly", "[play]") {
  const Layout layout = layout_of({box({0, 0, 0}, {1, 1, 1})});
  const std::vector<BoxPlay> play = {{.back = {0.1, 0.0}, .forth = {0.3, 0.0}}};
  double sum = 0.0;
  double squares = 0.0;
  constexpr int kDraws = 4000;
  for (int number = 1; number <= kDraws; ++number) {
    const Box shifted = shifted_layout(layout, play, 7, static_cast<std::uint32_t>(number)).boxes.at(0);
    const double shift = shifted.corner_min.x();
    REQUIRE(shift >= -0.1);
    REQUIRE(shift <= 0.3);
    CHECK(shifted.corner_min.y() == 0.0);
    sum += shift;
    squares += shift * shift;
  }
  const double mean = sum / kDraws;
  CHECK(mean == Approx(0.1).margin(0.006));                                       // 0.4 / √12 / √4000 is 0.0018
  CHECK(squares / kDraws - mean * mean == Approx(0.4 * 0.4 / 12).epsilon(0.08));  // of a uniform distribution
}

}  // namespace play_test
