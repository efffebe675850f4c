// Bullet's OpenCL pipeline as an engine. Without a device every case says why it is skipped, and passes.

#include <cmath>

#include "scenes.hpp"

using namespace holdfast;
using namespace holdfast::scenes;

namespace {

/// The engine, or null with the reason printed.
std::unique_ptr<Engine> opencl_engine(const Settings& settings) {
  Result<std::unique_ptr<Engine>> engine = make_engine("bullet-opencl", settings);
  if (engine) return std::move(*engine);
  WARN("skipped: " << engine.error().message());
  return nullptr;
}

/// How far a box slides from rest under a constant acceleration by symplectic Euler in steps of h, m.
double slide(double acceleration, double friction, double time, double h) {
  const double rest = std::max(0.0, acceleration - friction * kGravity);
  return 0.5 * rest * time * time * (1.0 + h / time);
}

}  // namespace

TEST_CASE("opencl_engine: a box slides by Coulomb's law, whatever its friction", "[parallel][opencl_engine]") {
  for (const double friction : {0.2, 0.5, 0.7}) {
    const Settings settings = open_floor(friction);
    const auto engine = opencl_engine(settings);
    if (!engine) return;
    const Layout layout = layout_of({box({15, 10, 0}, {0.5, 0.5, 0.5})});
    const Motion motion = constant(friction * kGravity + 2.0, 1.0);
    const double moved = -run(*engine, layout, motion, settings).displacement().x();
    const double expected = slide(friction * kGravity + 2.0, friction, 1.0, 1.0 / 240);
    CAPTURE(friction, moved, expected);
    CHECK(std::abs(moved - expected) < 0.5e-3);
  }
}

TEST_CASE("opencl_engine: worlds of one batch feel their own accelerations", "[parallel][opencl_engine]") {
  const Settings settings = open_floor(0.3);
  const auto engine = opencl_engine(settings);
  if (!engine) return;
  CHECK(engine->traits().all_together);
  const Layout layout = layout_of({box({15, 10, 0}, {0.5, 0.5, 0.5})});
  // Phases that end at different times, none at a multiple of the step.
  std::vector<Motion> motions;
  for (int i = 0; i < 12; ++i) motions.push_back(motion_of({{0.8 + 0.0137 * i, Vec3(2.0 + 0.4 * i, 0, 0)}}));
  std::vector<const Motion*> pointers;
  for (const Motion& motion : motions) pointers.push_back(&motion);
  const std::vector<Run> runs = run_all(*engine, std::span(&layout, 1), pointers, settings);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const double time = motions[i].end_time();
    const double step = time / std::ceil(time * 240);
    const double expected = slide(motions[i].segments[0].acceleration.x(), 0.3, time, step);
    const double moved = -runs[i].displacement().x();
    CAPTURE(i, moved, expected);
    CHECK(std::abs(moved - expected) < 0.5e-3);
    CHECK(runs[i].record.outcome.end_time == time);
    CHECK(runs[i].record.outcome.status == Status::ok);
  }
}

TEST_CASE("opencl_engine: a world's result is the same alone and in company", "[parallel][opencl_engine]") {
  const Settings settings = open_floor(0.4);
  const auto engine = opencl_engine(settings);
  if (!engine) return;
  const Layout layouts[] = {stack(3, {10, 10, 0}, {0.6, 0.5, 0.4}), stack(2, {5, 5, 0}, {0.3, 0.5, 0.4})};
  const Motion push = constant(3.0, 0.5);
  const Motion pull = constant(-5.0, 0.3);
  const Motion* const both[] = {&push, &pull};
  const std::vector<Run> together = run_all(*engine, layouts, both, settings);
  REQUIRE(together.size() == 4);
  CHECK(run(*engine, layouts[0], push, settings).record.state_hash == together[0].record.state_hash);
  CHECK(run(*engine, layouts[1], pull, settings).record.state_hash == together[3].record.state_hash);
}

