#include <catch2/catch.hpp>
#include <vector>

#include "holdfast/holdfast.hpp"

namespace norm_test {

namespace {

using holdfast::Acceleration;
using holdfast::Screen;

std::vector<std::string> names_of(const Screen& screen) {
  std::vector<std::string> names;
  for (const Acceleration& acceleration : screen.accelerations()) names.push_back(acceleration.name);
  return names;
}

const Acceleration kShove{"shove", {{0.0, 0.5, {6.0, 0.0, 0.0}}}};

}  // namespace

TEST_CASE("norm: worlds under the norm of the road are those under its files, bit by bit", "[api][norm]") {
  std::vector<Acceleration> files;
  for (const char* name : {"road_brake_0g8", "road_rearward_0g5", "road_corner_right_0g5", "road_corner_left_0g5"})
    files.push_back(
        holdfast::read_acceleration(std::string(HOLDFAST_SOURCE_DIR "/configs/accelerations/") + name + ".txt"));
  Screen by_files(files, {.accuracy = "screening", .unit = holdfast::LengthUnit::centimetre});
  Screen by_norm({.norm = "road", .accuracy = "screening", .unit = holdfast::LengthUnit::centimetre});
  std::vector<holdfast::Layout> layouts;
  for (const char* name : {"seed_example", "BR0_012_block"})
    layouts.push_back(by_norm.read_layout(std::string(HOLDFAST_SOURCE_DIR "/configs/layouts/") + name + ".txt"));
  const auto expected = by_files.evaluate(layouts);
  const auto worlds = by_norm.evaluate(layouts);
  REQUIRE(worlds.size() == 8);
  for (std::size_t i = 0; i < worlds.size(); ++i) {
    CHECK(worlds[i].state_hash == expected[i].state_hash);
    CHECK(worlds[i].verdict == expected[i].verdict);
  }
}

TEST_CASE("norm: its accelerations come before those that are given, by option or by key", "[api][norm]") {
  const std::vector<std::string> expected = {"road-front-0g8", "road-rear-0g5", "road-left-0g5", "road-right-0g5",
                                             "shove"};
  CHECK(names_of(Screen({kShove}, {.norm = "road"})) == expected);
  CHECK(names_of(Screen({kShove}, {.config = "[Screening]\nNorm = road\n"})) == expected);
  CHECK(names_of(Screen({kShove}, {.settings = {{"Screening", "Norm", "road"}}})) == expected);
  CHECK(names_of(Screen({kShove}, {.config = "[Screening]\nNorm = road\n", .norm = ""})) ==
        std::vector<std::string>{"shove"});
  CHECK(holdfast::norm_accelerations("sea-a").size() == 4);
}

TEST_CASE("norm: an unknown one is an error that says which there are", "[api][norm]") {
  CHECK_THROWS_WITH(Screen({.norm = "raod"}), Catch::Contains("did you mean road?") && Catch::Contains("sea-c"));
  CHECK_THROWS_WITH(holdfast::norm_accelerations("raod"), Catch::Contains("did you mean road?"));
  CHECK_THROWS_WITH(Screen({.config = "[Screening]\nNorm = raod\n"}),
                    Catch::Contains("config:2:8: Norm has a wrong value") && Catch::Contains("sea-c"));
  CHECK_THROWS_WITH(Screen(holdfast::ScreenOptions{}).evaluate(std::vector<holdfast::Layout>{}),
                    Catch::Contains("or a norm"));
}

TEST_CASE("norm: with less weight a box slides at less acceleration, as c_z says", "[api][norm]") {
  // Friction of 0.5 holds 0.5 g at full weight and 0.25 g at half of it: 0.3 g along slides in sea area A.
  Screen screen({.norm = "sea-a"});
  const std::vector<holdfast::Layout> one_box = {{"one", {{{2.0, 1.0, 0.0}, {2.5, 1.5, 0.5}, 1}}}};
  const auto worlds = screen.evaluate(one_box);
  // (0.3 - 0.5 * 0.5) g for 1 s, and then 0.5 g until it stands.
  const double g = 9.81, push = 0.05 * g;
  CHECK(worlds[0].end_displacement == Approx(0.5 * push + push * push / (2 * 0.5 * g)).epsilon(1e-3));
}

}  // namespace norm_test
