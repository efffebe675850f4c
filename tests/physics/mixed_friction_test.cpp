// Loads of unlike boxes: anti-slip mats, coefficients of pairs of materials, masses and containers of their own.

#include <cmath>
#include <string>
#include <vector>

#include "core/model/verdict.hpp"
#include "core/native/native_scenes.hpp"
#include "physics/measures.hpp"
#include "physics/ways.hpp"
#include "same_bits.hpp"
#include "scenes.hpp"

namespace mixed_friction_test {

using namespace holdfast::internal;
using namespace holdfast::internal::scenes;
using namespace holdfast::internal::physics;

namespace {

const Vec3 kFlat(1.0, 1.0, 0.2);  ///< slides and does not tip, m

bool is_bullet(const Way& way) { return way.engine.starts_with("bullet"); }

/// How far a box goes that begins to slide at once, under so much more than its limit for so long, m.
double slide(double excess, double duration) { return 0.5 * excess * kGravity * duration * duration; }

/// Share of the way by which it may differ: Bullet's time stepping lengthens it by h/t.
double path_error(const Way& way) { return is_bullet(way) ? 0.01 : 1e-3; }

/// How far a box creeps that is held, m: Bullet's by millimetres, and of native-plain what it has not solved.
double creep(const Way& way) { return is_bullet(way) ? 2e-3 : way.engine == "native" ? 1e-6 : 1e-4; }

Box with_mat(Box box, double coefficient) {
  box.mat = coefficient;
  return box;
}

Box of(const std::string& material, const Vec3& corner, const Vec3& size) {
  return {corner, corner + size, MaterialName(material), 0};
}

void set_pair(Settings& settings, const char* partners, double coefficient) {
  settings.contact.materials.set(*parse_partners(partners), coefficient);
}

/// The layout with its boxes the other way round.
Layout reversed(Layout layout) {
  std::reverse(layout.boxes.begin(), layout.boxes.end());
  return layout;
}

bool same_end(const Run& a, const Run& b) {
  return same_bits(a.state, b.state) && a.record.row.state_hash == b.record.row.state_hash;
}

}  // namespace

TEST_CASE("mixed_friction: of two equal boxes the one on a mat stays", "[physics][mixed]") {
  const Way way = any_way();
  CAPTURE(way.engine, static_cast<int>(way.accuracy));
  const Layout layout = layout_of({with_mat(box({9, 5, 0}, kFlat), 0.6), box({9, 7, 0}, kFlat)});
  const Run one = run_by(way, layout, constant(0.45 * kGravity, 1), open_floor(0.3));
  CAPTURE(text(one.displacement(0).norm()), text(one.displacement(1).x()));
  CHECK(one.displacement(0).norm() < creep(way));
  CHECK(-one.displacement(1).x() == Approx(slide(0.15, 1)).epsilon(path_error(way)));
}

TEST_CASE("mixed_friction: a mat may be slippery, and its factor holds for all mats", "[physics][mixed]") {
  const Way way = any_way();
  CAPTURE(way.engine, static_cast<int>(way.accuracy));
  const Layout layout = layout_of({with_mat(box({9, 5, 0}, kFlat), 0.3), with_mat(box({9, 7, 0}, kFlat), 1.0)});
  Settings settings = open_floor(0.9);
  settings.contact.mat_factor = 0.5;
  const Run one = run_by(way, layout, constant(0.45 * kGravity, 1), settings);
  CHECK(-one.displacement(0).x() == Approx(slide(0.45 - 0.15, 1)).epsilon(path_error(way)));
  CHECK(one.displacement(1).norm() < creep(way));
}

TEST_CASE("mixed_friction: a mat acts beneath its box, not on it", "[physics][mixed]") {
  const Way way = any_way();
  CAPTURE(way.engine, static_cast<int>(way.accuracy));
  const Box lower = box({9, 5, 0}, {3, 1, 0.3});
  const Box upper = box({11.2, 5.2, 0.3}, {0.6, 0.6, 0.15});
  Settings settings = open_floor(0.3);
  settings.contact.box_floor = 0.8;
  for (const bool turned : {false, true}) {
    CAPTURE(turned);
    const auto run_with = [&](const Box& below, const Box& above) {
      const Layout layout = layout_of({below, above});
      return run_by(way, turned ? reversed(layout) : layout, constant(0.45 * kGravity, 1), settings);
    };
    const std::size_t first = turned ? 1 : 0;
    const Run below = run_with(with_mat(lower, 0.9), upper);
    CHECK(below.displacement(first).norm() < creep(way));
    CHECK(-below.displacement(1 - first).x() == Approx(slide(0.15, 1)).epsilon(path_error(way)));
    const Run above = run_with(lower, with_mat(upper, 0.6));
    CHECK(above.displacement(first).norm() < creep(way));
    CHECK(above.displacement(1 - first).norm() < creep(way));
  }
}

// Twice its weight presses the box on the wall: with 0.3 there it falls by (g − 0.3 · 2 g) t² / 2.
TEST_CASE("mixed_friction: a mat does not act on what its box leans on", "[physics][mixed]") {
  const Way way = any_way();
  CAPTURE(way.engine, static_cast<int>(way.accuracy));
  const double duration = 0.4;
  const Layout layout = layout_of({with_mat(box({0, 5, 1}, {0.2, 1, 1}), 0.9)});
  const Run one = run_by(way, layout, constant(2 * kGravity, duration), open_floor(0.3));
  CAPTURE(text(one.displacement().z()));
  CHECK(-one.displacement().z() == Approx(slide(1 - 0.6, duration)).epsilon(is_bullet(way) ? 0.03 : 5e-3));
}

TEST_CASE("mixed_friction: boxes slide at the limits of their materials", "[physics][mixed]") {
  const Way way = any_way();
  CAPTURE(way.engine, static_cast<int>(way.accuracy));
  const double on_pallet = 0.25, on_floor = 0.35;
  Settings settings = open_floor(0.9);
  set_pair(settings, "pallet, carton", on_pallet);
  set_pair(settings, "carton, floor", on_floor);
  const Layout layout = layout_of({of("carton", {9, 3, 0}, kFlat), of("pallet", {9, 5, 0}, {3, 1, 0.3}),
                                   of("carton", {10.8, 5.2, 0.3}, {0.6, 0.6, 0.15})});
  const auto run_at = [&](double acceleration) {
    return run_by(way, layout, constant(acceleration * kGravity, 1), settings);
  };
  const auto slides = [&](const Run& one, std::size_t i, double excess) {
    CAPTURE(i, text(one.displacement(i).x()), text(slide(excess, 1)));
    // Near its limit Bullet's friction has not converged.
    CHECK(-one.displacement(i).x() == Approx(slide(excess, 1)).epsilon(is_bullet(way) ? 0.15 : 1e-3));
  };
  const Run below = run_at(0.98 * on_pallet);
  for (const std::size_t i : {0U, 1U, 2U}) CHECK(below.displacement(i).norm() < creep(way));
  const Run above = run_at(1.02 * on_pallet);
  for (const std::size_t i : {0U, 1U}) CHECK(above.displacement(i).norm() < creep(way));
  slides(above, 2, 0.02 * on_pallet);
  const Run held = run_at(0.98 * on_floor);
  for (const std::size_t i : {0U, 1U}) CHECK(held.displacement(i).norm() < creep(way));
  const Run slid = run_at(1.02 * on_floor);
  slides(slid, 0, 0.02 * on_floor);
  CHECK(slid.displacement(1).norm() < creep(way));
}

// Every interface carries all of the weight above it, so that masses have no influence on its limit.
TEST_CASE("mixed_friction: a heavy box on a light one slides at the same limit", "[physics][mixed][slow]") {
  const Way way = any_way();
  CAPTURE(way.engine, static_cast<int>(way.accuracy));
  Layout layout = layout_of({box({9, 5, 0}, {2, 1, 0.3}), box({9.8, 5, 0.3}, {1, 1, 0.3})});
  layout.boxes[0].mass = 10.0;
  layout.boxes[1].mass = 1000.0;
  const double limit = 0.3, other = 0.6;
  // With such masses Bullet's 50 iterations do not converge: the boxes go by up to 22 mm too far in a second.
  const double margin = is_bullet(way) ? 0.03 : 2e-4;
  for (const bool between : {false, true}) {
    CAPTURE(between);
    Settings settings = open_floor(limit);
    (between ? settings.contact.box_floor : settings.contact.box_box) = other;
    const Run below = run_by(way, layout, constant(0.98 * limit * kGravity, 1), settings);
    const Run above = run_by(way, layout, constant(1.02 * limit * kGravity, 1), settings);
    const Run far = run_by(way, layout, constant(1.5 * limit * kGravity, 1), settings);
    for (const std::size_t i : {0U, 1U}) {
      const bool slides = i == 1 || !between;
      CAPTURE(i, text(below.displacement(i).norm()), text(above.displacement(i).x()), text(far.displacement(i).x()));
      CHECK(below.displacement(i).norm() < margin);
      CHECK(-above.displacement(i).x() == Approx(slides ? slide(0.02 * limit, 1) : 0.0).margin(margin));
      CHECK(-far.displacement(i).x() == Approx(slides ? slide(0.5 * limit, 1) : 0.0).margin(margin));
    }
  }
}

TEST_CASE("mixed_friction: a box that is fixed holds what leans on it, and counts in no verdict", "[physics][mixed]") {
  const Way way = any_way();
  CAPTURE(way.engine, static_cast<int>(way.accuracy));
  Settings settings = open_floor(0.2);
  settings.contact.box_box = 0.0;
  settings.screening.reference_pose = ReferencePose::layout;
  const Thresholds limits;
  Layout layout = layout_of({box({5, 5, 0}, {1, 1, 0.5}), box({4.8, 4, 0}, {0.2, 3, 1})});
  const auto verdict_of = [&](const Run& one) {
    return judge_world(one.record.row, one.record.end, by_run(limits)).verdict;
  };
  layout.boxes[1].fixed = true;
  const Run held = run_by(way, layout, constant(5, 1), settings);
  CHECK(held.displacement(0).norm() < creep(way));
  CHECK(held.displacement(1) == Vec3(Vec3::Zero()));
  CHECK(held.record.boxes.mass[0] == Approx(125.0));
  CHECK(held.record.boxes.mass[1] == 0.0F);
  CHECK(verdict_of(held) == Verdict::stayed);
  layout.boxes[1].fixed = false;
  CHECK(verdict_of(run_by(way, layout, constant(5, 1), settings)) == Verdict::moved);
}

// One slides over the sill and falls to the ground, the other is held by the rear wall.
TEST_CASE("mixed_friction: loads in containers of their own move in one batch as each does alone",
          "[physics][mixed][slow]") {
  const Way way = any_way();
  CAPTURE(way.engine, static_cast<int>(way.accuracy));
  Settings settings = open_floor(0.2);
  settings.native.accuracy = way.accuracy;
  settings.container.size = {3, 3, 3};
  std::vector<Layout> layouts(2, layout_of({box({8.5, 1, 0}, {0.8, 0.8, 0.8})}));
  layouts[0].container = ContainerShape{.size = {10, 4, 3}, .open_sides = {"rear"}, .bed_height = 0.5};
  layouts[1].container = ContainerShape{.size = {9.5, 4, 3}};
  const Acceleration acceleration = acceleration_of({{1.5, {-5, 0, 0}}, {2.0, {0, 0, 0}}});
  const Acceleration* const accelerations[] = {&acceleration};
  const std::vector<Run> both = run_all(*engine_of(way.engine, settings), layouts, accelerations, settings);
  REQUIRE(both.size() == 2);
  CHECK(both[0].displacement().x() > 1.0);
  CHECK(both[0].displacement().z() == Approx(-0.5).margin(0.02));
  CHECK(both[1].displacement().x() == Approx(0.2).margin(5e-3));
  CHECK(std::abs(both[1].displacement().z()) < 5e-3);
  for (const std::size_t i : {0U, 1U}) CHECK(same_end(both[i], run_by(way, layouts[i], acceleration, settings)));

  // The same as containers of the run.
  for (const std::size_t i : {0U, 1U}) {
    Settings common = settings;
    static_cast<ContainerShape&>(common.container) = *layouts[i].container;
    Layout plain = layouts[i];
    plain.container.reset();
    CHECK(same_end(both[i], run_by(way, plain, acceleration, common)));
    settings.container.overrides_loads = true;
    static_cast<ContainerShape&>(settings.container) = *layouts[i].container;
    CHECK(same_end(both[i], run_by(way, layouts[1 - i], acceleration, settings)));
  }
}

TEST_CASE("mixed_friction: what boxes say for themselves moves them as what their materials say",
          "[physics][mixed][slow]") {
  const Way way = any_way();
  CAPTURE(way.engine, static_cast<int>(way.accuracy));
  const Acceleration acceleration = acceleration_of({{0.4, {5, 1, 0}}, {0.4, {-3, 4, 0}}, {0.3, {0, 0, 0}}});
  Settings settings = open_floor(0.4);
  settings.container.size = {3, 3, 3};
  Layout by_material = layout_of({box({0.5, 0.5, 0}, {0.8, 0.8, 0.6}), box({0.6, 0.5, 0.6}, {0.5, 0.6, 0.5}, 2),
                                  box({1.6, 0.5, 0}, {0.2, 1.5, 1}, 3), box({2.0, 0.4, 0}, {0.5, 0.5, 1.2}, 2)});
  Layout by_itself = by_material;
  Settings with_materials = settings;
  with_materials.materials[2].mass = 75.0;
  with_materials.materials[2].centre_of_mass = {0.05, -0.02, -0.1};
  with_materials.materials[3].fixed = true;
  for (const std::size_t i : {1U, 3U}) {
    by_itself.boxes[i].mass = 75.0;
    by_itself.boxes[i].centre_of_mass = Vec3(0.05, -0.02, -0.1);
  }
  by_itself.boxes[2].fixed = true;
  const Run expected = run_by(way, by_material, acceleration, with_materials);
  CHECK(expected.displacement().norm() > 0.01);
  CHECK(same_end(run_by(way, by_itself, acceleration, settings), expected));

  // What a box says for itself comes first.
  for (Box& box : by_material.boxes) box.mass = 40.0;
  with_materials.materials[2].mass = 900.0;
  Settings equal = with_materials;
  equal.materials.at(2).mass = 40.0;
  CHECK(
      same_end(run_by(way, by_material, acceleration, with_materials), run_by(way, by_material, acceleration, equal)));

  // Mats of the coefficient that holds without them change nothing.
  Layout on_mats = by_itself;
  for (Box& box : on_mats.boxes) box.mat = 0.4;
  CHECK(same_end(run_by(way, on_mats, acceleration, settings), expected));
}

// A mat that nothing slides on is all that holds the edge about which the box tips over a step. Without friction
// elsewhere the box slips off as soon as the contact is that of the side of the step.
TEST_CASE("mixed_friction: a mat ends to act when its contact turns", "[physics][mixed]") {
  const Way way = GENERATE(Way{"native", Accuracy::screening}, Way{"native", Accuracy::standard},
                           Way{"native", Accuracy::reference}, Way{"native-plain"});
  CAPTURE(way.engine, static_cast<int>(way.accuracy));
  Layout layout = layout_of({box({5, 5, 0}, {1, 1, 0.6}), with_mat(box({4.75, 5.2, 0.6}, {0.3, 0.6, 1.2}), 2.0)});
  layout.boxes[0].fixed = true;
  const auto tipped = [&](double friction, double time) {
    return run_by(way, layout, constant(0, time), open_floor(friction));
  };
  CHECK(same_end(tipped(0.0, 0.6), tipped(2.0, 0.6)));
  const Run slips = tipped(0.0, 0.9), holds = tipped(2.0, 0.9);
  CAPTURE(text(slips.displacement(1).x()), text(holds.displacement(1).x()));
  // The contact turns in one of the steps, which are 1/60 s long at `screening`: the box slips by 1.5 mm in one of
  // them.
  const bool is_coarse = way.engine == "native" && way.accuracy == Accuracy::screening;
  CHECK(holds.displacement(1).x() - slips.displacement(1).x() == Approx(1.3e-3).margin(is_coarse ? 1.5e-3 : 2e-4));
}

TEST_CASE("mixed_friction: a box slides over a large island as far as its friction lets it, however it is solved",
          "[physics][mixed]") {
  // Rows of two layers, flush and held by the floor: all of them are in one island, whose solves end early.
  Layout layout = layout_of({});
  for (int row = 0; row < 2; ++row)
    for (int i = 0; i < 10; ++i) {
      const Vec3 corner(12 + 0.4 * i, 9 + 0.5 * row, 0);
      const double low = 0.05 * (2 + i % 3);
      layout.boxes.push_back(of("2", corner, {0.4, 0.5, low}));
      layout.boxes.push_back(of("2", corner + Vec3(0, 0, low), {0.4, 0.5, 0.3 - low}));
    }
  layout.boxes.push_back(of("1", {15.3, 9.3, 0.3}, {0.6, 0.5, 0.3}));
  const double friction = 0.5, braking = 8.0, duration = 0.8;
  Settings settings = open_floor(1.5);
  settings.materials[2] = settings.materials[1];
  for (const char* partners : {"1, 1", "1, 2"}) set_pair(settings, partners, friction);
  const double excess = braking - friction * kGravity;
  const double way = 0.5 * excess * duration * duration * braking / (friction * kGravity);
  const auto [accuracy, error] = GENERATE(std::pair(Accuracy::screening, 1e-4), std::pair(Accuracy::standard, 1e-4),
                                          std::pair(Accuracy::reference, 5e-6));
  settings.native.accuracy = accuracy;
  const Run end = native_scenes::native_run(
      layout, acceleration_of({{duration, Vec3(braking, 0, 0)}, {1.5, Vec3::Zero()}}), settings);
  CAPTURE(static_cast<int>(accuracy), text(-end.displacement(40).x() / way - 1.0));
  CHECK(-end.displacement(40).x() == Approx(way).epsilon(error));
  for (std::size_t i = 0; i < 40; ++i) CHECK(end.displacement(i).norm() < 1e-3);
}

// Five boxes that stand, touch and carry: each edge that the sixth passes shifts what the others carry.
TEST_CASE("mixed_friction: a box slides over flush tops by the exact path, at each accuracy and step",
          "[physics][mixed]") {
  // Twelve boxes and the one that slides are a large island, which is solved with less effort where more bodies move.
  const auto [count, side] = GENERATE(std::pair(5, 0.8), std::pair(12, 0.4));
  Layout layout = layout_of({});
  for (int i = 0; i < count; ++i) layout.boxes.push_back(of("1", {12 + side * i, 9, 0}, {side, 0.5, side}));
  layout.boxes.push_back(of("1", {11.2 + side * count, 9, side}, {0.8, 0.5, 0.4}));
  // It comes to rest within a step.
  const double friction = 0.5, braking = 0.8 * kGravity, duration = 1.01;
  Settings settings = open_floor(1.5);
  set_pair(settings, "1, 1", friction);
  const double excess = braking - friction * kGravity;
  const double way = 0.5 * excess * duration * duration * braking / (friction * kGravity);
  settings.native.accuracy = GENERATE(Accuracy::screening, Accuracy::standard, Accuracy::reference);
  settings.native.steps_per_second = GENERATE(30.0, 60.0, 120.0, 240.0, 1000.0);
  const Run end = native_scenes::native_run(
      layout, acceleration_of({{0.5, Vec3::Zero()}, {duration, Vec3(braking, 0, 0)}, {1.0, Vec3::Zero()}}), settings);
  const double path = -end.displacement(layout.boxes.size() - 1).x();
  CAPTURE(count, static_cast<int>(settings.native.accuracy), settings.native.steps_per_second, text(path - way));
  CHECK(path == Approx(way).margin(1e-6));
}

}  // namespace mixed_friction_test
