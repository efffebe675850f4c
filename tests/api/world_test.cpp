#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "holdfast/holdfast.hpp"

namespace api_world_test {

namespace {

const holdfast::Acceleration kBrake{"brake", {{0.25, 1.0, {7.0, 0.0, 0.0}}}};

holdfast::Layout one_box() { return {"one", {{{2.0, 1.0, 0.0}, {2.5, 1.5, 0.5}, 1}}}; }

}  // namespace

TEST_CASE("world: taken forward in any pieces it ends as the same world of a screen", "[api][world]") {
  const std::vector<holdfast::Setting> settings = {{"Native", "Accuracy", "screening"},
                                                   {"Screening", "SettleSeconds", "0.1"}};
  holdfast::Screen screen({kBrake}, {.config = "[Native]\nAccuracy = screening\n[Screening]\nSettleSeconds = 0.1\n"});
  const std::vector<holdfast::Layout> layouts = {
      screen.read_layout(HOLDFAST_SOURCE_DIR "/configs/layouts/seed_example.txt")};
  const std::uint64_t expected = screen.evaluate(layouts)[0].state_hash;
  for (const double piece : {10.0, 0.37, 0.001}) {
    holdfast::World world(layouts[0], kBrake, settings);
    CHECK(world.time() == 0.0);
    for (double time = 0.0; world.time() < world.end_time(); time += piece) world.advance(time);
    CHECK(world.state_hash() == expected);
  }
}

TEST_CASE("world: poses are those of the time that was asked for", "[api][world]") {
  holdfast::World world(one_box(), kBrake);
  REQUIRE(world.poses().size() == 1);
  CHECK(world.poses()[0].position == std::array{2.25, 1.25, 0.25});
  world.advance(0.2);
  CHECK(world.poses()[0].position[0] == 2.25);
  // From 0.25 s on it slides against friction of 0.5: ½ (7 − 0.5 · 9.81) t², to the front.
  for (const double time : {0.5, 0.7301, 1.1}) {
    world.advance(time);
    CHECK(world.time() == time);
    const double sliding = time - 0.25;
    CHECK(world.poses()[0].position[0] == Approx(2.25 - 0.5 * (7.0 - 0.5 * 9.81) * sliding * sliding).margin(1e-4));
  }
  world.advance(0.3);
  CHECK(world.time() == 1.1);
  world.advance(100.0);
  CHECK(world.time() == world.end_time());
  CHECK(world.end_time() == 6.25);  // it may run out for 5 s
}

TEST_CASE("world: what cannot be used is an error", "[api][world]") {
  using holdfast::World;
  const auto with = [](const holdfast::Setting& setting) { World world(one_box(), kBrake, {&setting, 1}); };
  CHECK_THROWS_WITH(with({"Native", "Accuracies", "standard"}), Catch::Contains("unknown key: [Native] Accuracies"));
  CHECK_THROWS_WITH(with({"Native", "Accuracy", "perfect"}), Catch::Contains("not a value of [Native] Accuracy"));
  CHECK_THROWS_WITH(with({"Screening", "Engine", "bullet"}), Catch::Contains("plug-in"));
  CHECK_THROWS_WITH(World({"out", {{{2.0, 1.0, 0.0}, {7.0, 1.5, 0.5}, 1}}}, kBrake), Catch::Contains("outside"));
  CHECK_THROWS_WITH(World(one_box(), {"none", {}}), Catch::Contains("no segments"));
}

TEST_CASE("world: the forces on the sides hold a box that is braked", "[api][world]") {
  // 0.5 m along x, 0.5 m across, 0.4 m high: 25 kg at 250 kg/m3. Friction of 0.5 holds it.
  const holdfast::Layout layout{"", {{{2.0, 1.0, 0.0}, {2.5, 1.5, 0.4}, 1}}};
  const holdfast::Acceleration brake{"", {{0.0, 1.0, {2.0, 0.0, 0.0}}}};
  const std::vector<holdfast::Setting> asked = {{"Screening", "WallForces", "true"}};
  holdfast::World world(layout, brake, asked);
  const auto stands = [&] {
    return std::array{world.side_forces()[0][0], world.side_forces()[0][1]} == std::array{0.0, 0.0} &&
           world.side_forces()[0][2] == Approx(-25.0 * 9.81);
  };
  CHECK(stands());
  world.advance(0.5);
  const std::vector<std::array<double, 3>> forces = world.side_forces();
  REQUIRE(forces.size() == 8);
  CHECK(forces[0][0] == Approx(-25.0 * 2.0));  // the box drags the floor along
  CHECK(forces[0][2] == Approx(-25.0 * 9.81));
  for (std::size_t side = 1; side < forces.size(); ++side) CHECK(forces[side] == std::array<double, 3>{});
  world.advance(100.0);
  CHECK(stands());
  holdfast::World silent(layout, brake);
  silent.advance(0.5);
  CHECK(silent.side_forces().empty());
  silent.advance(100.0);
  CHECK(silent.state_hash() == world.state_hash());
}

}  // namespace api_world_test
