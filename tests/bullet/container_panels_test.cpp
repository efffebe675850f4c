// The sides of a prescribed container hold boxes; open sides do not.

#include "scenes.hpp"

namespace container_panels_test {

using namespace holdfast::internal;
using namespace holdfast::internal::scenes;

namespace {

std::string any_engine() { return GENERATE(as<std::string>{}, "bullet", "bullet-f64", "bullet-stock"); }

Settings frictionless_container(std::vector<std::string> open_sides) {
  Settings settings = at_once();
  settings.container.open_sides = std::move(open_sides);
  settings.box_friction = 0.0;
  return settings;
}

/// A box in the middle of the default container.
Layout box_inside() { return layout_of({box({2.5, 0.9, 0}, {0.6, 0.5, 0.4})}); }

struct Side {
  const char* name;
  Vec3 push;     ///< acceleration of the container that moves boxes to that side, m/s²
  Vec3 reached;  ///< displacement of the box at that side, m
};

const Side kSides[] = {{"front", {5, 0, 0}, {-2.5, 0, 0}},
                       {"rear", {-5, 0, 0}, {2.77, 0, 0}},
                       {"left", {0, 5, 0}, {0, -0.9, 0}},
                       {"right", {0, -5, 0}, {0, 0.93, 0}},
                       {"roof", {0, 0, -15}, {0, 0, 1.8}}};

}  // namespace

TEST_CASE("container_panels: every side holds the boxes", "[bullet][container_panels]") {
  const std::string engine = any_engine();
  for (const Side& side : kSides) {
    CAPTURE(engine, side.name);
    const Run one = run(engine, box_inside(), acceleration_of({{3, side.push}}), frictionless_container({}));
    CHECK((one.displacement() - side.reached).norm() < 0.02);
  }
}

TEST_CASE("container_panels: boxes leave through an open side, and through no other", "[bullet][container_panels]") {
  const std::string engine = any_engine();
  for (const Side& side : kSides) {
    CAPTURE(engine, side.name);
    const Run out = run(engine, box_inside(), acceleration_of({{3, side.push}}), frictionless_container({side.name}));
    CHECK(out.displacement().dot(side.reached.normalized()) > side.reached.norm() + 2);
    for (const Side& other : kSides) {
      if (other.name == side.name) continue;
      const Run in = run(engine, box_inside(), acceleration_of({{3, other.push}}), frictionless_container({side.name}));
      CHECK((in.displacement() - other.reached).norm() < 0.02);
    }
  }
}

TEST_CASE("container_panels: the floor ends where a side is open", "[bullet][container_panels]") {
  const std::string engine = any_engine();
  CAPTURE(engine);
  Settings settings = at_once();
  settings.container.open_sides = {"rear"};
  const Vec3 size(0.5, 0.5, 0.2);
  // The centre of mass is 5 cm in front of the sill, and 5 cm beyond it.
  const Run stays = run(engine, layout_of({box({5.57, 1, 0}, size)}), constant(0, 2), settings);
  CHECK(stays.displacement().norm() < 1e-3);
  const Run falls = run(engine, layout_of({box({5.67, 1, 0}, size)}), constant(0, 2), settings);
  CHECK(falls.displacement().z() < -1.0);
}

TEST_CASE("container_panels: the walls end where the roof is open", "[bullet][container_panels]") {
  const std::string engine = any_engine();
  CAPTURE(engine);
  Settings settings = frictionless_container({"roof"});
  const double wall = settings.container.size.z();
  // A box on a block as high as the walls touches no wall.
  const Layout layout = layout_of({box({0, 0, 0}, {5.87, 2.33, wall}), box({1, 1, wall}, {0.5, 0.5, 0.2})});
  const Run one = run(engine, layout, constant(5, 1), settings);
  CHECK(one.displacement(0).norm() < 0.01);
  CHECK(one.displacement(1).x() < -2.0);
}

TEST_CASE("container_panels: nothing passes through a wall at high speed", "[bullet][container_panels]") {
  const std::string engine = any_engine();
  CAPTURE(engine);
  Settings settings = frictionless_container({});
  settings.steps_per_second = 60;
  const Layout layout = layout_of({box({5.0, 1, 0}, {0.02, 0.5, 0.3})});
  const Run one = run(engine, layout, constant(30, 1), settings);
  const double fastest = std::sqrt(2 * 30 * 5.0);
  CAPTURE(fastest, one.displacement().x());
  CHECK(one.displacement().x() > -5.1);
}

}  // namespace container_panels_test
