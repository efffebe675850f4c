// What impacts do to boxes, against exact velocities.

#include <cmath>

#include "analyses/damage/damage.hpp"
#include "core/native/native_scenes.hpp"
#include "physics/measures.hpp"

namespace damage_test {

using namespace holdfast::internal;
using namespace holdfast::internal::native_scenes;
using namespace holdfast::internal::scenes;
using namespace holdfast::internal::physics;

namespace {

constexpr double kWindow = 0.02;
constexpr double kBraking = 5.0;

/// An engine, and how exact it is.
struct Measured {
  const char* engine;
  Accuracy accuracy;
  double tolerance;  ///< relative
};
/// Bullet pushes a box out of the wall that it has sunk into, which adds 12 % to the velocity change.
constexpr Measured kEngines[] = {{"native", Accuracy::screening, 1e-3}, {"native", Accuracy::standard, 1e-3},
                                 {"native", Accuracy::reference, 1e-3}, {"native-plain", Accuracy::standard, 0.03},
                                 {"bullet", Accuracy::standard, 0.14},  {"bullet-f64", Accuracy::standard, 0.14}};

Settings settings_of(const Measured& measured, double friction) {
  Settings settings = with(measured.accuracy, open_floor(friction));
  settings.screening.damage = true;
  settings.screening.damage_window = kWindow;
  return settings;
}

/// What was found; the run was asked for it.
const WorldDamage& damage(const Run& run) { return *run.record.found.get<WorldDamage>(); }

double peak(const Run& run, std::size_t box = 0) { return static_cast<double>(damage(run).peak_acceleration.at(box)); }
double change(const Run& run, std::size_t box = 0) { return static_cast<double>(damage(run).velocity_change.at(box)); }

/// A box of 1 m x 1 m x 0.4 m, at a distance from the front wall, m.
Layout at(double gap) { return layout_of({box({gap, 5, 0}, {1, 1, 0.4})}); }

}  // namespace

TEST_CASE("damage: a box that slides into a wall without rebound takes over its speed", "[physics][damage]") {
  for (const Measured& measured : kEngines) {
    const double gap = 0.1;
    const double speed = std::sqrt(2.0 * kBraking * gap);  // of the wall when it reaches the box, which stands still
    const Run run = scenes::run(measured.engine, at(gap), constant(kBraking, 0.5), settings_of(measured, 0.0));
    CAPTURE(measured.engine, static_cast<int>(measured.accuracy), text(change(run) / speed - 1.0),
            text(peak(run) * kWindow / speed - 1.0));
    // The step of the impact adds what the wall gains in it.
    const double step = measured.accuracy == Accuracy::screening ? 1.0 / 60 : 1.0 / 240;
    CHECK(change(run) > (1.0 - measured.tolerance) * speed);
    CHECK(change(run) < (1.0 + measured.tolerance) * speed + kBraking * step);
    CHECK(peak(run) > (1.0 - measured.tolerance) * speed / kWindow);
    CHECK(peak(run) < (1.0 + measured.tolerance) * speed / kWindow + kBraking);
  }
}

TEST_CASE("damage: a box that rebounds fully changes its velocity by twice the speed", "[physics][damage]") {
  const Measured native = {"native", Accuracy::standard, 1e-3};
  Settings settings = settings_of(native, 0.0);
  settings.contact.restitution = 1.0;
  const double speed = std::sqrt(2.0 * kBraking * 0.1);
  const Run run = native_run(at(0.1), constant(kBraking, 0.3), settings);
  CHECK(change(run) == Approx(2.0 * speed).epsilon(0.02));
}

TEST_CASE("damage: a box that the container carries has its acceleration, and no impact", "[physics][damage]") {
  for (const Measured& measured : kEngines) {
    const Run run = scenes::run(measured.engine, at(2.0), constant(3.0, 0.5), settings_of(measured, 0.6));
    CAPTURE(measured.engine, text(peak(run)));
    CHECK(peak(run) == Approx(3.0).epsilon(measured.engine[0] == 'b' ? 0.05 : 1e-5));
    CHECK(change(run) == 0.0);
  }
}

TEST_CASE("damage: a box that nothing holds is not accelerated", "[physics][damage]") {
  for (const Measured& measured : kEngines) {
    const Run run = scenes::run(measured.engine, at(4.0), constant(kBraking, 0.5), settings_of(measured, 0.0));
    CAPTURE(measured.engine, text(peak(run)));
    CHECK(peak(run) < 0.01 * kBraking);
    CHECK(change(run) == 0.0);
  }
}

TEST_CASE("damage: a box that falls stops with the velocity of its fall", "[physics][damage]") {
  const double height = 1.0;
  const double speed = std::sqrt(2.0 * kGravity * height);
  for (const Measured& measured : kEngines) {
    Settings settings = settings_of(measured, 0.5);
    settings.screening.critical_acceleration = 15.0;
    settings.screening.critical_velocity_change = 4.0;
    const Run run =
        scenes::run(measured.engine, layout_of({box({4, 5, height}, {1, 1, 0.4}), box({6, 5, 0}, {1, 1, 1})}),
                    constant(0, 1), settings);
    CAPTURE(measured.engine, static_cast<int>(measured.accuracy), text(change(run) / speed - 1.0), text(peak(run)));
    CHECK(change(run) == Approx(speed).epsilon(measured.tolerance + 0.01));
    CHECK(peak(run) == Approx(speed / kWindow).epsilon(0.06));
    // 22 g and 4.4 m/s; the other box does not move.
    CHECK(damage(run).boxes_beyond == 1);
    CHECK(damage(run).beyond == std::vector<std::uint8_t>{1, 0});
    CHECK(change(run, 1) == 0.0);
  }
}

TEST_CASE("damage: recording changes no bit", "[physics][damage][slow]") {
  const Layout layout = bundled_layout("BR5_020_layer_h60", Settings{});
  for (const char* engine : {"native", "bullet"}) {
    Settings settings = with(Accuracy::screening, Settings{});
    const Acceleration acceleration = constant(9, 0.4);
    const Run without = run(engine, layout, acceleration, settings);
    settings.screening.damage = true;
    const Run with_damage = run(engine, layout, acceleration, settings);
    CHECK(without.record.row.state_hash == with_damage.record.row.state_hash);
    CHECK(without.record.found.get<WorldDamage>() == nullptr);
    CHECK(damage(with_damage).beyond.size() == layout.boxes.size());
  }
}

}  // namespace damage_test
