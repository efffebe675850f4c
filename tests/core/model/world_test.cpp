#include "core/model/world.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <limits>

#include "scenes.hpp"

namespace world_test {

using namespace holdfast::internal;
using namespace holdfast::internal::scenes;

namespace {

WorldBatch batch_of(const std::vector<Layout>& layouts, const Settings& settings) {
  static const Acceleration kRest;
  const Acceleration* const accelerations[] = {&kRest};
  return scenes::batch_of(layouts, accelerations, settings);
}

}  // namespace

TEST_CASE("world: one world per pair, acceleration fastest, each with a range of the columns", "[core][world]") {
  const std::vector<Layout> layouts = {stack(2, {0, 0, 0}, {1, 1, 1}), stack(3, {0, 0, 0}, {1, 1, 1})};
  const Acceleration one, two;
  const Acceleration* const accelerations[] = {&one, &two};
  const WorldBatch batch = scenes::batch_of(layouts, accelerations, Settings{});
  REQUIRE(batch.worlds.size() == 4);
  std::size_t row = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const World& world = batch.worlds[i];
    CHECK(world.layout == &layouts[i / 2]);
    CHECK(world.acceleration == accelerations[i % 2]);
    CHECK(world.box_begin == row);
    CHECK(world.box_count == world.layout->boxes.size());
    row += world.box_count;
  }
  for_each_state_column(
      [&](const char* name, const auto& column) {
        INFO(name);
        CHECK(column.size() == row);
      },
      batch.state);
  for_each_box_column(
      [&](const char* name, const auto& column) {
        INFO(name);
        CHECK(column.size() == row);
      },
      batch.boxes);
}

TEST_CASE("world: boxes are at rest in the layout's pose", "[core][world]") {
  const WorldBatch batch = batch_of({layout_of({box({1, 2, 0}, {0.5, 1.0, 2.0}, 7)})}, Settings{});
  CHECK(batch.state.position[0] == Vec3(1.25, 2.5, 1.0));
  CHECK(batch.state.orientation[0].coeffs() == Rotation::Identity().coeffs());
  CHECK(batch.state.velocity[0] == Vec3(0, 0, 0));
  CHECK(batch.state.angular_velocity[0] == Vec3(0, 0, 0));
  CHECK(batch.boxes.half_extents[0] == Vec3(0.25, 0.5, 1.0));
  CHECK(batch.boxes.material[0] == 7);
}

TEST_CASE("world: mass and inertia of a uniform box", "[core][world]") {
  const WorldBatch batch = batch_of({layout_of({box({0, 0, 0}, {1, 2, 3})})}, Settings{});
  CHECK(batch.boxes.mass[0] == Approx(1500.0));
  CHECK(batch.boxes.inertia[0].x() == Approx(1500.0 / 12 * (4 + 9)));
  CHECK(batch.boxes.inertia[0].y() == Approx(1500.0 / 12 * (9 + 1)));
  CHECK(batch.boxes.inertia[0].z() == Approx(1500.0 / 12 * (1 + 4)));
}

TEST_CASE("world: with ConstantDensity off the density value is the mass of every box", "[core][world]") {
  Settings settings;
  settings.constant_density = false;
  settings.density_value = 12.0;
  CHECK(batch_of({layout_of({box({0, 0, 0}, {1, 2, 3})})}, settings).boxes.mass[0] == 12.0);
}

