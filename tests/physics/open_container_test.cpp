// Containers that boxes can get out of: floors that end, walls that are low, and what is fixed to the container.

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <iterator>
#include <limits>
#include <random>
#include <vector>

#include "analyses/walls/wall_forces.hpp"
#include "core/model/container_panels.hpp"
#include "core/model/container_sides.hpp"
#include "core/native/native_scenes.hpp"
#include "physics/measures.hpp"
#include "physics/ways.hpp"

namespace open_container_test {

using namespace holdfast::internal;
using namespace holdfast::internal::native_scenes;
using namespace holdfast::internal::scenes;
using namespace holdfast::internal::physics;

namespace {

constexpr double kLength = 10.0, kBed = 1.2;

/// A container of 10 m x 4 m x 3 m that is open at the rear.
Settings open_rear(double friction) {
  Settings settings = open_floor(friction);
  settings.container.size = {kLength, 4, 3};
  settings.container.open_sides = {"rear"};
  settings.box_friction = settings.container.ground_friction = 1.0;
  return settings;
}

/// The two sides without a wall between, at a height.
Settings drop_sides(double height, double friction) {
  Settings settings = open_floor(friction);
  settings.container.size = {kLength, 4, 3};
  settings.container.drop_sides = {{"left", height}, {"right", height}};
  return settings;
}

}  // namespace

TEST_CASE("open_container: a box stands on the sill as long as its centre is over the floor", "[physics][open]") {
  const Way way = any_way();
  CAPTURE(way.engine, static_cast<int>(way.accuracy));
  const Vec3 size(0.6, 0.5, 0.4);
  for (const double over : {0.49, 0.51}) {
    CAPTURE(over);
    const Layout layout = layout_of({box({kLength - (1.0 - over) * size.x(), 1, 0}, size)});
    const Run one = run_by(way, layout, constant(0, 3), open_rear(0.8));
    if (over < 0.5)
      CHECK(one.displacement().norm() < 2e-3);
    else
      CHECK(one.displacement().z() < -0.9 * kBed);
  }
}

// A box whose centre is d before the sill tips over it when (a h / 2) exceeds g d.
TEST_CASE("open_container: a box on the sill tips under the acceleration that statics says", "[physics][open]") {
  const Way way = any_way();
  CAPTURE(way.engine, static_cast<int>(way.accuracy));
  const Vec3 size(0.6, 0.5, 0.4);
  const double before = 0.05;
  const double limit = kGravity * before / (0.5 * size.z());
  const Layout layout = layout_of({box({kLength - before - 0.5 * size.x(), 1, 0}, size)});
  for (const double share : {0.95, 1.05}) {
    CAPTURE(share);
    const Run one = run_by(way, layout, constant(-share * limit, 3), open_rear(0.8));
    if (share < 1.0)
      CHECK(one.displacement().norm() < 2e-3);
    else
      CHECK(one.displacement().z() < -0.9 * kBed);
  }
}

// A plate that starts beyond the floor flies freely: x = a t² / 2, z = g t² / 2. It lands flat, on ground that holds
// it.
TEST_CASE("open_container: a box that has left lands where and when the parabola says, and stays", "[physics][open]") {
  const Way way = any_way();
  CAPTURE(way.engine, static_cast<int>(way.accuracy));
  const double height = 0.6, acceleration = 3.0;
  Settings settings = open_rear(0.8);
  settings.results_interval = 0.001;
  const Layout layout = layout_of({box({kLength + 0.5, 1, height}, {2.0, 2.0, 0.1})});
  const Run one = run_by(way, layout, constant(-acceleration, 2), settings);
  const double fall = height + kBed;
  const double time = std::sqrt(2.0 * fall / kGravity);
  // Samples are interpolated within steps.
  const double step = way.engine == "native" && way.accuracy == Accuracy::screening ? 1.0 / 60.0 : 1.0 / 120.0;
  const Series& series = one.record.series;
  std::size_t landed = 0;
  while (landed < series.time.size() && series.displacement[landed].z > -fall + 1e-3) ++landed;
  REQUIRE(landed < series.time.size());
  CHECK(series.time[landed] == Approx(time).margin(step));
  CHECK(one.displacement().z() == Approx(-fall).margin(2e-3));
  // The impact takes up to μ v of the speed along the ground at once: it stops there.
  CHECK(one.displacement().x() == Approx(0.5 * acceleration * time * time).epsilon(0.02));
  CHECK(one.record.end.peak_drop[0] == Approx(fall).epsilon(2e-3));
}

TEST_CASE("open_container: a box that slides out tips over the sill and lies on the ground", "[physics][open]") {
  const Way way = any_way();
  CAPTURE(way.engine, static_cast<int>(way.accuracy));
  const Layout layout = layout_of({box({kLength - 1.5, 1, 0}, {0.8, 0.8, 0.8})});
  const Run one = run_by(way, layout, acceleration_of({{1.5, {-5, 0, 0}}, {2.0, {0, 0, 0}}}), open_rear(0.2));
  CHECK(one.displacement().x() > 1.0);
  CHECK(one.displacement().z() == Approx(-kBed).margin(0.02));
  CHECK(one.state.velocity[0].norm() < 0.05);
}

TEST_CASE("open_container: without a bed the floor has no end", "[physics][open]") {
  const Way way = any_way();
  CAPTURE(way.engine, static_cast<int>(way.accuracy));
  Settings settings = open_rear(0.2);
  settings.container.bed_height = 0.0;
  const Layout layout = layout_of({box({kLength - 1.5, 1, 0}, {0.8, 0.8, 0.4})});
  const Run one = run_by(way, layout, constant(-5, 1.5), settings);
  CHECK(one.displacement().x() == Approx(0.5 * (5 - 0.2 * kGravity) * 1.5 * 1.5).epsilon(0.01));
  CHECK(std::abs(one.displacement().z()) < 2e-3);
}

// Without friction the wall has to take m a, at its upper edge at most: a box tips about its foot when
// a (h / 2 − H) exceeds g l / 2, for a wall of height H.
TEST_CASE("open_container: a box leans on a drop side, and tips over it as statics says", "[physics][open]") {
  const Way way = any_way();
  CAPTURE(way.engine, static_cast<int>(way.accuracy));
  const Vec3 size(0.8, 0.4, 1.6);
  const double wall = 0.4;
  const double limit = kGravity * 0.5 * size.y() / (0.5 * size.z() - wall);
  const Layout layout = layout_of({box({4, 4 - size.y(), 0}, size)});
  for (const double share : {0.95, 1.05}) {
    CAPTURE(share);
    const Acceleration acceleration = acceleration_of({{2.0, {0, -share * limit, 0}}});
    const Run one = run_by(way, layout, acceleration, drop_sides(wall, 0.0));
    if (share < 1.0) {
      CHECK(one.displacement().norm() < 2e-3);
    } else {
      CHECK(one.displacement().y() > 0.5);
      CHECK(one.displacement().z() < -0.5);
    }
    // A wall of full height holds it.
    Settings closed = drop_sides(wall, 0.0);
    closed.container.drop_sides.clear();
    CHECK(run_by(way, layout, acceleration, closed).displacement().norm() < 2e-3);
  }
}

// The wall is 5 cm thick; the box has no floor beneath it.
TEST_CASE("open_container: a box stands on a drop side as long as its centre is over the wall", "[physics][open]") {
  const Way way = any_way();
  CAPTURE(way.engine, static_cast<int>(way.accuracy));
  const double wall = 0.6;
  for (const double width : {0.08, 0.12}) {
    CAPTURE(width);
    const Layout layout = layout_of({box({4, -width, wall}, {0.6, width, 0.2})});
    const Run one = run_by(way, layout, constant(0, 3), drop_sides(wall, 0.8));
    if (width < 2.0 * kWallThickness)
      CHECK(one.displacement().norm() < 2e-3);
    else
      CHECK(one.displacement().z() < -0.5 * wall);
  }
}

TEST_CASE("open_container: a plank slides along the edges of two drop sides", "[physics][open]") {
  const Way way = any_way();
  CAPTURE(way.engine, static_cast<int>(way.accuracy));
  const double friction = 0.3, acceleration = 5.0, wall = 0.6;
  const Layout layout = layout_of({box({6, -0.02, wall}, {0.5, 4.04, 0.1})});
  const Run one = run_by(way, layout, constant(acceleration, 1), drop_sides(wall, friction));
  CHECK(-one.displacement().x() == Approx(0.5 * (acceleration - friction * kGravity)).epsilon(0.01));
  CHECK(std::abs(one.displacement().z()) < 2e-3);
}

// The row is as high as the drop side: it and the sill must not catch what slides over them.
TEST_CASE("open_container: a box slides over flush tops, over the edge of a drop side, and out", "[physics][open]") {
  for (const Accuracy accuracy : {Accuracy::screening, Accuracy::standard, Accuracy::reference}) {
    const double height = 0.6, friction = 0.3, acceleration = 6.0;
    std::vector<Box> boxes;
    for (int i = 0; i < 5; ++i) boxes.push_back(box({4, 0.8 * i, 0}, {0.8, 0.8, height}));
    boxes.push_back(box({4, 0, height}, {0.8, 0.8, 0.3}));
    Settings settings = with(accuracy, drop_sides(height, friction));
    settings.contact.box_floor = 1.0;
    CAPTURE(static_cast<int>(accuracy));
    const Layout layout = layout_of(boxes);
    const Run on_top = native_run(layout, acceleration_of({{1.4, {0, -acceleration, 0}}}), settings);
    CHECK(on_top.displacement(5).y() == Approx(0.5 * (acceleration - friction * kGravity) * 1.4 * 1.4).epsilon(1e-3));
    const Run out = native_run(layout, acceleration_of({{2.5, {0, -acceleration, 0}}}), settings);
    CHECK(out.displacement(5).z() < -height - 0.5 * kBed);
  }
}

TEST_CASE("open_container: what is fixed holds a box, and does not move", "[physics][open]") {
  const Way way = any_way();
  CAPTURE(way.engine, static_cast<int>(way.accuracy));
  Settings settings = open_floor(0.2);
  settings.contact.box_box = 0.0;
  settings.materials[2].fixed = true;
  settings.screening.wall_forces = way.engine != "native-plain";
  Layout layout = layout_of({box({5, 5, 0}, {1, 1, 0.5}), box({4.8, 4, 0}, {0.2, 3, 1})});
  layout.boxes[1].material = 2;
  const double acceleration = 5.0;
  const Run one = run_by(way, layout, constant(acceleration, 1), settings);
  CHECK(one.displacement(0).norm() < 2e-3);
  CHECK(one.displacement(1) == Vec3(Vec3::Zero()));
  CHECK(one.record.boxes.mass[1] == 0.0F);
  CHECK(one.record.end.peak_kinetic_energy[1] == 0.0F);
  if (!settings.screening.wall_forces) return;
  const WallForces& walls = *one.record.found.get<WallForces>();
  const double force = 250.0 * 0.5 * (acceleration - 0.2 * kGravity);
  // Between the least and the largest that statics admits, where friction at the floor helps or presses; native finds
  // the least.
  CHECK(walls.impulse[kFixedBoxes].x() < -0.999 * force);
  CHECK(walls.impulse[kFixedBoxes].x() > -1.01 * 250.0 * 0.5 * (acceleration + 0.2 * kGravity));
  if (way.engine == "native") CHECK(walls.impulse[kFixedBoxes].x() == Approx(-force).epsilon(1e-4));
  CHECK(walls.impulse[1] == Vec3(Vec3::Zero()));
}

TEST_CASE("open_container: boxes that fit exactly between fixed boxes are not clamped", "[physics][open]") {
  Settings settings = with(Accuracy::reference, open_rear(0.4));
  settings.container.size = {6, 2.4, 3};
  settings.density_value = 250.0;
  settings.contact.box_floor = 0.4;
  settings.contact.box_box = 0.35;
  settings.contact.box_wall = 0.3;
  settings.materials[2].fixed = true;
  settings.materials[3].mass = 30.0;
  settings.materials[4].mass = 150.0;
  const struct {
    Vec3 corner, size;
    int material;
  } boxes[] = {{{1, 0, 0}, {1.2, 0.3, 0.35}, 2},        {{1, 2.1, 0}, {1.2, 0.3, 0.35}, 2},
               {{0, 0, 0}, {0.8, 0.4, 0.55}, 1},        {{0, 0, 0.55}, {0.8, 0.4, 0.55}, 3},
               {{0, 0.4, 0}, {0.8, 0.4, 0.4}, 3},       {{0, 0.4, 0.4}, {0.8, 0.4, 0.25}, 1},
               {{0, 0.8, 0}, {0.8, 0.4, 0.55}, 4},      {{0, 0.8, 0.55}, {0.8, 0.4, 0.55}, 3},
               {{0, 1.2, 0}, {0.8, 0.6, 0.4}, 1},       {{0, 1.2, 0.4}, {0.8, 0.6, 0.25}, 1},
               {{0, 1.8, 0}, {0.8, 0.6, 0.25}, 3},      {{0.8, 0.3, 0}, {0.6, 0.4, 0.55}, 3},
               {{0.8, 0.7, 0}, {0.6, 0.5, 0.4}, 3},     {{0.8, 1.2, 0}, {0.6, 0.9, 0.25}, 3},
               {{1.4, 0.3, 0}, {0.6, 0.9, 0.25}, 3},    {{1.4, 0.3, 0.25}, {0.6, 0.9, 0.25}, 1},
               {{1.4, 1.2, 0}, {0.6, 0.5, 0.4}, 1},     {{1.4, 1.7, 0}, {0.6, 0.4, 0.55}, 3},
               {{1.4, 1.7, 0.55}, {0.6, 0.4, 0.55}, 4}, {{2, 0.3, 0}, {0.8, 0.6, 0.55}, 4},
               {{2, 0.3, 0.55}, {0.8, 0.6, 0.4}, 3},    {{2, 0.9, 0}, {0.8, 0.9, 0.25}, 1},
               {{2, 0.9, 0.25}, {0.8, 0.9, 0.25}, 4},   {{2, 1.8, 0}, {0.8, 0.3, 0.4}, 1}};
  const auto run = [&](double gap) {
    Layout layout;
    for (const auto& of : boxes) {
      layout.boxes.push_back(box(of.corner, of.size));
      layout.boxes.back().material = of.material;
    }
    layout.boxes[1].corner_min.y() += gap;
    layout.boxes[1].corner_max.y() += gap;
    return native_run(layout, constant(-6, 0.4), settings);
  };
  const Run exact = run(0.0), gapped = run(1e-5);
  for (std::size_t i = 2; i < std::size(boxes); ++i) {
    CAPTURE(i);
    CHECK(exact.displacement(i).x() == Approx(gapped.displacement(i).x()).margin(0.02));
  }
}

TEST_CASE("open_container: forces at rest balance what still rests where others are hit away", "[physics][open]") {
  // Loads of which some boxes come to rest, and are hit.
  Settings settings = open_rear(0.4);
  settings.container.size = {3, 1.2, 3};
  settings.container.drop_sides = {{"left", 0.4}, {"right", 0.4}};
  settings.density_value = 250.0;
  settings.contact.box_floor = 0.4;
  settings.contact.box_box = 0.35;
  settings.contact.box_wall = 0.3;
  settings.screening.wall_forces = true;
  settings.screening.run_out_seconds = 8.0;
  settings.materials[2].fixed = true;
  std::mt19937 random(1);
  const auto one_of = [&](std::initializer_list<double> sizes) { return sizes.begin()[random() % sizes.size()]; };
  const Acceleration acceleration = acceleration_of({{0.5, {4, 6, 0}}, {0.8, {-7, -2, 0}}});
  for (int number = 0; number < 30; ++number) {
    CAPTURE(number);
    Layout layout = layout_of({box({0, 0, 0}, {0.1, 1.2, one_of({0.6, 0.9})})});
    layout.boxes[0].material = 2;
    double x = 0.1;
    for (int column = 0; column < 3; ++column) {
      const double length = one_of({0.4, 0.6});
      for (double y = 0.0; y < 1.0;) {
        const double width = std::min(1.2 - y, one_of({0.4, 0.6}));
        double z = 0.0;
        for (std::size_t layers = 1 + random() % 3; layers > 0; --layers) {
          const double height = one_of({0.2, 0.4, 0.5});
          layout.boxes.push_back(box({x, y, z}, {length, width, height}));
          z += height;
        }
        y += width;
      }
      x += length;
    }
    const Run one = native_run(layout, acceleration, settings);
    CHECK(imbalance(layout, acceleration, settings, one) < 1e-6);
  }
}

TEST_CASE("open_container: sides, ground and fixed boxes together balance weight and change of momentum",
          "[physics][open]") {
  for (const Accuracy accuracy : {Accuracy::screening, Accuracy::standard, Accuracy::reference}) {
    Settings settings = with(accuracy, open_rear(0.4));
    settings.screening.wall_forces = true;
    settings.container.drop_sides = {{"left", 0.5}};
    settings.materials[2].fixed = true;
    Layout layout = layout_of({box({1, 1, 0}, {1, 1, 0.8}), box({0.8, 0.5, 0}, {0.2, 3, 1})});
    layout.boxes[1].material = 2;
    for (int i = 0; i < 3; ++i) layout.boxes.push_back(box({kLength - 0.9, 1, 0.5 * i}, {0.8, 0.8, 0.5}));
    layout.boxes.push_back(box({5, 0, 0}, {0.5, 0.4, 1.5}));
    const Acceleration acceleration = acceleration_of({{0.3, {0, 0, 0}}, {1.0, {6, 5, 0}}, {1.0, {-6, -2, 0}}});
    const Run one = native_run(layout, acceleration, settings);
    const WallForces& walls = *one.record.found.get<WallForces>();
    const double unbalanced = imbalance(layout, acceleration, settings, one);
    CAPTURE(static_cast<int>(accuracy), text(unbalanced));
    CHECK(walls.peak_force[kGround] > 0.0);
    CHECK(walls.peak_force[kFixedBoxes] > 0.0);
    CHECK(unbalanced < 1e-6);
  }
}

TEST_CASE("open_container: what a low stop holds is balanced as exactly as what a high one holds", "[physics][open]") {
  // The box is pushed by nearly what tips it over the stop: M (a (h/2 − H) − g l/2 + μ g H) = 0 where friction helps.
  const Vec3 size(0.445, 0.5, 1.845);
  const double friction = 0.5;
  for (const double height : {0.3, 0.05, 0.02}) {
    Settings settings = with(Accuracy::standard, open_floor(friction));
    settings.container.size = {3, 2, 2.5};
    settings.screening.wall_forces = true;
    settings.materials[2].fixed = true;
    Layout layout = layout_of({box({0.1, 0.7, 0}, size), box({0, 0.7, 0}, {0.1, 0.5, height})});
    layout.boxes[1].material = 2;
    const double tips = kGravity * (0.5 * size.x() + friction * height) / (0.5 * size.z() - height);
    const Acceleration acceleration = acceleration_of({{2.0, {0.9 * tips, 0, 0}}});
    const Run one = native_run(layout, acceleration, settings);
    const double unbalanced = imbalance(layout, acceleration, settings, one);
    CAPTURE(height, text(unbalanced));
    CHECK(one.record.found.get<WallForces>()->peak_force[kFixedBoxes] > 0.0);
    CHECK(unbalanced < 1e-6);
  }
}

TEST_CASE("container_panels: an open container stands on the ground, and its walls end", "[core][model]") {
  ContainerSettings container;
  container.size = {6, 2, 2.5};
  container.open_sides = {"rear", "roof"};
  container.drop_sides = {{"left", 0.6}};
  const std::vector<Panel> panels = container_panels(container, 1.0);
  REQUIRE(panels.size() == 5);
  const auto low = [&](std::size_t i) -> Vec3 { return panels[i].centre - panels[i].half_extents; };
  const auto high = [&](std::size_t i) -> Vec3 { return panels[i].centre + panels[i].half_extents; };
  CHECK(low(0).isApprox(Vec3(-kWallThickness, -kWallThickness, -1.2)));
  CHECK(high(0).isApprox(Vec3(6, 2 + kWallThickness, 0)));
  CHECK(panels[2].side == 3);
  CHECK(high(2).z() == Approx(0.6));
  CHECK(high(2).x() == Approx(6));
  CHECK(high(1).z() == Approx(2.5));
  CHECK(panels[4].side == kGround);
  CHECK(panels[4].offset == -1.2);
  for (std::size_t i = 0; i < 5; ++i) CHECK(panels[i].ends == (i < 4));
  container.open_sides.clear();
  container.drop_sides.clear();
  for (const Panel& panel : container_panels(container, 1.0)) CHECK(!panel.ends);
}

}  // namespace open_container_test
