#include "core/model/container_panels.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>
#include <vector>

#include "core/model/container_sides.hpp"

namespace container_panels_test {

using namespace holdfast::internal;

TEST_CASE("container_panels: walls stand back where boxes touch both of an axis, and the floor never",
          "[core][container_panels]") {
  const std::vector<Panel> panels = container_panels({}, 0.1);
  // Plays of a box whose gaps to one panel and to all others are these.
  const auto plays_of = [&](std::size_t k, double gap, double other) {
    std::vector<std::vector<double>> gaps(panels.size(), {other});
    gaps[k] = {gap};
    return panel_plays(panels, gaps);
  };
  for (std::size_t k = 0; k < panels.size(); ++k) {
    const std::string_view name = kPushedNames[panels[k].side];
    const double least = name == "floor" ? 0.0 : name == "roof" ? kLeastPlay : kWallPlay;
    const double alone = name == "roof" ? kLeastPlay : 0.0;
    CAPTURE(name);
    CHECK(plays_of(k, 0.0, 0.0)[k][0] == least);
    CHECK(plays_of(k, 0.0, 1.0)[k][0] == alone);
    CHECK(plays_of(k, 0.25 * least, 0.0)[k][0] == Approx(0.75 * least));
    CHECK(plays_of(k, least, 0.0)[k][0] == 0.0);
    CHECK(plays_of(k, 1.0, 0.0)[k][0] == 0.0);
    if (least > 0.0) CHECK(plays_of(k, -1e-6, 0.0)[k][0] == Approx(least + 1e-6));
  }
}

TEST_CASE("container_panels: another box may touch the opposite wall", "[core][container_panels]") {
  const std::vector<Panel> panels = container_panels({}, 0.1);
  const double far = std::numeric_limits<double>::infinity();
  std::vector<std::vector<double>> gaps(panels.size(), {far, far});
  const auto panel_of = [&](std::string_view name) {
    return static_cast<std::size_t>(std::find_if(panels.begin(), panels.end(),
                                                 [&](const Panel& panel) { return kPushedNames[panel.side] == name; }) -
                                    panels.begin());
  };
  gaps[panel_of("front")] = {0.0, far};
  gaps[panel_of("left")] = {0.0, 1.0};
  CHECK(panel_plays(panels, gaps)[panel_of("front")] == std::vector{0.0, 0.0});
  gaps[panel_of("rear")] = {far, 0.5e-6};
  CHECK(panel_plays(panels, gaps)[panel_of("front")] == std::vector{kWallPlay, 0.0});
  CHECK(panel_plays(panels, gaps)[panel_of("rear")] == std::vector{0.0, 0.5e-6});
  CHECK(panel_plays(panels, gaps)[panel_of("left")] == std::vector{0.0, 0.0});
}

}  // namespace container_panels_test
