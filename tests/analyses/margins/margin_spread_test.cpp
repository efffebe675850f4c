#include "analyses/margins/margin_spread.hpp"

#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <vector>

#include "analyses/margins/margin_search.hpp"
#include "analyses/replicas/replica_inputs.hpp"
#include "core/native/native_engine.hpp"
#include "scenes.hpp"

namespace margin_spread_test {

using namespace holdfast::internal;
using namespace holdfast::internal::scenes;

namespace {

MarginSpread spread_of(const Layout& layout, const Settings& settings) {
  const std::atomic<bool> abort = false;
  const auto spread = find_margin_spread(NativeEngine(settings), layout, settings, abort);
  REQUIRE(spread.has_value());
  return *spread;
}

Settings floor_with_replicas(double friction) {
  Settings settings = open_floor(friction);
  settings.contact.friction_model = FrictionModel::pairs;
  settings.contact.box_floor = friction;
  settings.screening.replicas = 41;  // so that the quantiles are numbers of the 3rd, 21st and 39th replica
  return settings;
}

}  // namespace

TEST_CASE("margin_spread: a box that slides stands the friction of its replicas", "[margin_spread]") {
  const Settings settings = floor_with_replicas(0.4);
  const Layout layout = layout_of({box({9, 9, 0}, {1, 1, 0.2})});
  std::vector<double> friction;
  const ReplicaInputs inputs(layout, settings);
  for (const ReplicaDraw& draw : inputs.draws()) friction.push_back(0.4 * draw.box_floor);
  std::sort(friction.begin(), friction.end());
  REQUIRE(friction.back() - friction.front() > 0.1);
  const MarginSpread spread = spread_of(layout, settings);
  const auto check = [](const std::array<double, kDirectionCount>& margins, double exact) {
    for (const double margin : margins) {
      // Within the limits: so much more moves it by less than 10 cm in 5 s.
      CHECK(margin <= exact + 2.0 * 0.1 / 25.0 / kStandardGravity);
      CHECK(margin >= exact - 1.0 / kMarginUnits - 1e-4);
    }
  };
  check(spread.low, friction.at(2));
  check(spread.median, friction.at(20));
  check(spread.high, friction.at(38));
}

TEST_CASE("margin_spread: where a box tips, friction does not matter, but its place does", "[margin_spread]") {
  // 0.3 g tip the upper box over the edge of the lower one, to the front, and less when it stands out.
  Settings settings = floor_with_replicas(0.9);
  settings.contact.box_box = 0.9;
  const Layout layout = layout_of({box({9, 9, 0}, {0.3, 1, 1}), box({9, 9, 1}, {0.3, 1, 0.1})});
  const MarginSpread fixed = spread_of(layout_of({box({9, 9, 0}, {0.3, 1, 1.0})}), settings);
  CHECK(fixed.low.at(0) == Approx(0.3).margin(1.0 / kMarginUnits));
  CHECK(fixed.high.at(0) == Approx(0.3).margin(1.0 / kMarginUnits));
  settings.screening.play_shift = 0.05;
  const MarginSpread shifted = spread_of(layout, settings);
  CHECK(shifted.high.at(0) - shifted.low.at(0) > 0.005);
}

TEST_CASE("margin_spread: an abort leaves nothing", "[margin_spread]") {
  const Settings settings = floor_with_replicas(0.4);
  const std::atomic<bool> abort = true;
  CHECK_FALSE(find_margin_spread(NativeEngine(settings), layout_of({box({9, 9, 0}, {1, 1, 0.2})}), settings, abort));
}

}  // namespace margin_spread_test