TEST_CASE("world: boxes have the properties of their material", "[core][world]") {
  Settings settings;
  settings.box_friction = 0.6;
  settings.contact.restitution = 0.1;
  settings.materials[2] = {.density = 500.0, .friction = 0.3, .centre_of_mass = {0.1, 0, -0.2}};
  settings.materials[3] = {.mass = 9.0, .restitution = 0.4};
  const Vec3 size(1, 1, 1);
  const WorldBatch batch =
      batch_of({layout_of({box({0, 0, 0}, size, 1), box({1, 0, 0}, size, 2), box({2, 0, 0}, size, 3)})}, settings);
  CHECK(batch.boxes.mass == std::vector<double>{250.0, 500.0, 9.0});
  const std::vector<Surface>& surface = batch.boxes.surface;
  CHECK(std::vector{surface[0].friction, surface[1].friction, surface[2].friction} == std::vector{0.6, 0.3, 0.6});
  CHECK(std::vector{surface[0].restitution, surface[1].restitution, surface[2].restitution} ==
        std::vector{0.1, 0.1, 0.4});
  CHECK(batch.boxes.centre_of_mass[1] == Vec3(0.1, 0, -0.2));
  // The state is that of the centre of mass, not of the centroid.
  CHECK(batch.state.position[0] == Vec3(0.5, 0.5, 0.5));
  CHECK((batch.state.position[1] - Vec3(1.6, 0.5, 0.3)).norm() < 1e-15);
}

TEST_CASE("world: a view is the range of the world", "[core][world]") {
  const WorldBatch batch = batch_of({stack(2, {0, 0, 0}, {1, 1, 1}), stack(1, {5, 0, 0}, {2, 2, 2})}, Settings{});
  const StateView state = view(batch.state, batch.worlds[1]);
  REQUIRE(state.position.size() == 1);
  CHECK(state.position.data() == &batch.state.position[2]);
  CHECK(state.angular_velocity.size() == 1);
  const BoxView boxes = view(batch.boxes, batch.worlds[1]);
  REQUIRE(boxes.mass.size() == 1);
  CHECK(boxes.mass[0] == 2000.0);
  CHECK(boxes.half_extents[0] == Vec3(1, 1, 1));
}

TEST_CASE("world: the hash depends on every bit of every column, and not on other worlds", "[core][world]") {
  WorldBatch batch = batch_of({stack(2, {0, 0, 0}, {1, 1, 1}), stack(2, {0, 0, 0}, {1, 1, 1})}, Settings{});
  const auto hash = [&](std::size_t world) { return state_hash(view(batch.state, batch.worlds[world])); };
  const std::uint64_t whole = hash(0);
  CHECK(hash(1) == whole);
  const auto changes = [&](double& number, double other) {
    const double kept = std::exchange(number, other);
    const bool changed = hash(0) != whole && hash(1) == whole;
    number = kept;
    return changed && hash(0) == whole;
  };
  CHECK(changes(batch.state.position[0].x(), std::nextafter(0.5, 1.0)));
  CHECK(changes(batch.state.position[1].z(), 0.0));
  CHECK(changes(batch.state.orientation[1].w(), std::nextafter(1.0, 0.0)));
  CHECK(changes(batch.state.velocity[0].y(), -0.0));
  CHECK(changes(batch.state.angular_velocity[1].z(), 1e-300));
}

TEST_CASE("world: the hash is the FNV-1a of the state's bytes", "[core][world]") {
  const WorldBatch batch = batch_of({stack(1, {0, 0, 0}, {1, 1, 1})}, Settings{});
  // Position, orientation as x y z w, velocity, angular velocity.
  const double numbers[] = {0.5, 0.5, 0.5, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0};
  unsigned char bytes[sizeof numbers];
  std::memcpy(bytes, numbers, sizeof numbers);
  std::uint64_t expected = 14695981039346656037ULL;
  for (const unsigned char byte : bytes) expected = (expected ^ byte) * 1099511628211ULL;
  CHECK(state_hash(view(batch.state, batch.worlds[0])) == expected);
}

TEST_CASE("world: a single number that is not finite is found in any column", "[core][world]") {
  WorldBatch batch = batch_of({stack(2, {0, 0, 0}, {1, 1, 1})}, Settings{});
  const auto finite = [&] { return is_finite(view(batch.state, batch.worlds[0])); };
  CHECK(finite());
  for (double* number : {&batch.state.position[1].y(), &batch.state.orientation[0].z(), &batch.state.velocity[1].x(),
                         &batch.state.angular_velocity[0].y()}) {
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                             -std::numeric_limits<double>::infinity()}) {
      const double kept = std::exchange(*number, bad);
      CHECK_FALSE(finite());
      *number = kept;
    }
  }
  CHECK(finite());
}

}  // namespace world_test
