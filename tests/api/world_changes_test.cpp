// What acts on a world changes while it goes: acceleration, friction, forces.

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "holdfast/holdfast.hpp"

namespace world_changes_test {

namespace {

using holdfast::World;

constexpr double kGravity = 9.81;
constexpr double kFriction = 0.5;  // of every pair, by default
constexpr double kMass = 31.25;    // of the box below, kg

const holdfast::Acceleration kStill{"still", {{0.0, 4.0, {0.0, 0.0, 0.0}}}};

holdfast::Layout one_box() { return {"one", {{{2.0, 1.0, 0.0}, {2.5, 1.5, 0.5}, 1}}}; }

/// Six boxes on each other and beside each other, which slide and lean when they are pushed.
holdfast::Layout heap() {
  holdfast::Layout layout{"heap", {}};
  for (int i = 0; i < 6; ++i) {
    const double x = 1.0 + 0.61 * (i % 3);
    const double z = i < 3 ? 0.0 : 0.9;
    layout.boxes.push_back({{x, 1.0, z}, {x + 0.6, 1.5, z + 0.9}, 1});
  }
  return layout;
}

double x_of(const World& world, std::size_t box = 0) { return world.poses()[box].position[0]; }

}  // namespace

TEST_CASE("world changes: a box that is pushed slides by what friction leaves", "[api][world]") {
  World world(one_box(), kStill);
  world.advance(0.5);
  CHECK(x_of(world) == 2.25);
  const double force = 1.5 * kFriction * kMass * kGravity;
  // At the height of the floor: the box does not tip.
  world.set_force(0, {force, 0.0, 0.0}, std::array{2.25, 1.25, 0.0});
  const double acceleration = (force - kFriction * kMass * kGravity) / kMass;
  for (const double after : {0.25, 0.5}) {
    world.advance(0.5 + after);
    CHECK(x_of(world) == Approx(2.25 + 0.5 * acceleration * after * after).margin(1e-5));
    CHECK(world.velocities()[0].linear[0] == Approx(acceleration * after).margin(1e-4));
  }
  // Without the force friction stops it.
  const double speed = world.velocities()[0].linear[0];
  const double place = x_of(world);
  world.set_force(0, {0.0, 0.0, 0.0});
  world.advance(4.0);
  CHECK(x_of(world) - place == Approx(0.5 * speed * speed / (kFriction * kGravity)).margin(2e-3));
  CHECK(world.velocities()[0].linear == std::array{0.0, 0.0, 0.0});
}

TEST_CASE("world changes: a box that friction holds against a push stays to the bit", "[api][world]") {
  World world(one_box(), kStill);
  world.set_force(0, {0.9 * kFriction * kMass * kGravity, 0.0, 0.0});
  world.advance(4.0);
  CHECK(world.poses()[0].position == std::array{2.25, 1.25, 0.25});
}

TEST_CASE("world changes: a force turns a box about its centre of mass", "[api][world]") {
  // Without gravity, for a moment short beside the turn: torque over the moment of inertia, m (a² + a²) / 12.
  const std::vector<holdfast::Setting> settings = {{"Screening", "Gravity", "0"}};
  World world({"free", {{{2.0, 1.0, 1.0}, {2.5, 1.5, 1.5}, 1}}}, kStill, settings);
  world.set_force(0, {0.0, 0.0, 10.0}, std::array{2.5, 1.25, 1.25});
  world.advance(0.1);
  const holdfast::Velocity velocity = world.velocities()[0];
  CHECK(velocity.linear[2] == Approx(10.0 / kMass * 0.1).epsilon(1e-6));
  CHECK(velocity.angular[1] == Approx(-10.0 * 0.25 / (kMass * 0.5 / 12.0) * 0.1).epsilon(1e-3));
  CHECK(velocity.angular[0] == 0.0);
}

TEST_CASE("world changes: acceleration set on the way is that of a file with several segments", "[api][world][slow]") {
  using Accelerations = std::vector<std::array<double, 3>>;
  // The second ones change little by little, and then by much.
  for (const Accelerations& accelerations : {Accelerations{{6.0, 0.0, 0.0}, {0.0, -6.0, 0.0}},
                                             Accelerations{{1.0, 0.0, 0.0}, {1.2, 0.0, 0.0}, {6.0, 0.0, 0.0}}}) {
    for (const char* engine : {"native", "native-plain"}) {
      const std::vector<holdfast::Setting> settings = {{"Screening", "Engine", engine},
                                                       {"Physics Engine", "SimulationStepsPerSecond", "64"}};
      const double end = 0.5 * static_cast<double>(accelerations.size());
      holdfast::Acceleration segments{"", {}};
      for (std::size_t i = 0; i < accelerations.size(); ++i)
        segments.segments.push_back({0.5 * static_cast<double>(i), 0.5, accelerations[i]});
      World file(heap(), segments, settings);
      World live(heap(), {"", {{0.0, end, accelerations.front()}}}, settings);
      file.advance(end);
      for (std::size_t i = 1; i < accelerations.size(); ++i) {
        live.advance(0.5 * static_cast<double>(i));
        live.set_acceleration(accelerations[i]);
      }
      live.advance(end);
      CAPTURE(engine, end);
      CHECK(live.end_time() == file.end_time());
      CHECK(live.state_hash() == file.state_hash());
    }
  }
}

TEST_CASE("world changes: a world at rest, which is at its end at once, wakes where it is told", "[api][world]") {
  World world(one_box(), kStill);
  for (const double time : {0.1, 0.2, 0.3}) world.advance(time);
  world.set_acceleration({7.0, 0.0, 0.0});
  world.advance(0.8);
  CHECK(x_of(world) == Approx(2.25 - 0.5 * (7.0 - kFriction * kGravity) * 0.25).margin(1e-4));
  // And later than any step: the acceleration of the file is over, that which was set is not.
  World late(one_box(), {"short", {{0.0, 4.0, {1.0, 0.0, 0.0}}}});
  late.advance(3.5);
  late.set_acceleration({0.0, 7.0, 0.0});
  late.advance(4.0);
  CHECK(late.poses()[0].position[1] == Approx(1.25 - 0.5 * (7.0 - kFriction * kGravity) * 0.25).margin(1e-4));
  // And where it has ended at rest, with time left to run out.
  World rested(one_box(), {"short", {{0.0, 1.0, {1.0, 0.0, 0.0}}}});
  rested.advance(3.0);
  rested.set_acceleration({0.0, 7.0, 0.0});
  rested.advance(3.5);
  CHECK(rested.poses()[0].position[1] == Approx(1.25 - 0.5 * (7.0 - kFriction * kGravity) * 0.25).margin(1e-4));
}

TEST_CASE("world changes: friction set at the start is that of the settings", "[api][world]") {
  const holdfast::Acceleration brake{"", {{0.0, 1.0, {5.0, 1.0, 0.0}}}};
  const std::vector<holdfast::Setting> pairs = {{"Contact", "FrictionModel", "pairs"},
                                                {"Contact", "BoxBox", "0.3"},
                                                {"Contact", "BoxFloor", "0.2"},
                                                {"Contact", "BoxWall", "0.1"},
                                                {"Screening", "SettleSeconds", "0"}};
  const std::vector<holdfast::Setting> unsettled = {pairs.back()};
  World by_settings(heap(), brake, pairs);
  World live(heap(), brake, unsettled);
  live.set_friction(0.3, 0.2, 0.1);
  World other(heap(), brake, unsettled);
  const std::vector<holdfast::Setting> rows = {
      {"Friction", "1, floor", "0.9"}, {"Friction", "1, any", "0.8"}, pairs.back()};
  World with_rows(heap(), brake, rows);
  with_rows.set_friction(0.3, 0.2, 0.1);
  for (World* world : {&by_settings, &live, &other, &with_rows}) world->advance(1.0);
  CHECK(live.state_hash() == by_settings.state_hash());
  CHECK(with_rows.state_hash() == by_settings.state_hash());
  CHECK(live.state_hash() != other.state_hash());
}

TEST_CASE("world changes: less friction lets a box go that was held", "[api][world]") {
  World world(one_box(), {"hold", {{0.0, 2.0, {4.0, 0.0, 0.0}}}});
  world.advance(1.0);
  CHECK(x_of(world) == 2.25);
  world.set_friction(0.5, 0.2, 0.5);
  world.advance(1.5);
  CHECK(x_of(world) == Approx(2.25 - 0.5 * (4.0 - 0.2 * kGravity) * 0.25).margin(1e-4));
}

TEST_CASE("world changes: a push far stronger than gravity makes no box pass another", "[api][world]") {
  // Two boxes that are 0.3 m apart; the first is thrown at the second by 50 g.
  World world({"two", {{{1.0, 1.0, 0.0}, {1.5, 1.5, 0.5}, 1}, {{1.8, 1.0, 0.0}, {2.3, 1.5, 0.5}, 1}}}, kStill);
  world.advance(0.1);
  world.set_force(0, {50.0 * kMass * kGravity, 0.0, 0.0});
  for (double time = 0.1; time < 0.4; time += 0.01) {
    world.advance(time);
    CHECK(x_of(world, 1) - x_of(world, 0) > 0.5 - 2e-3);
  }
  CHECK(x_of(world, 1) > 2.05 + 0.1);
}

TEST_CASE("world changes: changes that change nothing, and changes in pieces, give the same bits", "[api][world]") {
  const auto run = [](double piece) {
    World world(heap(), {"", {{0.0, 1.0, {6.0, 0.0, 0.0}}}});
    for (double time = 0.0; time < 0.5; time += piece) world.advance(time);
    world.advance(0.5);
    world.set_force(4, {200.0, 50.0, 0.0});
    for (double time = 0.5; time < 1.0; time += piece) world.advance(time);
    world.advance(1.0);
    return world.state_hash();
  };
  const std::uint64_t once = run(10.0);
  CHECK(run(0.0625) == once);
  CHECK(run(0.01) == once);
}

TEST_CASE("world changes: what cannot be used is an error, and changes nothing", "[api][world]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  World world(one_box(), kStill);
  world.advance(0.5);
  CHECK_THROWS_WITH(world.set_acceleration({nan, 0.0, 0.0}), Catch::Contains("the acceleration cannot be used: nan"));
  CHECK_THROWS_WITH(world.set_acceleration({2e4, 0.0, 0.0}), Catch::Contains("to 10000 m/s²"));
  CHECK_THROWS_WITH(world.set_friction(0.5, -0.1, 0.5), Catch::Contains("not a coefficient of friction: -0.1"));
  CHECK_THROWS_WITH(world.set_friction(nan, 0.1, 0.5), Catch::Contains("numbers from 0 to 10"));
  CHECK_THROWS_WITH(world.set_force(1, {1.0, 0.0, 0.0}), Catch::Contains("no such box: 1; a number below 1"));
  CHECK_THROWS_WITH(world.set_force(0, {1e10, 0.0, 0.0}), Catch::Contains("the force cannot be used"));
  CHECK_THROWS_WITH(world.set_force(0, {1.0, 0.0, 0.0}, std::array{nan, 0.0, 0.0}), Catch::Contains("the point"));
  world.advance(4.0);
  CHECK(world.poses()[0].position == std::array{2.25, 1.25, 0.25});

  const std::vector<holdfast::Setting> plain = {{"Screening", "Engine", "native-plain"}};
  World other(one_box(), kStill, plain);
  CHECK_THROWS_WITH(other.set_friction(0.5, 0.5, 0.5), Catch::Contains("cannot change forces and friction"));
  CHECK_THROWS_WITH(other.set_force(0, {1.0, 0.0, 0.0}), Catch::Contains("native-plain"));
}

}  // namespace world_changes_test
