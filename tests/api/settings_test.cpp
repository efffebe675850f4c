#include <catch2/catch.hpp>
#include <vector>

#include "holdfast/holdfast.hpp"

namespace settings_test {

namespace {

using holdfast::Screen;
using holdfast::Setting;

const holdfast::Acceleration kBrake{"brake", {{0.0, 0.5, {6.0, 0.0, 0.0}}}};
const std::vector<holdfast::Layout> kOneBox = {{"one", {{{2.0, 1.0, 0.0}, {2.5, 1.5, 0.5}, 3}}}};

bool same(const Setting& a, const Setting& b) { return a.section == b.section && a.key == b.key && a.value == b.value; }

}  // namespace

TEST_CASE("settings: the text of a config.ini gives its keys by their main spelling", "[api][settings]") {
  const std::vector<Setting> settings = holdfast::read_settings(
      "[Material 03]\nDensity = 300\n[Container]\nLength = 600.5\n[Export Settings]\nResultsIntervalInSeconds = "
      "0.20\n");
  REQUIRE(settings.size() == 3);
  CHECK(same(settings[0], {"Export Settings", "ResultsIntervallInSeconds", "0.2"}));
  CHECK(same(settings[1], {"Container", "Length", "600.5"}));
  CHECK(same(settings[2], {"Material 3", "Density", "300"}));
  CHECK(holdfast::read_settings("").empty());
  const std::vector<Setting> pairs = holdfast::read_settings("[Friction]\nwall, any = 0.3\npallet, floor = 0.25\n");
  REQUIRE(pairs.size() == 2);
  CHECK(same(pairs[0], {"Friction", "pallet, floor", "0.25"}));
  CHECK(same(pairs[1], {"Friction", "any, wall", "0.3"}));
  CHECK_THROWS_WITH(holdfast::read_settings("[Container]\nLength = long\n"), Catch::Contains("config:2:10"));
}

TEST_CASE("settings: keys that are set one by one do what the text of a config.ini does", "[api][settings]") {
  const std::string text = "[Native]\nAccuracy = screening\n[Material 3]\nFriction = 0.5\nDensity = 400\n";
  Screen by_text({kBrake}, {.config = text});
  Screen by_keys({kBrake}, {.settings = {{"Native", "Accuracy", "screening"},
                                         {"Material 3", "Friction", "0.5"},
                                         {"Material 3", "Density", "400"}}});
  Screen by_default({kBrake}, {.accuracy = "screening"});
  const std::uint64_t expected = by_text.evaluate(kOneBox)[0].state_hash;
  CHECK(by_keys.evaluate(kOneBox)[0].state_hash == expected);
  CHECK(by_default.evaluate(kOneBox)[0].state_hash != expected);
  holdfast::World world(kOneBox[0], kBrake, holdfast::read_settings(text));
  world.advance(world.end_time());
  CHECK(world.state_hash() == expected);
}

TEST_CASE("settings: keys that contradict each other, or that there are not, are errors", "[api][settings]") {
  const auto with = [](std::vector<Setting> settings) { Screen screen({kBrake}, {.settings = std::move(settings)}); };
  CHECK_THROWS_WITH(with({{"Material 3", "Density", "1"}, {"Material 3", "Mass", "1"}}),
                    Catch::Contains("both a mass and a density: [Material 3] Mass"));
  CHECK_THROWS_WITH(with({{"Material any", "Density", "1"}}), Catch::Contains("unknown key: [Material any] Density"));
  CHECK_THROWS_WITH(with({{"Material -1", "Density", "1"}}), Catch::Contains("unknown key"));
  CHECK_THROWS_WITH(with({{"Native", "", "1"}}), Catch::Contains("unknown key: [Native] "));
  CHECK_THROWS_WITH(with({{"Container", "Length", "-1"}}), Catch::Contains("not a value of [Container] Length: -1"));
}

}  // namespace settings_test