TEST_CASE("opencl_engine: a stack of ten sinks by millimetres and stands", "[parallel][opencl_engine]") {
  const Settings settings = open_floor(0.5);
  const auto engine = opencl_engine(settings);
  if (!engine) return;
  const Run tower = run(*engine, stack(10, {10, 10, 0}, {0.5, 0.5, 0.3}), constant(0.0, 2.0), settings);
  double largest = 0.0;
  for (std::size_t i = 0; i < 10; ++i) largest = std::max(largest, tower.displacement(i).norm());
  CAPTURE(largest);
  CHECK(largest < 8e-3);
}

TEST_CASE("opencl_engine: materials have their own friction and restitution", "[parallel][opencl_engine]") {
  Settings settings;
  settings.container.size = {20, 20, 10};
  settings.container.friction = 1.0;
  settings.materials[1].friction = 0.2;
  settings.materials[2].friction = 0.6;
  settings.materials[3].restitution = 0.5;
  const auto engine = opencl_engine(settings);
  if (!engine) return;
  const Layout layout = layout_of({box({10, 5, 0}, {0.5, 0.5, 0.5}, 1), box({10, 10, 0}, {0.5, 0.5, 0.5}, 2),
                                   box({3, 15, 1.0}, {0.5, 0.5, 0.5}, 3)});
  const Run all = run(*engine, layout, constant(4.0, 0.6), settings);
  CHECK(-all.displacement(0).x() == Approx(slide(4.0, 0.2, 0.6, 1.0 / 240)).margin(1e-3));
  CHECK(std::abs(all.displacement(1).x()) < 1e-3);
  // From a metre: down in 0.4515 s, up again at half the speed of impact.
  const double since = 0.6 - std::sqrt(2.0 / kGravity);
  const double up = 0.5 * std::sqrt(2.0 * kGravity) * since - 0.5 * kGravity * since * since;
  CAPTURE(all.displacement(2).z() + 1.0, up);
  CHECK(std::abs(all.displacement(2).z() + 1.0 - up) < 0.02);
}

TEST_CASE("opencl_engine: a free container is refused", "[parallel][opencl_engine]") {
  if (!opencl_engine({})) return;
  Settings settings;
  settings.container.motion = ContainerMotion::free;
  const Result<std::unique_ptr<Engine>> engine = make_engine("bullet-opencl", settings);
  REQUIRE_FALSE(engine);
  CHECK(engine.error().message() ==
        "bullet-opencl has no free container; Motion = prescribed in [Container], or another engine");
}

TEST_CASE("opencl_engine: a device that is not there is named", "[parallel][opencl_engine]") {
  if (!opencl_engine({})) return;
  Settings settings;
  settings.opencl.device = "abacus";
  const Result<std::unique_ptr<Engine>> engine = make_engine("bullet-opencl", settings);
  REQUIRE_FALSE(engine);
  CHECK(engine.error().what == "no OpenCL device of this name");
  CHECK(engine.error().value == "abacus");
}

TEST_CASE("opencl_engine: a batch beyond the room for pairs fails, and the next one runs",
          "[parallel][opencl_engine]") {
  const Settings settings = open_floor(0.5);
  const auto engine = opencl_engine(settings);
  if (!engine) return;
  // All in one place: 80,000 pairs, where 4,096 bodies have room for 65,536.
  const Layout heap = layout_of(std::vector<Box>(400, box({10, 10, 1}, {0.5, 0.5, 0.5})));
  const Run lost = run(*engine, heap, constant(0.0, 0.1), settings);
  CHECK(lost.record.outcome.stop_reason == StopReason::failed);
  CHECK(has(lost.record.outcome.status, Status::capacity));
  const Run next = run(*engine, stack(1, {10, 10, 0}, {0.5, 0.5, 0.5}), constant(0.0, 0.1), settings);
  CHECK(next.record.outcome.status == Status::ok);
  CHECK(next.displacement().norm() < 1e-4);
}
