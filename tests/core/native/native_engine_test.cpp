// Known answers for the native engine.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/native/native_scenes.hpp"
#include "physics/measures.hpp"

namespace native_engine_test {

using namespace holdfast::internal;
using namespace holdfast::internal::scenes;
using namespace holdfast::internal::native_scenes;
using namespace holdfast::internal::physics;

namespace {

const Vec3 kTall(0.5, 0.5, 1.0);  ///< a box that tips and does not slide on high friction, m

/// True when every box is where it was, to the last bit.
bool stayed(const Run& run) {
  for (std::size_t i = 0; i < run.start.size(); ++i) {
    if (run.state.position[i] != run.start[i] || run.state.velocity[i] != Vec3::Zero() ||
        run.state.angular_velocity[i] != Vec3::Zero() ||
        run.state.orientation[i].coeffs() != Rotation::Identity().coeffs())
      return false;
  }
  return true;
}

double largest_displacement(const Run& run) {
  double largest = 0.0;
  for (std::size_t i = 0; i < run.start.size(); ++i) largest = std::max(largest, run.displacement(i).norm());
  return largest;
}

double tilt_of(const Run& run, std::size_t i = 0) {
  return 2.0 * std::asin(std::min(1.0, Vec3(run.state.orientation[i].vec()).norm()));
}

}  // namespace

TEST_CASE("native_engine: a box slides at a - mu g, in every direction", "[core][native_engine]") {
  const double limit = 0.5 * kGravity;
  for (const auto& [accuracy, bound] : {std::pair(Accuracy::standard, 1e-6), std::pair(Accuracy::reference, 1e-9)}) {
    for (const Vec3& heading : {Vec3(1, 0, 0), Vec3(0, -1, 0), Vec3(0.6, 0.8, 0)}) {
      const Run slide =
          native_run(one_box(kFlat), acceleration_of({{1, 1.5 * limit * heading}}), with(accuracy, open_floor(0.5)));
      const double error = (slide.displacement() + 0.25 * limit * heading).norm() / (0.25 * limit);
      CAPTURE(static_cast<int>(accuracy), heading.transpose(), text(error));
      CHECK(error < bound);
      CHECK((slide.state.velocity[0] + 0.5 * limit * heading).norm() < bound * limit);
    }
  }
}

TEST_CASE("native_engine: sliding begins at mu g, below it nothing moves at all", "[core][native_engine]") {
  const double limit = 0.5 * kGravity;
  for (const auto& [accuracy, off] : {std::pair(Accuracy::standard, 1e-3), std::pair(Accuracy::reference, 1e-3),
                                      std::pair(Accuracy::reference, 1e-6)}) {
    const Settings settings = with(accuracy, open_floor(0.5));
    const Run below = native_run(one_box(kFlat), constant((1 - off) * limit, 2), settings);
    const Run above = native_run(one_box(kFlat), constant((1 + off) * limit, 2), settings);
    const double path = -0.5 * off * limit * 4;
    CAPTURE(static_cast<int>(accuracy), off, text(largest_displacement(below)),
            text(above.displacement().x() / path - 1));
    CHECK(stayed(below));
    CHECK(above.displacement().x() == Approx(path).epsilon(1e-4));
  }
}

TEST_CASE("native_engine: tipping begins at g l/h and grows as a pendulum falls", "[core][native_engine]") {
  const double limit = 0.5 * kGravity;
  for (const auto& [accuracy, off, bound] :
       {std::tuple(Accuracy::standard, 1e-3, 5e-3), std::tuple(Accuracy::reference, 1e-3, 1e-3),
        std::tuple(Accuracy::reference, 1e-6, 1e-3)}) {
    const Settings settings = with(accuracy, open_floor(1.0));
    const Run below = native_run(one_box(kTall), constant((1 - off) * limit, 3), settings);
    const Run above = native_run(one_box(kTall), constant((1 + off) * limit, 1), settings);
    // About the edge, to first order: θ'' = 3 g / (2 h) (θ + off · l h / (l² + h²)).
    const double rate = std::sqrt(1.5 * kGravity / kTall.z());
    const double tilt = off * 0.5 / 1.25 * (std::cosh(rate) - 1);
    CAPTURE(static_cast<int>(accuracy), off, text(largest_displacement(below)), text(tilt_of(above)),
            text(tilt_of(above) / tilt - 1));
    CHECK(stayed(below));
    CHECK(tilt_of(above) == Approx(tilt).epsilon(bound));
  }
}

TEST_CASE("native_engine: an offset centre of mass tips at g x/z", "[core][native_engine]") {
  Settings settings = open_floor(2.0);
  settings.materials[1].centre_of_mass = {0.1, 0, -0.2};
  for (const Accuracy accuracy : {Accuracy::standard, Accuracy::reference}) {
    settings.native.accuracy = accuracy;
    // It lies 0.3 m up, 0.35 m behind the front edge and 0.15 m before the rear edge.
    for (const double limit : {kGravity * 0.35 / 0.3, -kGravity * 0.15 / 0.3}) {
      const Run below = native_run(one_box(kTall), constant(0.999 * limit, 2), settings);
      const Run above = native_run(one_box(kTall), constant(1.001 * limit, 2), settings);
      CAPTURE(limit, text(largest_displacement(below)), above.record.end.peak_displacement[0]);
      CHECK(stayed(below));
      CHECK(above.record.end.peak_displacement[0] > 0.02F);
    }
  }
}

TEST_CASE("native_engine: a stack of ten stays below its limit and slides above it", "[core][native_engine]") {
  Settings settings = open_floor(0.4);
  settings.contact.box_box = 0.8;
  const double limit = 0.4 * kGravity;
  const Layout layout = stack(10, {10, 10, 0}, {1, 1, 0.2});
  for (const double share : {0.0, 0.95, 0.999}) {
    for (const Accuracy accuracy : {Accuracy::standard, Accuracy::reference}) {
      settings.native.accuracy = accuracy;
      const Run below = native_run(layout, constant(share * limit, 1), settings);
      CAPTURE(static_cast<int>(accuracy), share, text(largest_displacement(below)));
      CHECK(stayed(below));
      CHECK(below.record.row.status == Status::ok);
    }
  }
  // The stack goes as one: only its lowest box slides.
  const double over = 0.2;
  for (const auto& [accuracy, bound] : {std::pair(Accuracy::standard, 1e-4), std::pair(Accuracy::reference, 1e-6)}) {
    settings.native.accuracy = accuracy;
    const Run above = native_run(layout, constant((1 + over) * limit, 0.5), settings);
    double worst = 0.0;
    const double path = 0.5 * over * limit * 0.25;
    for (std::size_t i = 0; i < 10; ++i)
      worst = std::max(worst, (above.displacement(i) + Vec3(path, 0, 0)).norm() / path);
    CAPTURE(static_cast<int>(accuracy), text(worst));
    CHECK(worst < bound);
  }
}

TEST_CASE("native_engine: free fall is exact", "[core][native_engine]") {
  const Layout layout = layout_of({box({1.237, 0.791, 1.5}, {0.613, 0.447, 0.379})});
  for (const Accuracy accuracy : {Accuracy::screening, Accuracy::standard, Accuracy::reference}) {
    Settings settings = at_once();
    settings.native.accuracy = accuracy;
    const Run fall = native_run(layout, constant(1.5, 0.5), settings);
    CHECK(fall.displacement().z() == Approx(-0.5 * kGravity * 0.25).epsilon(1e-12));
    CHECK(fall.displacement().x() == Approx(-0.5 * 1.5 * 0.25).epsilon(1e-12));
    CHECK(fall.state.velocity[0].z() == Approx(-0.5 * kGravity).epsilon(1e-12));
    CHECK(tilt_of(fall) == 0.0);
  }
}

TEST_CASE("native_engine: friction of a pair is the product of its materials", "[core][native_engine]") {
  Settings settings = open_floor(0.0);
  settings.contact.friction_model = FrictionModel::product;
  settings.container.friction = 0.8;
  settings.materials[1].friction = 0.5;
  settings.materials[2].friction = 1.2;
  settings.materials[2].mass = 1e5;
  for (const auto& [accuracy, bound] : {std::pair(Accuracy::standard, 1e-4), std::pair(Accuracy::reference, 1e-7)}) {
    settings.native.accuracy = accuracy;
    // 0.5 · 0.8 of a box on the floor; 0.5 · 1.2 of the same box on one that holds.
    const Layout layout =
        layout_of({box({5, 5, 0}, kFlat, 1), box({10, 10, 0}, {3, 3, 0.4}, 2), box({11, 11, 0.4}, {1, 1, 0.2}, 1)});
    const Run run = native_run(layout, constant(0.7 * kGravity, 0.5), settings);
    const double on_floor = 0.125 * kGravity * (0.7 - 0.4);
    const double on_box = 0.125 * kGravity * (0.7 - 0.6);
    CAPTURE(static_cast<int>(accuracy), text(-run.displacement(0).x() / on_floor - 1),
            text(-run.displacement(2).x() / on_box - 1));
    CHECK(run.displacement(0).x() == Approx(-on_floor).epsilon(bound));
    CHECK(run.displacement(1).norm() < 1e-3 * bound * on_box);
    CHECK(run.displacement(2).x() == Approx(-on_box).epsilon(bound));
  }
}

TEST_CASE("native_engine: a frictionless wall stops what is across it, and lets it slide along",
          "[core][native_engine]") {
  const Layout layout = layout_of({box({0.2, 10, 0}, kFlat)});
  for (const auto& [accuracy, bound] : {std::pair(Accuracy::standard, 1e-5), std::pair(Accuracy::reference, 1e-6)}) {
    const Run run = native_run(layout, acceleration_of({{1, Vec3(2, -1, 0)}}), with(accuracy, open_floor(0.0)));
    CAPTURE(static_cast<int>(accuracy), run.displacement().transpose());
    CHECK(run.displacement().x() == Approx(-0.2).margin(1e-5));
    CHECK(run.displacement().y() == Approx(0.5).margin(bound));
    CHECK(std::abs(run.displacement().z()) < 1e-5);
    // Friction of the wall alone holds with mu times the push. It acts off the centre of mass, at the wall, and the
    // floor takes no part.
    Settings rough = with(accuracy, open_floor(0.0));
    rough.contact.box_wall = 0.3;
    const Run along = native_run(layout_of({box({0, 10, 0}, kFlat)}), acceleration_of({{1, Vec3(8, -4, 0)}}), rough);
    CAPTURE(along.displacement().transpose());
    CHECK(along.displacement().y() == Approx(0.5 * (4 - 0.3 * 8)).epsilon(10 * bound));
  }
}

TEST_CASE("native_engine: a fixed box holds others and never moves", "[core][native_engine]") {
  const Layout layout = layout_of(
      {box({5, 5, 0}, {1, 1, 1}), box({6, 5, 0}, {1, 1, 1}), box({5, 5, 1}, {1, 1, 1}), box({7.2, 5, 0}, {1, 1, 1})});
  for (const Accuracy accuracy : {Accuracy::standard, Accuracy::reference}) {
    const Settings settings = with(accuracy, open_floor(0.5));
    bool fixed_moved = false, others_moved = false;
    double last = 0.0;
    // Against the acceleration the fourth box slides by 0.2 m, into the second, which leans on the first.
    watch(
        NativeEngine(settings), layout, constant(6, 1.5), settings,
        [](WorldBatch& batch) {
          fix(batch, 0);
          batch.boxes.surface[3].friction = 0.0;
        },
        [&](const WorldBatch& batch, const Phase&) {
          fixed_moved = fixed_moved || batch.state.position[0] != Vec3(5.5, 5.5, 0.5);
          others_moved = others_moved || (batch.state.position[1] - Vec3(6.5, 5.5, 0.5)).norm() > 1e-5;
          last = batch.state.position[3].x();
        });
    CAPTURE(static_cast<int>(accuracy), text(last));
    CHECK_FALSE(fixed_moved);
    CHECK_FALSE(others_moved);
    CHECK(last == Approx(7.5).margin(1e-5));
  }
}

TEST_CASE("native_engine: a box that spins freely keeps its angular momentum and energy", "[core][native_engine]") {
  for (const auto& [accuracy, bound] : {std::pair(Accuracy::standard, 1e-4), std::pair(Accuracy::reference, 1e-5)}) {
    Settings settings = with(accuracy, open_floor(0.5));
    settings.gravity = 0.0;
    const Vec3 spin(1, 0.1, 5);
    Eigen::Vector3d momentum = Vec3::Zero();
    double energy = 0.0, momentum_error = 0.0, energy_error = 0.0;
    watch(
        NativeEngine(settings), layout_of({box({10, 10, 5}, {0.3, 0.9, 0.5})}), constant(0, 2), settings,
        [&](WorldBatch& batch) {
          batch.state.angular_velocity[0] = spin;
          momentum = inertia_of(batch, 0) * spin;
          energy = energy_of(batch, Vec3::Zero());
        },
        [&](const WorldBatch& batch, const Phase&) {
          const Vec3 now = inertia_of(batch, 0) * batch.state.angular_velocity[0];
          momentum_error = std::max(momentum_error, (now - momentum).norm() / momentum.norm());
          energy_error = std::max(energy_error, std::abs(energy_of(batch, Vec3::Zero()) / energy - 1));
        });
    CAPTURE(static_cast<int>(accuracy), text(momentum_error), text(energy_error));
    CHECK(momentum_error < 1e-11);
    CHECK(energy_error < bound);
  }
}

TEST_CASE("native_engine: a curve of samples far shorter than a step takes hardly more steps than its time",
          "[core][native_engine]") {
  const double frequency = 2.0 * std::numbers::pi, strength = 3.0;
  std::vector<std::pair<double, Vec3>> samples;
  for (int i = 0; i < 1000; ++i)
    samples.emplace_back(1e-3, Vec3(0, strength * std::sin(frequency * 1e-3 * (i + 0.5)), 0));
  const Settings settings = with(Accuracy::screening, open_floor(0.0));
  const Run run = native_run(one_box(kFlat), acceleration_of(samples), settings);
  // 16 whole samples fit into a step.
  CHECK(run.record.row.steps == 63);
  CHECK(run.displacement().y() == Approx(-strength / frequency).epsilon(1e-3));
}

TEST_CASE("native_engine: steps follow the settings, and never straddle a change of the acceleration",
          "[core][native_engine]") {
  const Acceleration pulse = acceleration_of({{0.1003, Vec3(0, 0, 0)}, {0.4004, Vec3(3, 0, 0)}, {0.3, Vec3(0, 0, 0)}});
  const Run run = native_run(one_box(kFlat), pulse, open_floor(0.0));
  CHECK(run.state.velocity[0].x() == Approx(-3 * 0.4004).epsilon(1e-6));
  CHECK(run.displacement().x() == Approx(-3 * 0.4004 * (0.2002 + 0.3)).epsilon(1e-6));
  CHECK(run.record.row.steps == 25 + 97 + 72);
  // At rest until the pulse.
  CHECK(run.record.row.steps_skipped == 25);
}

}  // namespace native_engine_test
