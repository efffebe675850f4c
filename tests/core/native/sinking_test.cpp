// Boxes whose tops are level: what slides over them must not catch on what they have sunk.

#include "core/native/sinking.hpp"

#include <vector>

#include "core/native/native_scenes.hpp"

namespace sinking_test {

using namespace holdfast::internal;
using namespace holdfast::internal::native;
using namespace holdfast::internal::scenes;
using namespace holdfast::internal::native_scenes;

namespace {

constexpr double kFriction = 0.5, kBraking = 0.8 * kGravity;

/// Eight boxes in a row that friction with the floor holds, and one that slides over them, from the last one on. The
/// boxes before the last two are higher by a step.
Layout row_with_slider(double height, double slider_height, double step) {
  std::vector<Box> boxes;
  for (int i = 0; i < 8; ++i) boxes.push_back(box({1.0 + 0.8 * i, 5, 0}, {0.8, 0.5, height + (i < 6 ? step : 0.0)}));
  boxes.push_back(box({1.0 + 0.8 * 7, 5, height}, {0.8, 0.5, slider_height}));
  return layout_of(boxes);
}

/// How far the slider goes, m.
double path_over(const Layout& layout, Settings settings) {
  settings.contact.friction_model = FrictionModel::pairs;
  settings.contact.box_box = kFriction;
  settings.contact.box_floor = 1.2;
  const Run run = native_run(layout, constant(kBraking, 1.0), settings);
  return -run.displacement(layout.boxes.size() - 1).x();
}

const Settings kContainer = open_floor(kFriction);
constexpr Accuracy kAccuracies[] = {Accuracy::screening, Accuracy::standard, Accuracy::reference};

}  // namespace

// Expected: the path of a box on a level floor, (a − μg) t² / 2.
TEST_CASE("sinking: a box slides over level tops as over a floor", "[core][sinking]") {
  const double exact = 0.5 * (kBraking - kFriction * kGravity);
  for (const auto& [height, slider] : {std::pair(0.2, 0.4), std::pair(0.9, 0.6), std::pair(0.05, 0.1)}) {
    const Layout layout = row_with_slider(height, slider, 0.0);
    for (const Accuracy accuracy : kAccuracies) {
      CAPTURE(height, static_cast<int>(accuracy));
      CHECK(path_over(layout, with(accuracy, kContainer)) == Approx(exact).epsilon(1e-3));
    }
    for (const double steps_per_second : {30.0, 60.0, 500.0, 1e4}) {
      Settings settings = kContainer;
      settings.native.steps_per_second = steps_per_second;
      CAPTURE(height, steps_per_second);
      CHECK(path_over(layout, settings) == Approx(exact).epsilon(1e-3));
    }
  }
}

TEST_CASE("sinking: what is less than 50 micrometres higher lets a box pass, and 100 stop it", "[core][sinking]") {
  const double exact = 0.5 * (kBraking - kFriction * kGravity);
  for (const Accuracy accuracy : kAccuracies) {
    for (const double step : {2e-5, 4e-5}) {
      CAPTURE(static_cast<int>(accuracy), step);
      CHECK(path_over(row_with_slider(0.9, 0.6, step), with(accuracy, kContainer)) == Approx(exact).epsilon(1e-3));
    }
    for (const double step : {1e-4, 2e-4, 1e-3}) {
      CAPTURE(static_cast<int>(accuracy), step);
      // It meets the step after 0.8 m, and tips on. Past the step it would come 1.47 m far.
      CHECK(path_over(row_with_slider(0.9, 0.6, step), with(accuracy, kContainer)) < 1.1);
    }
  }
}

// The wall holds the row, whose boxes would tip. Expected: as above for 0.5 s, and then until friction has stopped the
// box.
TEST_CASE("sinking: a box slides over upright boxes before a wall as over a floor", "[core][sinking]") {
  const double friction = 0.4, braking = 6.0;
  const double path = 0.125 * (braking - friction * kGravity) * braking / (friction * kGravity);
  for (const double height : {0.3, 0.5, 1.0}) {
    std::vector<Box> boxes;
    for (int i = 0; i < 8; ++i) boxes.push_back(box({0.2 * i, 5, 0}, {0.2, 1, height}));
    boxes.push_back(box({1.287, 5.2, height}, {0.3, 0.6, 0.25}));
    for (const Accuracy accuracy : kAccuracies) {
      Settings settings = with(accuracy, kContainer);
      settings.contact.friction_model = FrictionModel::pairs;
      settings.contact.box_box = friction;
      settings.contact.box_floor = 1.5;
      settings.contact.box_wall = 0.0;
      const Run run =
          native_run(layout_of(boxes), acceleration_of({{0.5, {braking, 0, 0}}, {0.5, Vec3::Zero()}}), settings);
      CAPTURE(height, static_cast<int>(accuracy));
      CHECK(-run.displacement(8).x() == Approx(path).epsilon(accuracy == Accuracy::reference ? 0.01 : 0.002));
    }
  }
}

TEST_CASE("sinking: overlaps are summed up from the floor on, and what nothing holds has not sunk", "[core][sinking]") {
  // A stack of two that have sunk, one above them that has not, and one that floats.
  const Settings settings = open_floor(kFriction);
  const Layout layout = layout_of({box({5, 5, -1e-4}, {1, 1, 1}), box({5, 5, 1 - 3e-4}, {1, 1, 1}),
                                   box({5, 5, 2 - 3e-4}, {1, 1, 1}), box({8, 5, 3}, {1, 1, 1})});
  const Acceleration acceleration = constant(0, 1);
  const Acceleration* const accelerations[] = {&acceleration};
  const WorldBatch batch = batch_of(std::span(&layout, 1), accelerations, settings);
  const Bodies bodies = bodies_of(batch, batch.worlds[0]);
  std::vector<Manifold> manifolds(3);
  const auto meet = [&](Manifold& manifold, std::int32_t a, std::int32_t b, const ContactSet& contact) {
    manifold.a = a;
    manifold.b = b;
    update_contact(manifold, contact, bodies);
  };
  meet(manifolds[0], 1, 2, contact_of(bodies.shape[1], bodies.shape[2], 1e-3, {}));
  meet(manifolds[1], 0, 1, contact_of(bodies.shape[0], bodies.shape[1], 1e-3, {}));
  meet(manifolds[2], -1, 0, contact_of(HalfSpace{}, bodies.shape[0], 1e-3));
  Sinking sinking;
  CHECK(sinking.below(bodies, manifolds, 2, 0, bodies.shape[0].centre) == Approx(1e-4));
  CHECK(sinking.below(bodies, manifolds, 2, 1, bodies.shape[1].centre) == Approx(3e-4));
  CHECK(sinking.below(bodies, manifolds, 2, 2, bodies.shape[2].centre) == Approx(3e-4));
  CHECK(sinking.below(bodies, manifolds, 2, 3, bodies.shape[3].centre) == 0.0);
  CHECK(sinking.below(bodies, manifolds, 0, 1, bodies.shape[1].centre) == 0.0);
}

TEST_CASE("sinking: a box that a hit has lifted off what still carries it is raised", "[core][sinking]") {
  const Settings settings = open_floor(kFriction);
  const Layout layout = layout_of({box({5, 5, 5e-5}, {1, 1, 1})});
  const Acceleration acceleration = constant(0, 1);
  const Acceleration* const accelerations[] = {&acceleration};
  const WorldBatch batch = batch_of(std::span(&layout, 1), accelerations, settings);
  const Bodies bodies = bodies_of(batch, batch.worlds[0]);
  std::vector<Manifold> manifolds(1);
  manifolds[0].a = -1;
  update_contact(manifolds[0], contact_of(HalfSpace{}, bodies.shape[0], 1e-3), bodies);
  Sinking sinking;
  CHECK(sinking.below(bodies, manifolds, 2, 0, bodies.shape[0].centre) == 0.0);
  manifolds[0].cached[2].force = {0, 0, 1};
  sinking.forget();
  CHECK(sinking.below(bodies, manifolds, 2, 0, bodies.shape[0].centre) == Approx(-5e-5));
}

}  // namespace sinking_test
