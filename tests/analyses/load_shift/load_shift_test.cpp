#include "analyses/load_shift/load_shift.hpp"

#include "core/native/native_scenes.hpp"
#include "physics/measures.hpp"

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
  // The lower box is three times as heavy, and rests; the upper one slides on it to one side, and back by as much.
  Layout layout = layout_of({box({4, 5, 0}, {2, 1, 0.6}), box({4.8, 5, 0.6}, {0.8, 0.5, 1.0})});
  const Run run = scenes::run("native", layout, constant(2.0, 0.4), measured(open_floor(0.5)));
  Vec3 expected = Vec3::Zero();
  double mass = 0.0;
  for (std::size_t i = 0; i < layout.boxes.size(); ++i) {
    const Vec3 size = layout.boxes[i].corner_max - layout.boxes[i].corner_min;
    expected += size.prod() * run.displacement(i);
    mass += size.prod();
  }
  CHECK((shift_of(run).end - expected / mass).norm() < 1e-6);
  CHECK(shift_of(run).peak.norm() >= shift_of(run).end.norm());
}

TEST_CASE("load_shift: a load that rests does not shift, and nothing is known where it was not asked for",
          "[load_shift]") {
  const Layout layout = layout_of({box({3, 5, 0}, {1, 1, 0.4})});
  const LoadShift rest = shift_of(scenes::run("native", layout, constant(1.0, 0.5), measured(open_floor(0.5))));
  CHECK(rest.peak.norm() == 0.0);
  CHECK(rest.peak_time == 0.0);
  CHECK(std::isnan(shift_of(scenes::run("native", layout, constant(1.0, 0.5), open_floor(0.5))).peak_time));
}
