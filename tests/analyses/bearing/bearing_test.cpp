#include "analyses/bearing/bearing.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "app/bearing_table.hpp"
#include "random.hpp"
#include "scenes.hpp"

namespace bearing_test {

using namespace holdfast::internal;
using namespace holdfast::internal::scenes;

namespace {

/// A box of that mass, kg.
Box heavy(const Vec3& corner, const Vec3& size, double mass) {
  Box made = box(corner, size);
  made.mass = mass;
  return made;
}

void check_range(const BearingRange& range, double least, double largest) {
  CAPTURE(range.least, range.largest);
  CHECK(range.least == Approx(least).margin(1e-6));
  CHECK(range.largest == Approx(largest).margin(1e-6));
}

/// A plank of 2 m and 60 kg across two posts of 0.5 m, at x = 0 to 2.
std::vector<Box> bridge() {
  return {heavy({0, 0, 0}, {0.5, 0.4, 1}, 100), heavy({1.5, 0, 0}, {0.5, 0.4, 1}, 100),
          heavy({0, 0, 1}, {2, 0.4, 0.1}, 60)};
}

/// Layers of boxes of random sizes and masses, most of which stand on several others. All stand.
Layout random_layers(Random& random, int layers) {
  Layout layout = layout_of({});
  for (int layer = 0; layer < layers; ++layer)
    for (double y : {0.0, 0.6})
      for (double x = 0.0; x < 1.6;) {
        // Their sides meet, so that those of the layer above have support below all of them.
        const double length = std::min(2.0 - x, random.between(0.4, 0.7));
        layout.boxes.push_back(
            heavy({x, y, 0.3 * layer}, {2.0 - x - length < 0.4 ? 2.0 - x : length, 0.6, 0.3}, random.between(5, 50)));
        x = layout.boxes.back().corner_max.x();
      }
  return layout;
}

double mass_of(const Layout& layout) {
  double mass = 0.0;
  for (const Box& it : layout.boxes) mass += *it.mass;
  return mass;
}

}  // namespace

TEST_CASE("bearing: in a stack each box carries the mass above it", "[analyses][bearing]") {
  const Layout layout = layout_of({heavy({0, 0, 0}, {1, 1, 1}, 30), heavy({0, 0, 1}, {1, 1, 0.5}, 20),
                                   heavy({0.2, 0.2, 1.5}, {0.5, 0.5, 0.5}, 7), heavy({3, 0, 0}, {1, 1, 1}, 99)});
  const auto found = find_bearing(layout, {});
  check_range(found[0], 27, 27);
  check_range(found[1], 7, 7);
  check_range(found[2], 0, 0);
  check_range(found[3], 0, 0);
}

TEST_CASE("bearing: a post carries what the moments of its plank leave open", "[analyses][bearing]") {
  // The forces on the posts act at x1 in [0, w] and x2 in [2 - w, 2], the weight at 1: the first carries
  // M (x2 - 1) / (x2 - x1), from M (1 - w) / (2 - w) to M / (2 - w).
  Layout layout = layout_of(bridge());
  auto found = find_bearing(layout, {});
  check_range(found[0], 60 * 0.5 / 1.5, 60 / 1.5);
  check_range(found[1], 60 * 0.5 / 1.5, 60 / 1.5);
  check_range(found[2], 0, 0);

  // A weight of 12 kg whose middle is at 0.25 adds its own, (2 - w - 0.25) / (2 - w) of it at least: M x = 63 kg m
  // about 0.
  layout.boxes.push_back(heavy({0.2, 0.1, 1.1}, {0.1, 0.1, 0.1}, 12));
  found = find_bearing(layout, {});
  const double moment = 60 * 1 + 12 * 0.25;
  check_range(found[1], (moment - 72 * 0.5) / (2 - 0.5), moment / 1.5);
  check_range(found[0], 72 - moment / 1.5, 72 - (moment - 72 * 0.5) / 1.5);
  check_range(found[2], 12, 12);

  // With the centre of mass above the middle of a post, the other may carry nothing.
  layout.boxes = bridge();
  layout.boxes[2].centre_of_mass = Vec3(-0.75, 0, 0);
  found = find_bearing(layout, {});
  check_range(found[0], 60 * (1.5 - 0.25) / 1.5, 60);
  check_range(found[1], 0, 60 * 0.25 / 1.5);
}

TEST_CASE("bearing: a box over four others is shared among them", "[analyses][bearing]") {
  // Its diagonals alone may carry it, and so may one of the pairs.
  std::vector<Box> boxes;
  for (const double x : {0.0, 0.5})
    for (const double y : {0.0, 0.5}) boxes.push_back(heavy({x, y, 0}, {0.5, 0.5, 0.5}, 10));
  boxes.push_back(heavy({0, 0, 0.5}, {1, 1, 0.5}, 40));
  const auto found = find_bearing(layout_of(boxes), {});
  // All of it in the middle, where the four meet: each of them may have all of it, or none.
  for (std::size_t i = 0; i < 4; ++i) check_range(found[i], 0, 40);
}

TEST_CASE("bearing: the floor ends at an open side, and a low wall carries what stands on it", "[analyses][bearing]") {
  Settings settings;
  settings.container.size = {4, 2, 2};
  settings.container.open_sides = {"rear"};
  settings.container.drop_sides = {{"left", 0.5}};
  // Over the sill by 49 % and 51 % of its length; a plank that 30 kg at its outer end tip, and the same within the
  // floor.
  Layout layout = layout_of({heavy({3.51, 0, 0}, {1, 0.4, 0.5}, 20), heavy({3.49, 0.5, 0}, {1, 0.4, 0.5}, 20),
                             heavy({3.0, 1.0, 0}, {1.5, 0.4, 0.1}, 10), heavy({4.3, 1.0, 0.1}, {0.2, 0.4, 0.2}, 30),
                             heavy({1.0, 1.0, 0}, {1.5, 0.4, 0.1}, 10), heavy({2.3, 1.0, 0.1}, {0.2, 0.4, 0.2}, 30)});
  std::swap(layout.boxes[0], layout.boxes[1]);
  auto found = find_bearing(layout, settings);
  CHECK(found[0].footing == Footing::stands);
  CHECK(found[1].footing == Footing::tips);
  CHECK(found[2].footing == Footing::tips);
  CHECK(found[4].footing == Footing::stands);
  check_range(found[4], 30, 30);
  settings.container.bed_height = 0.0;  // the floor has no end
  CHECK(find_bearing(layout, settings)[1].footing == Footing::stands);
  settings.container.bed_height = 1.2;

  // A tail-lift, level with the floor, alone carries what stands on it; and the top of the drop side is 5 cm wide.
  layout = layout_of({heavy({4, 0, -0.1}, {1, 2, 0.1}, 100), heavy({4.2, 0.5, 0}, {0.5, 0.5, 0.5}, 50),
                      heavy({1, -0.05, 0.5}, {0.5, 0.09, 0.5}, 5), heavy({2, -0.05, 0.5}, {0.5, 0.11, 0.5}, 5)});
  layout.boxes[0].fixed = true;
  found = find_bearing(layout, settings);
  check_range(found[0], 50, 50);
  CHECK(found[2].footing == Footing::stands);
  CHECK(found[3].footing == Footing::tips);
}

TEST_CASE("bearing: an overhanging box stands with a counterweight, and tips without", "[analyses][bearing]") {
  // 1.6 m on a base of 0.6 m: the centre of mass is 0.2 m outside.
  Layout layout = layout_of({heavy({0, 0, 0}, {0.6, 1, 1}, 50), heavy({0, 0, 1}, {1.6, 1, 0.2}, 30)});
  auto found = find_bearing(layout, {});
  CHECK(found[0].footing == Footing::stands);
  CHECK(found[1].footing == Footing::tips);
  // What holds it upright from the side takes no weight.
  check_range(found[0], 30, 30);

  // 30 kg · 0.2 m against 15 kg · 0.5 m.
  layout.boxes.push_back(heavy({0, 0, 1.2}, {0.2, 1, 0.2}, 15));
  found = find_bearing(layout, {});
  for (const BearingRange& range : found) CHECK(range.footing == Footing::stands);
  check_range(found[0], 45, 45);

  // Of 11 kg it takes 12 for balance, and the counterweight is lifted.
  layout.boxes[2].mass = 11;
  found = find_bearing(layout, {});
  CHECK(found[0].footing == Footing::stands);
  CHECK(found[1].footing == Footing::tips);
  check_range(found[0], 41, 41);
}

TEST_CASE("bearing: a centre of mass above the very edge is balanced", "[analyses][bearing]") {
  for (const double shift : {0.0, 0.1, 0.7, 3.3}) {
    Layout layout = layout_of({heavy({shift, 0, 0}, {0.6, 1, 1}, 50), heavy({shift, 0, 1}, {1.2, 1, 0.2}, 30)});
    CHECK(find_bearing(layout, {})[1].footing == Footing::stands);
    layout.boxes[1].corner_max.x() += 2e-4;
    CHECK(find_bearing(layout, {})[1].footing == Footing::tips);
  }
}

TEST_CASE("bearing: what has nothing beneath it rests on none, and carries", "[analyses][bearing]") {
  const Layout layout = layout_of(
      {heavy({0, 0, 0}, {1, 1, 1}, 30), heavy({0, 0, 1.002}, {1, 1, 1}, 20), heavy({0, 0, 2.002}, {1, 1, 1}, 10)});
  const auto found = find_bearing(layout, {});
  CHECK(found[1].footing == Footing::unsupported);
  CHECK(found[2].footing == Footing::stands);
  check_range(found[0], 0, 0);
  check_range(found[1], 10, 10);
}

TEST_CASE("bearing: boxes that meet at an edge carry nothing of each other", "[analyses][bearing]") {
  // The upper box ends where the second begins, up to rounding.
  const Layout layout = layout_of({heavy({0.1, 0, 0}, {0.2, 1, 1}, 30), heavy({0.1 + 0.2, 0, 0}, {0.5, 1, 1}, 30),
                                   heavy({0, 0, 1}, {0.30000000000000010, 1, 1}, 20)});
  const auto found = find_bearing(layout, {});
  check_range(found[0], 20, 20);
  check_range(found[1], 0, 0);
}

TEST_CASE("bearing: fixed boxes carry, have no weight and press on nothing", "[analyses][bearing]") {
  Layout layout =
      layout_of({heavy({0, 0, 0}, {1, 1, 1}, 30), heavy({0, 0, 1}, {1, 1, 1}, 20), heavy({0, 0, 2}, {1, 1, 1}, 10)});
  layout.boxes[1].fixed = true;
  const auto found = find_bearing(layout, {});
  check_range(found[0], 0, 0);
  check_range(found[1], 10, 10);
  CHECK(found[1].footing == Footing::stands);
}

TEST_CASE("bearing: a plate below all carries the mass of all", "[analyses][bearing]") {
  Random random(7);
  for (const bool fixed : {false, true}) {
    Layout layout = random_layers(random, 4);
    const double mass = mass_of(layout);
    for (Box& it : layout.boxes) {
      it.corner_min.z() += 0.2;
      it.corner_max.z() += 0.2;
    }
    layout.boxes.push_back(heavy({-0.1, -0.1, 0}, {2.2, 1.4, 0.2}, 80));
    layout.boxes.back().fixed = fixed;
    const auto found = find_bearing(layout, {});
    check_range(found.back(), mass, mass);
    for (const BearingRange& range : found) CHECK(range.footing == Footing::stands);
  }
}

TEST_CASE("bearing: every layer carries what is above it", "[analyses][bearing]") {
  // Equilibria are a convex set: the sums of the least loads and of the largest enclose what a layer carries.
  Random random(8);
  for (int trial = 0; trial < 5; ++trial) {
    const Layout layout = random_layers(random, 4);
    const auto found = find_bearing(layout, {});
    for (int layer = 0; layer < 4; ++layer) {
      double above = 0.0, least = 0.0, largest = 0.0;
      for (std::size_t i = 0; i < found.size(); ++i) {
        const double z = layout.boxes[i].corner_min.z();
        if (z > 0.3 * layer + 0.1) above += *layout.boxes[i].mass;
        if (std::abs(z - 0.3 * layer) > 0.1) continue;
        least += found[i].least;
        largest += found[i].largest;
      }
      CAPTURE(least, above, largest);
      CHECK(least <= above + 1e-6);
      CHECK(largest >= above - 1e-6);
    }
  }
}

TEST_CASE("bearing: mirrored, turned, scaled or in another order a load bears the same", "[analyses][bearing]") {
  Random random(9);
  for (int trial = 0; trial < 5; ++trial) {
    const Layout layout = random_layers(random, 3 + trial % 2);
    const auto found = find_bearing(layout, {});
    Layout mirrored = layout;
    Layout turned = layout;
    Layout scaled = layout;
    Layout reversed = layout;
    for (std::size_t i = 0; i < layout.boxes.size(); ++i) {
      const Box& it = layout.boxes[i];
      mirrored.boxes[i].corner_min.x() = 2.0 - it.corner_max.x();
      mirrored.boxes[i].corner_max.x() = 2.0 - it.corner_min.x();
      std::swap(turned.boxes[i].corner_min.x(), turned.boxes[i].corner_min.y());
      std::swap(turned.boxes[i].corner_max.x(), turned.boxes[i].corner_max.y());
      scaled.boxes[i].corner_min *= 1.7;
      scaled.boxes[i].corner_max *= 1.7;
      scaled.boxes[i].mass = 3.0 * *it.mass;
    }
    std::reverse(reversed.boxes.begin(), reversed.boxes.end());
    const auto as_mirrored = find_bearing(mirrored, {});
    const auto as_turned = find_bearing(turned, {});
    const auto as_scaled = find_bearing(scaled, {});
    const auto as_reversed = find_bearing(reversed, {});
    for (std::size_t i = 0; i < found.size(); ++i) {
      check_range(as_mirrored[i], found[i].least, found[i].largest);
      check_range(as_turned[i], found[i].least, found[i].largest);
      check_range(as_scaled[i], 3 * found[i].least, 3 * found[i].largest);
      check_range(as_reversed[found.size() - 1 - i], found[i].least, found[i].largest);
    }
  }
}

TEST_CASE("bearing: limits are exceeded for sure, possibly or not", "[analyses][bearing]") {
  // Each post carries 20 to 40 kg.
  Layout layout = layout_of(bridge());
  CHECK(find_bearing_of("a.txt", layout, {}, false).text.empty());
  layout.boxes[0].bearing_limit = 15;
  layout.boxes[1].bearing_limit = 30;
  layout.boxes[1].name = "crate";
  layout.boxes[2].bearing_limit = 0;
  BearingFindings findings = find_bearing_of("a.txt", layout, {}, false);
  REQUIRE(findings.warnings.size() == 1);
  CHECK(
      findings.warnings[0].message() ==
      "a.txt: 1 of 3 bearing limits exceeded, however the weight is shared; the worst: box 1 carries 20.0 to 40.0 kg, "
      "limit 15.0 kg");
  CHECK(findings.text ==
        "  1 of 3 bearing limits possibly exceeded, depending on how the weight is shared; the worst: box 2 (crate) "
        "carries 20.0 to 40.0 kg, limit 30.0 kg\n");
  layout.boxes[0].bearing_limit = layout.boxes[1].bearing_limit = 40;
  findings = find_bearing_of("a.txt", layout, {}, true);
  CHECK(findings.warnings.empty());
  CHECK(findings.text ==
        "  none of 3 bearing limits exceeded\n"
        "  layout.txt: what rests on each box, kg\n"
        "     box  name         mass       least     largest       limit\n"
        "       1             100.00       20.00       40.00       40.00\n"
        "       2  crate      100.00       20.00       40.00       40.00\n"
        "       3              60.00        0.00        0.00        0.00\n");
}

TEST_CASE("bearing: boxes that cannot stand are named", "[analyses][bearing]") {
  const Layout layout = layout_of(
      {heavy({0, 0, 0}, {0.6, 1, 1}, 50), heavy({0, 0, 1}, {1.6, 1, 0.2}, 30), heavy({3, 0, 0.5}, {1, 1, 1}, 30)});
  const BearingFindings findings = find_bearing_of("a.txt", layout, {}, true);
  REQUIRE(findings.warnings.size() == 2);
  CHECK(findings.warnings[0].message() ==
        "a.txt: vertical forces alone cannot balance these boxes, which count as held upright from the side: box 2");
  CHECK(findings.warnings[1].message() == "a.txt: nothing is beneath these boxes, whose weight rests on none: box 3");
}

}  // namespace bearing_test
