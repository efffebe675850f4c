// Friction and restitution that Bullet's engines give to pairs of surfaces.

#include <algorithm>

#include "scenes.hpp"

namespace surface_test {

using namespace holdfast::internal;
using namespace holdfast::internal::scenes;

namespace {

constexpr double kStep = 1.0 / 240;  ///< s
constexpr double kTime = 0.5;        ///< of a slide, s

std::string any_engine() { return GENERATE(as<std::string>{}, "bullet", "bullet-f64", "bullet-stock"); }

/// The deceleration by friction, m/s², of box `i` that feels −`acceleration`; from its displacement along x.
double friction_seen(const std::string& engine, const Layout& layout, const Vec3& acceleration,
                     const Settings& settings, std::size_t i = 0) {
  const Run slide = run(engine, layout, acceleration_of({{kTime, acceleration}}), settings);
  return acceleration.x() + slide.displacement(i).x() / (0.5 * kTime * (kTime + kStep));
}

Settings pairs(double box_box, double box_floor, double box_wall) {
  Settings settings = open_floor(0);
  settings.contact.box_box = box_box;
  settings.contact.box_floor = box_floor;
  settings.contact.box_wall = box_wall;
  return settings;
}

/// Height of the rebound of a box, relative to the height from which it is dropped.
double rebound(const std::string& engine, const Settings& given) {
  Settings settings = given;
  settings.bullet.split_impulse_threshold = 0.0;
  settings.results_interval = kStep;
  const Run drop = run(engine, layout_of({box({10, 10, 0.5}, {1, 1, 1})}), constant(0, 0.9), settings);
  const auto lower = [](const Float3& a, const Float3& b) { return a.z < b.z; };
  const auto& path = drop.record.series.displacement;
  const auto impact = std::min_element(path.begin(), path.begin() + 90, lower);
  return (0.5 + static_cast<double>(std::max_element(impact, path.end(), lower)->z)) / 0.5;
}

}  // namespace

TEST_CASE("surface: friction is the product of both sides", "[bullet][surface]") {
  const std::string engine = any_engine();
  Settings settings = at_once();
  settings.container.size = {20, 20, 10};
  settings.container.friction = 0.5;
  settings.box_friction = 0.8;
  settings.materials[2].friction = 0.3;
  const Vec3 size(1.1, 1.1, 0.25);
  CAPTURE(engine);
  CHECK(friction_seen(engine, layout_of({box({10, 10, 0}, size)}), {6, 0, 0}, settings) ==
        Approx(0.40 * kGravity).epsilon(1e-3));
  CHECK(friction_seen(engine, layout_of({box({10, 10, 0}, size, 2)}), {6, 0, 0}, settings) ==
        Approx(0.15 * kGravity).epsilon(1e-3));

  // The same for two boxes: the lower one does not slide on the floor.
  settings.container.friction = 5.0;
  const Layout two = layout_of({box({8, 8, 0}, {4, 4, 0.2}), box({10, 10, 0.2}, size, 2)});
  // Measured: 1.7 % too low with bullet-stock.
  CHECK(friction_seen(engine, two, {6, 0, 0}, settings, 1) == Approx(0.24 * kGravity).epsilon(0.025));
}

TEST_CASE("surface: friction by the kind of pair", "[bullet][surface]") {
  const std::string engine = any_engine();
  const Vec3 size(1.1, 1.1, 0.25);
  CAPTURE(engine);
  SECTION("box and floor") {
    CHECK(friction_seen(engine, layout_of({box({10, 10, 0}, size)}), {6, 0, 0}, pairs(0.9, 0.3, 0.7)) ==
          Approx(0.3 * kGravity).epsilon(1e-3));
  }
  SECTION("box and box") {
    const Layout two = layout_of({box({8, 8, 0}, {4, 4, 0.2}), box({10, 10, 0.2}, size)});
    CHECK(friction_seen(engine, two, {6, 0, 0}, pairs(0.3, 2.0, 0.7), 1) == Approx(0.3 * kGravity).epsilon(0.025));
  }
  SECTION("box and side wall") {
    // Bullet aligns its friction directions with the velocity including that added by gravity in the step, g h
    // downwards. At a wall they are oblique until v is much larger, and the limits of both add up: instead of 2 m/s²,
    // measured 2.75 in the first step and 2.04 after half a second with two directions; 1.04 and 2.00 with one
    // (bullet-stock).
    const Layout at_wall = layout_of({box({10, 0, 0}, {2, 0.5, 0.25})});
    const Run slide = run(engine, at_wall, acceleration_of({{kTime, Vec3(6, 5, 0)}}), pairs(0.9, 0.0, 0.4));
    const double seen = 6 + static_cast<double>(slide.record.series.linear_acceleration.back().x);
    CHECK(seen == Approx(0.4 * 5).epsilon(0.04));
  }
  SECTION("box and roof") {
    const Layout at_roof = layout_of({box({10, 10, 9.75}, size)});
    CHECK(friction_seen(engine, at_roof, {6, 0, -2 * kGravity}, pairs(0.9, 0.0, 0.4)) ==
          Approx(0.4 * kGravity).epsilon(1e-2));
  }
}

TEST_CASE("surface: materials do not affect friction by the kind of pair", "[bullet][surface]") {
  Settings settings = pairs(0.9, 0.3, 0.7);
  settings.materials[1].friction = 0.0;
  settings.container.friction = 0.0;
  const Layout layout = layout_of({box({10, 10, 0}, {1.1, 1.1, 0.25})});
  CHECK(friction_seen("bullet", layout, {6, 0, 0}, settings) == Approx(0.3 * kGravity).epsilon(1e-3));
}

TEST_CASE("surface: a box rebounds with its own restitution", "[bullet][surface]") {
  const std::string engine = any_engine();
  Settings settings = open_floor(0.5);
  CAPTURE(engine, rebound(engine, settings));
  CHECK(rebound(engine, settings) < 1e-3);
  // Measured 3.3 % too low at e = 0.5: the contact is found only after the boxes overlap.
  settings.contact.restitution = 0.5;
  CHECK(rebound(engine, settings) == Approx(0.25).epsilon(0.05));
  settings.materials[1].restitution = 0.8;
  CHECK(rebound(engine, settings) == Approx(0.64).epsilon(0.05));
}

TEST_CASE("surface: two boxes have the smaller restitution", "[bullet][surface]") {
  const std::string engine = any_engine();
  Settings settings = open_floor(0.0);
  // With bullet-stock, the correction of the penetration adds a tenth to the rebound.
  settings.bullet.split_impulse_threshold = 0.0;
  settings.materials[1].restitution = 0.9;
  settings.materials[2].restitution = 0.4;
  // Box 1 hits box 2, which is at rest and has the same mass.
  const auto after_impact = [&](int first, int second) {
    const Layout layout = layout_of({box({8, 10, 0}, {1, 1, 0.5}, first), box({9.1, 10, 0}, {1, 1, 0.5}, second)});
    return run(*engine_of(engine, settings), layout, constant(0, 0.5), settings,
               [](StateColumns& state) { state.velocity[0].x() = 1.0; })
        .state.velocity;
  };
  CAPTURE(engine);
  for (const auto& [first, second] : {std::pair(1, 2), std::pair(2, 1), std::pair(2, 2)}) {
    const std::vector<Vec3> velocity = after_impact(first, second);
    CHECK(velocity[0].x() == Approx(0.3).epsilon(0.02));
    CHECK(velocity[1].x() == Approx(0.7).epsilon(0.02));
  }
  CHECK(after_impact(1, 1)[1].x() == Approx(0.95).epsilon(0.02));
}

}  // namespace surface_test
