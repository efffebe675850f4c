#include "analyses/margins/margin_search.hpp"

#include <atomic>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/native/native_engine.hpp"
#include "same_bits.hpp"
#include "scenes.hpp"

namespace margin_search_test {

using namespace holdfast::internal;
using namespace holdfast::internal::scenes;

namespace {

LayoutMargins margins_of(const Layout& layout, const Settings& settings) {
  const std::atomic<bool> abort = false;
  const auto margins = find_margins(NativeEngine(settings), layout, settings, abort);
  REQUIRE(margins.has_value());
  return *margins;
}

/// A margin is what the layout holds, and it does not hold a unit more.
void check_margin(double margin, double exact) {
  CHECK(margin <= exact + 1e-4);
  CHECK(margin >= exact - 1.0 / kMarginUnits - 1e-4);
}

}  // namespace

TEST_CASE("margin_search: a box slides at its friction and tips at its width over its height", "[margin_search]") {
  const auto accuracy = GENERATE(Accuracy::screening, Accuracy::standard);
  for (const double friction : {0.2, 0.5, 0.9}) {
    Settings settings = open_floor(friction);
    settings.native.accuracy = accuracy;
    // 0.8 m along x, 0.3 m across, 1 m high.
    const LayoutMargins margins = margins_of(layout_of({box({9, 9, 0}, {0.8, 0.3, 1.0})}), settings);
    CAPTURE(friction);
    for (const std::size_t direction : {0U, 1U}) check_margin(margins.margin.at(direction), std::min(friction, 0.8));
    for (const std::size_t direction : {2U, 3U}) check_margin(margins.margin.at(direction), std::min(friction, 0.3));
    CHECK(margins.critical_box == std::array<std::uint32_t, 4>{1, 1, 1, 1});
  }
}

TEST_CASE("margin_search: a load that holds exactly what a norm asks for has that margin", "[margin_search]") {
  const auto accuracy = GENERATE(Accuracy::screening, Accuracy::standard, Accuracy::reference);
  for (const double needed : {0.3, 0.5, 0.8}) {
    Settings settings = open_floor(needed);
    settings.native.accuracy = accuracy;
    const LayoutMargins margins = margins_of(layout_of({box({9, 9, 0}, {1, 1, 0.2})}), settings);
    CAPTURE(needed);
    for (const double margin : margins.margin) CHECK(margin == needed);
    for (const double margin : margins.margin_within_limits) CHECK(margin == needed);
  }
}

TEST_CASE("margin_search: the box that goes first is named", "[margin_search]") {
  // A stack that tips as a whole above 0.4/2, and beside it a box that slides above 0.5.
  Layout layout = stack(4, {9, 9, 0}, {0.4, 1.0, 0.5});
  layout.boxes.push_back(box({12, 9, 0}, {1.0, 1.0, 0.2}));
  const LayoutMargins margins = margins_of(layout, open_floor(0.5));
  check_margin(margins.margin[0], 0.2);
  CHECK(margins.critical_box[0] == 4);
  check_margin(margins.margin[2], 0.5);
}

TEST_CASE("margin_search: walls hold a load in their direction alone", "[margin_search]") {
  Settings settings = open_floor(0.3);
  settings.container.size = {3, 20, 2};
  // A row of three from the front wall; behind it is a gap of 4 mm, or of 8 mm.
  for (const double gap : {0.004, 0.008}) {
    const double length = (3.0 - gap) / 3.0;
    Layout layout;
    for (int i = 0; i < 3; ++i) layout.boxes.push_back(box({i * length, 9, 0}, {length, 1.0, 0.5}));
    const LayoutMargins margins = margins_of(layout, settings);
    CAPTURE(gap);
    CHECK(margins.margin[0] == kLargestMargin);
    CHECK(margins.critical_box[0] == 0);
    if (gap < kMarginDisplacement) {
      CHECK(margins.margin[1] == kLargestMargin);
    } else {
      check_margin(margins.margin[1], 0.3);
    }
    check_margin(margins.margin[2], 0.3);
  }
}

TEST_CASE("margin_search: the seed's example", "[margin_search]") {
  Settings settings;
  const LayoutMargins margins =
      margins_of(layout_of({box({0, 0, 0}, {0.80, 0.59, 1.06}), box({0.80, 0, 0}, {0.80, 0.59, 1.06}),
                            box({0.80, 0, 1.06}, {0.80, 0.59, 1.06})}),
                 settings);
  check_margin(margins.margin[1], 80.0 / 212.0);
  check_margin(margins.margin[3], 59.0 / 212.0);
  CHECK(margins.margin[2] == kLargestMargin);
}

TEST_CASE("margin_search: a direction that is searched alone has the margins of all", "[margin_search]") {
  const Settings settings = open_floor(0.5);
  const Layout layout = layout_of({box({9, 9, 0}, {0.8, 0.3, 1.0}), box({12, 9, 0}, {0.2, 1.0, 1.0})});
  const LayoutMargins all = margins_of(layout, settings);
  std::uint32_t trials = 0;
  for (std::size_t direction = 0; direction < kDirectionCount; ++direction) {
    const std::atomic<bool> abort = false;
    const auto one = find_margin(direction, NativeEngine(settings), layout, settings, abort);
    REQUIRE(one.has_value());
    CHECK(one->margin.at(direction) == all.margin.at(direction));
    CHECK(one->margin_within_limits.at(direction) == all.margin_within_limits.at(direction));
    CHECK(one->critical_box.at(direction) == all.critical_box.at(direction));
    CHECK(std::isnan(one->margin.at((direction + 1) % kDirectionCount)));
    trials += one->trials;
  }
  CHECK(trials == all.trials);
}

TEST_CASE("margin_search: what is unstable has a negative margin", "[margin_search]") {
  Settings settings = open_floor(0.5);
  settings.screening.settle_seconds = 2.0;
  const LayoutMargins falling = margins_of(layout_of({box({9, 9, 0.5}, {1, 1, 1})}), settings);
  for (const double margin : falling.margin) CHECK(margin == Approx(-1.0).margin(0.05));
  CHECK(falling.critical_box == std::array<std::uint32_t, 4>{1, 1, 1, 1});
  CHECK(falling.margin_within_limits == falling.margin);
  // Nearly half of it is supported: it tips slowly.
  const Layout tipping = layout_of({box({9, 9, 0}, {0.49, 1, 1}), box({9, 9, 1}, {1, 1, 0.4})});
  const LayoutMargins margins = margins_of(tipping, settings);
  CHECK(margins.margin[0] < 0.0);
  CHECK(margins.margin[0] > -0.5);
  CHECK(margins.critical_box[0] == 2);
}

TEST_CASE("margin_search: a load that falls into place first has the margins of its place", "[margin_search]") {
  Settings settings = open_floor(0.5);
  settings.screening.settle_seconds = 2.0;
  const LayoutMargins margins = margins_of(layout_of({box({9, 9, 0.007}, {1, 1, 0.5})}), settings);
  for (std::size_t i = 0; i < 4; ++i) {
    check_margin(margins.margin[i], 0.5);
    check_margin(margins.margin_within_limits[i], 0.5);
  }
}

TEST_CASE("margin_search: a load that closes a gap stays within the limits", "[margin_search]") {
  // 5 cm in front of the wall: above 0.5 g it slides there and stands.
  Settings settings;
  settings.contact.friction_model = FrictionModel::pairs;
  const LayoutMargins margins = margins_of(layout_of({box({0.05, 1, 0}, {1, 1, 0.3})}), settings);
  check_margin(margins.margin[0], 0.5);
  CHECK(margins.margin_within_limits[0] == kLargestMargin);
  CHECK(margins.critical_box[0] == 1);
  CHECK(margins.critical_box_within_limits[0] == 0);
  check_margin(margins.margin_within_limits[1], 0.5);
}

TEST_CASE("margin_search: nothing comes of a search that is aborted", "[margin_search]") {
  const Settings settings = open_floor(0.5);
  const std::atomic<bool> abort = true;
  CHECK_FALSE(find_margins(NativeEngine(settings), stack(2, {9, 9, 0}, {1, 1, 1}), settings, abort).has_value());
}

TEST_CASE("margin_search: a world that is rewound goes on as if it had not gone on before", "[margin_search]") {
  const Settings settings = open_floor(0.5);
  const NativeEngine engine(settings);
  REQUIRE(engine.traits().rewinds);
  Layout layout = stack(4, {9, 9, 0}, {0.4, 1.0, 0.5});
  layout.boxes.push_back(box({8.5, 9, 0}, {0.49, 1.0, 0.7}));
  const Acceleration acceleration = constant(8.0, 1.0);
  const Acceleration* const accelerations[] = {&acceleration};
  WorldBatch batch = batch_of(std::span(&layout, 1), accelerations, settings);
  const auto simulation = engine.build(batch);
  const auto run = [&](double end, const Vec3& value) {
    const Phase phase{0.0, end, value};
    for (double time = 0.0; time < end;) time = advance(*simulation, 0, phase);
    simulation->read_back(0, batch.state);
    return batch.state;
  };
  // Marked while boxes fall against each other.
  run(0.3, Vec3(4.0, 0, 0));
  simulation->mark(0);
  const StateColumns first = run(0.7, Vec3(-6.0, 3.0, 0));
  simulation->rewind(0);
  run(0.5, Vec3(0, -8.0, 0));
  simulation->rewind(0);
  CHECK(same_bits(run(0.7, Vec3(-6.0, 3.0, 0)), first));
}

}  // namespace margin_search_test
