#include "io/loads/floating_boxes.hpp"

#include <catch2/catch.hpp>

namespace floating_boxes_test {

using namespace holdfast::internal;

TEST_CASE("floating_boxes: a box on a drop side does not float", "[io][floating_boxes]") {
  Settings settings;
  const Layout layout{.boxes = {{{1, -0.08, 0.6}, {2, 0, 1}, 1}, {{2, -1, 0.6}, {3, -0.06, 1}, 1}}};
  CHECK(count_floating(layout, settings).floating == 2);
  settings.container.drop_sides = {{"left", 0.6}};
  CHECK(count_floating(layout, settings).floating == 1);
  settings.container.drop_sides = {{"left", 0.5}};
  CHECK(count_floating(layout, settings).floating == 2);
}

}  // namespace floating_boxes_test
