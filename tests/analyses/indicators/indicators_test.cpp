#include "analyses/indicators/indicators.hpp"

#include <algorithm>
#include <cmath>

#include "physics/measures.hpp"

namespace indicators_test {

using namespace holdfast::internal;
using namespace holdfast::internal::scenes;
using namespace holdfast::internal::physics;

namespace {

/// A container of 4 m x 2 m x 2 m.
Settings small_container() {
  Settings settings;
  settings.container.size = {4, 2, 2};
  return settings;
}

}  // namespace

TEST_CASE("indicators: what a box stands on, as a share of its bottom face", "[core][indicators]") {
  const Layout layout =
      layout_of({box({1, 0.5, 0}, {1, 1, 0.5}), box({2.2, 0.5, 0}, {0.6, 1, 0.5}),
                 // Over the gap between the two, over the edge of one, and in the air.
                 box({1, 0.5, 0.5}, {2, 1, 0.5}), box({0, 0, 1.0}, {1.5, 1, 0.5}), box({3, 0, 0.3}, {0.5, 0.5, 0.5})});
  const LayoutIndicators found = find_indicators(layout, small_container());
  CHECK(found.base_support[0] == 1.0F);
  CHECK(found.base_support[1] == 1.0F);
  CHECK(static_cast<double>(found.base_support[2]) == Approx(0.8));
  CHECK(static_cast<double>(found.base_support[3]) == Approx(0.5 * 0.5 / 1.5));
  CHECK(found.base_support[4] == 0.0F);
  CHECK(found.badly_based == Approx(0.4));
}

TEST_CASE("indicators: the floor ends at an open side, and a low wall is as high as it is", "[core][indicators]") {
  Settings settings = small_container();
  settings.container.open_sides = {"rear"};
  settings.container.drop_sides = {{"left", 0.5}};
  // Over the sill by a half and wholly; beside the drop side, above it, and on top of it.
  const Layout layout =
      layout_of({box({3.5, 0.5, 0}, {1, 1, 0.5}), box({4.1, 0.5, 0}, {1, 1, 0.5}), box({0.5, 0, 0}, {0.5, 0.2, 0.5}),
                 box({1.5, 0, 0.6}, {0.5, 0.2, 0.5}), box({2.5, -0.05, 0.5}, {0.5, 0.1, 0.5})});
  const LayoutIndicators found = find_indicators(layout, settings);
  const std::vector<double> base(found.base_support.begin(), found.base_support.end());
  CHECK(base[0] == Approx(0.5));
  CHECK(base[1] == 0.0);
  CHECK(base[2] == Approx(1.0));
  CHECK(base[3] == 0.0);
  CHECK(base[4] == Approx(0.5));
  CHECK(found.supported_sides == std::vector<std::uint8_t>{0, 0, 1, 0, 0});
}

TEST_CASE("indicators: a load of fixed boxes has what is known of each box, and nothing of the load",
          "[core][indicators]") {
  Settings settings = small_container();
  settings.materials[2].fixed = true;
  const LayoutIndicators found = find_indicators(layout_of({box({0, 0, 0}, {1, 1, 1}, 2)}), settings);
  CHECK(found.base_support == std::vector<float>{1.0F});
  CHECK(found.supported_sides.size() == 1);
  CHECK(std::isnan(found.fill));
  CHECK(std::isnan(found.badly_based));
}

TEST_CASE("indicators: sides that touch a wall or a box", "[core][indicators]") {
  Settings settings = small_container();
  // In the corner of front and left, beside it with a gap of 5 mm, beside that with a gap of 5 cm, and diagonally.
  const Layout layout = layout_of({box({0, 0, 0}, {1, 1, 1}), box({1.005, 0, 0}, {1, 1, 1}),
                                   box({2.055, 0.2, 0}, {1, 1, 1}), box({0, 1, 1.0}, {1, 0.9, 0.5})});
  const LayoutIndicators found = find_indicators(layout, settings);
  CHECK(found.supported_sides == std::vector<std::uint8_t>{3, 2, 0, 1});
  CHECK(found.badly_braced == 0.75);
  settings.container.open_sides = {"left"};
  CHECK(find_indicators(layout, settings).supported_sides == std::vector<std::uint8_t>{2, 1, 0, 1});
}

TEST_CASE("indicators: centre of gravity and fill", "[core][indicators]") {
  Settings settings = small_container();
  settings.materials[2].mass = 1000.0;
  settings.materials[2].centre_of_mass = {0, 0, 0.1};
  // 250 kg at (0.5, 0.5, 0.5), 1000 kg at (3.5, 1.5, 0.6).
  const Layout layout = layout_of({box({0, 0, 0}, {1, 1, 1}), box({3, 1, 0}, {1, 1, 1}, 2)});
  const LayoutIndicators found = find_indicators(layout, settings);
  CHECK(found.centre_of_gravity.isApprox(Vec3(0.2 * 0.5 + 0.8 * 3.5, 0.2 * 0.5 + 0.8 * 1.5, 0.2 * 0.5 + 0.8 * 0.6)));
  CHECK(found.centre_offset.isApprox(Vec3(2.9 / 4 - 0.5, 1.3 / 2 - 0.5, 0.58 / 2 - 0.5)));
  CHECK(found.fill == Approx(2.0 / 16.0));
}

TEST_CASE("indicators: the order of the boxes does not matter, and no boxes are unknown", "[core][indicators]") {
  Layout layout = bundled_layout("BR15_077_ep", Settings{});
  const LayoutIndicators found = find_indicators(layout, Settings{});
  std::reverse(layout.boxes.begin(), layout.boxes.end());
  LayoutIndicators reversed = find_indicators(layout, Settings{});
  std::reverse(reversed.supported_sides.begin(), reversed.supported_sides.end());
  CHECK(found.supported_sides == reversed.supported_sides);
  CHECK(found.badly_based == reversed.badly_based);
  CHECK(found.badly_braced == reversed.badly_braced);
  CHECK(std::isnan(find_indicators(layout_of({}), Settings{}).fill));
  CHECK(find_indicators(layout_of({}), Settings{}).base_support.empty());
}

}  // namespace indicators_test
