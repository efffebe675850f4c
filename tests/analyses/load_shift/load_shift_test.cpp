#include "analyses/load_shift/load_shift.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include "analyses/load_shift/load_shift_recorder.hpp"
#include "core/native/native_scenes.hpp"
#include "physics/measures.hpp"

namespace load_shift_test {

using namespace holdfast::internal;
using namespace holdfast::internal::native_scenes;
using namespace holdfast::internal::scenes;

namespace {

Settings measured(Settings settings) {
  settings.screening.load_shift = true;
  return settings;
}

LoadShift shift_of(const Run& run) { return run.record.found.value<LoadShift>(); }

}  // namespace

TEST_CASE("load_shift: a box that slides alone is the load", "[load_shift]") {
  const Layout layout = layout_of({box({3, 5, 0}, {1, 1, 0.4})});
  const Run run = scenes::run("native", layout, constant(-5.0, 0.5), measured(open_floor(0.2)));
  const LoadShift shift = shift_of(run);
  CHECK((shift.end - run.displacement()).norm() < 1e-6);
  CHECK(shift.end.x() == Approx(0.5 * (5.0 - 0.2 * kGravity) * 0.25).epsilon(1e-3));
  CHECK((shift.peak - shift.end).norm() == 0.0);
  CHECK(shift.peak_time == Approx(0.5));
}

TEST_CASE("load_shift: boxes count by their masses, and what comes back has been away", "[load_shift]") {
  // The lower box rests; the upper one, which has a quarter of the mass, slides on it to one side and back again.
  const Layout layout = layout_of({box({4, 5, 0}, {2, 1, 0.6}), box({4.6, 5.2, 0.6}, {0.8, 0.5, 1.0})});
  Settings settings = measured(open_floor(0.5));
  settings.contact.friction_model = FrictionModel::pairs;
  settings.contact.box_box = 0.05;
  settings.contact.box_floor = 0.5;
  Acceleration there_and_back{.name = "there and back"};
  there_and_back.segments = {{0.0, 0.4, {1.5, 0, 0}}, {0.4, 0.7, {-1.5, 0, 0}}};
  const Run run = scenes::run("native", layout, there_and_back, settings);
  const LoadShift shift = shift_of(run);
  // It leaves with 1.5 − 0.05 g for 0.4 s, and comes to a stop under 1.5 + 0.05 g.
  const double away = 1.5 - 0.05 * kGravity;
  const double back = 1.5 + 0.05 * kGravity;
  const double speed = 0.4 * away;
  const double farthest = 0.5 * 0.4 * speed + speed * speed / (2.0 * back);
  CHECK(run.displacement(0).norm() < 1e-9);
  CHECK((shift.end - 0.25 * run.displacement(1)).norm() < 1e-6);
  CHECK(shift.end.norm() < 2e-3);
  CHECK(shift.peak.x() == Approx(-0.25 * farthest).epsilon(2e-3));
  CHECK(shift.peak_time == Approx(0.4 + speed / back).margin(1.0 / 60));
}

TEST_CASE("load_shift: boxes that are fixed to the container do not count", "[load_shift]") {
  const std::vector<double> mass = {std::numeric_limits<double>::infinity(), 2.0};
  const std::vector<Vec3> start = {Vec3(1, 0, 0), Vec3(0, 0, 0)};
  const std::vector<Vec3> end = {Vec3(1, 0, 0), Vec3(0, 3, 0)};
  const auto state = [](const std::vector<Vec3>& position) {
    return StateView{.position = position, .orientation = {}, .velocity = {}, .angular_velocity = {}};
  };
  BoxView boxes;
  boxes.mass = mass;
  LoadShiftRecorder recorder(boxes, state(start));
  recorder.step({.begin = 0.0, .end = 0.5, .after = state(end)});
  Findings found;
  recorder.finish(found);
  CHECK(found.value<LoadShift>().end == Vec3(0, 3, 0));
  CHECK(found.value<LoadShift>().peak_time == 0.5);
}

TEST_CASE("load_shift: a load that rests does not shift, and nothing is known where it was not asked for",
          "[load_shift]") {
  const Layout layout = layout_of({box({3, 5, 0}, {1, 1, 0.4})});
  const LoadShift rest = shift_of(scenes::run("native", layout, constant(1.0, 0.5), measured(open_floor(0.5))));
  CHECK(rest.peak.norm() == 0.0);
  CHECK(rest.peak_time == 0.0);
  CHECK(std::isnan(shift_of(scenes::run("native", layout, constant(1.0, 0.5), open_floor(0.5))).peak_time));
}

}  // namespace load_shift_test
