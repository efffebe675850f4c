// The forces on a free container are (container + cargo mass) a(t) and the friction of the ground.

#include "scenes.hpp"

namespace free_container_test {

using namespace holdfast::internal;
using namespace holdfast::internal::scenes;

namespace {

constexpr double kStep = 1.0 / 240;  ///< s

std::string any_engine() { return GENERATE(as<std::string>{}, "bullet", "bullet-f64", "bullet-stock"); }

Settings free_container(double box_friction, double ground_friction) {
  Settings settings = at_once();
  settings.container.motion = ContainerMotion::free;
  settings.container.friction = 1.0;
  settings.container.ground_friction = ground_friction;
  settings.box_friction = box_friction;
  return settings;
}

/// One box of 250 kg.
Layout cargo() { return layout_of({box({3, 0.6, 0}, {1, 1, 1})}); }

/// Force on the container divided by its own mass, relative to the acceleration in the file.
const double kDrive = (3700.0 + 250.0) / 3700.0;

}  // namespace

TEST_CASE("free_container: nothing moves at rest", "[bullet][free_container]") {
  const std::string engine = any_engine();
  const Run one = run(engine, cargo(), constant(0, 1), free_container(0.5, 0.6));
  CAPTURE(engine, one.displacement().norm());
  CHECK(one.displacement().norm() < 1e-4);
}

TEST_CASE("free_container: a frictionless box does not move with the container", "[bullet][free_container]") {
  const std::string engine = any_engine();
  const Run one = run(engine, cargo(), constant(2, 1), free_container(0.0, 0.0));
  const double expected = -0.5 * kDrive * 2 * (1 + kStep);
  CAPTURE(engine, one.displacement().x(), expected, one.displacement().norm());
  CHECK(one.displacement().x() == Approx(expected).epsilon(1e-3));
  CHECK(one.state.velocity[0].x() == Approx(-kDrive * 2).epsilon(1e-3));
  CHECK(std::abs(one.displacement().y()) < 1e-3);
  CHECK(std::abs(one.displacement().z()) < 1e-3);
}

TEST_CASE("free_container: a box with friction moves with the container", "[bullet][free_container]") {
  const std::string engine = any_engine();
  const Run one = run(engine, cargo(), constant(2, 1), free_container(0.5, 0.0));
  CAPTURE(engine, one.displacement().norm());
  CHECK(one.displacement().norm() < 5e-3);
}

TEST_CASE("free_container: the ground holds the container below its friction", "[bullet][free_container]") {
  const std::string engine = any_engine();
  const Run one = run(engine, cargo(), constant(2, 1), free_container(0.0, 0.5));
  CAPTURE(engine, one.displacement().norm());
  CHECK(one.displacement().norm() < 5e-3);
}

TEST_CASE("free_container: above its friction limit the ground slows the container", "[bullet][free_container]") {
  const std::string engine = any_engine();
  const Run one = run(engine, cargo(), constant(5, 0.8), free_container(0.0, 0.3));
  // The normal force on the ground is the weight of container and cargo.
  const double expected = -0.5 * kDrive * (5 - 0.3 * kGravity) * 0.8 * (0.8 + kStep);
  CAPTURE(engine, one.displacement().x(), expected);
  CHECK(one.displacement().x() == Approx(expected).epsilon(0.02));
}

TEST_CASE("free_container: the container moves sideways too", "[bullet][free_container]") {
  const std::string engine = any_engine();
  const Run one = run(engine, cargo(), acceleration_of({{0.5, Vec3(0, -2, 0)}}), free_container(0.0, 0.0));
  const double expected = 0.5 * kDrive * 2 * 0.5 * (0.5 + kStep);
  CAPTURE(engine, one.displacement().y(), expected);
  CHECK(one.displacement().y() == Approx(expected).epsilon(1e-3));
}

}  // namespace free_container_test
