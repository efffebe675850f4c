// Bullet's OpenCL pipeline as an engine. Without a device every case says why it is skipped, and passes.

#include <cmath>

#include "core/engine/engine_support.hpp"
#include "scenes.hpp"

namespace opencl_engine_test {

using namespace holdfast::internal;
using namespace holdfast::internal::scenes;

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

TEST_CASE("opencl_engine: a box slides by Coulomb's law, whatever its friction", "[parallel][opencl_engine][slow]") {
  for (const double friction : {0.2, 0.5, 0.7}) {
    const Settings settings = open_floor(friction);
    const auto engine = opencl_engine(settings);
    if (!engine) return;
    const Layout layout = layout_of({box({15, 10, 0}, {0.5, 0.5, 0.5})});
    const Acceleration acceleration = constant(friction * kGravity + 2.0, 1.0);
    const double moved = -run(*engine, layout, acceleration, settings).displacement().x();
    const double expected = slide(friction * kGravity + 2.0, friction, 1.0, 1.0 / 240);
    CAPTURE(friction, moved, expected);
    CHECK(std::abs(moved - expected) < 0.5e-3);
  }
}

TEST_CASE("opencl_engine: floors end, and the ground has its own friction", "[parallel][opencl_engine][slow]") {
  Settings settings = open_floor(0.2);
  settings.container.size = {10, 4, 3};
  settings.container.open_sides = {"rear"};
  settings.box_friction = 0.8;
  settings.container.ground_friction = 0.5;
  const auto engine = opencl_engine(settings);
  if (!engine) return;
  const Vec3 size(0.6, 0.5, 0.4);
  const auto with_beyond = [&](double share) {
    return run(*engine, layout_of({box({10 - (1 - share) * size.x(), 1, 0}, size)}), constant(0, 2), settings);
  };
  CHECK(with_beyond(0.49).displacement().norm() < 2e-3);
  CHECK(with_beyond(0.51).displacement().z() < -1.0);
  // A plate that lies on the ground.
  const Layout beyond = layout_of({box({11, 1, -1.2}, {1, 1, 0.1})});
  const double moved = run(*engine, beyond, constant(-6.0, 1.0), settings).displacement().x();
  CHECK(moved == Approx(slide(6.0, 0.5 * 0.8, 1.0, 1.0 / 240)).epsilon(2e-3));
}

TEST_CASE("opencl_engine: worlds of one batch feel their own accelerations", "[parallel][opencl_engine]") {
  const Settings settings = open_floor(0.3);
  const auto engine = opencl_engine(settings);
  if (!engine) return;
  CHECK(engine->traits().all_together);
  const Layout layout = layout_of({box({15, 10, 0}, {0.5, 0.5, 0.5})});
  // Phases that end at different times, none at a multiple of the step.
  std::vector<Acceleration> accelerations;
  for (int i = 0; i < 12; ++i)
    accelerations.push_back(acceleration_of({{0.8 + 0.0137 * i, Vec3(2.0 + 0.4 * i, 0, 0)}}));
  std::vector<const Acceleration*> pointers;
  for (const Acceleration& acceleration : accelerations) pointers.push_back(&acceleration);
  const std::vector<Run> runs = run_all(*engine, std::span(&layout, 1), pointers, settings);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const double time = accelerations[i].end_time();
    const double step = time / std::ceil(time * 240);
    const double expected = slide(accelerations[i].segments[0].acceleration.x(), 0.3, time, step);
    const double moved = -runs[i].displacement().x();
    CAPTURE(i, moved, expected);
    CHECK(std::abs(moved - expected) < 0.5e-3);
    CHECK(runs[i].record.row.end_time == time);
    CHECK(runs[i].record.row.status == Status::ok);
  }
}

TEST_CASE("opencl_engine: a world's result is the same alone and in company", "[parallel][opencl_engine]") {
  const Settings settings = open_floor(0.4);
  const auto engine = opencl_engine(settings);
  if (!engine) return;
  const Layout layouts[] = {stack(3, {10, 10, 0}, {0.6, 0.5, 0.4}), stack(2, {5, 5, 0}, {0.3, 0.5, 0.4})};
  const Acceleration push = constant(3.0, 0.5);
  const Acceleration pull = constant(-5.0, 0.3);
  const Acceleration* const both[] = {&push, &pull};
  const std::vector<Run> together = run_all(*engine, layouts, both, settings);
  REQUIRE(together.size() == 4);
  CHECK(run(*engine, layouts[0], push, settings).record.row.state_hash == together[0].record.row.state_hash);
  CHECK(run(*engine, layouts[1], pull, settings).record.row.state_hash == together[3].record.row.state_hash);
}

TEST_CASE("opencl_engine: a stack of ten sinks by millimetres and stands", "[parallel][opencl_engine][slow]") {
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
  Settings settings = at_once();
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
  Settings settings = at_once();
  settings.container.motion = ContainerMotion::free;
  const Result<std::unique_ptr<Engine>> engine = make_engine("bullet-opencl", settings);
  REQUIRE_FALSE(engine);
  CHECK(engine.error().message() ==
        "bullet-opencl has no free container; Motion = prescribed in [Container], or another engine");
}

TEST_CASE("opencl_engine: pairs of materials and mats are refused", "[parallel][opencl_engine]") {
  Settings settings = at_once();
  const auto plain = opencl_engine(settings);
  if (!plain) return;
  settings.contact.friction_model = FrictionModel::pairs;
  settings.contact.materials.set(*parse_partners("pallet, carton"), 0.4);
  const Result<std::unique_ptr<Engine>> engine = make_engine("bullet-opencl", settings);
  REQUIRE_FALSE(engine);
  CHECK(engine.error().message() ==
        "bullet-opencl has no coefficients for pairs of materials: [Friction] carton, pallet; rows of any, floor and "
        "wall alone, or another engine");
  ReadLayout layout{.layout = layout_of({box({1, 1, 0}, {1, 1, 1})})};
  CHECK_FALSE(refuse_unsupported(layout, *plain, "one"));
  layout.layout.boxes[0].mat = 0.6;
  REQUIRE(refuse_unsupported(layout, *plain, "one"));
  CHECK(layout.error ==
        "one: a box stands on an anti-slip mat, which this engine cannot model: bullet-opencl; boxes without mats, or "
        "another engine, such as native");
}

TEST_CASE("opencl_engine: a device that is not there is named", "[parallel][opencl_engine]") {
  if (!opencl_engine({})) return;
  Settings settings = at_once();
  settings.opencl.device = "abacus";
  const Result<std::unique_ptr<Engine>> engine = make_engine("bullet-opencl", settings);
  REQUIRE_FALSE(engine);
  CHECK(engine.error().what == "no OpenCL device of this name");
  CHECK(engine.error().value == "abacus");
}

TEST_CASE("opencl_engine: a world's result is the same in a batch of more worlds than fit",
          "[parallel][opencl_engine]") {
  const Settings settings = open_floor(0.4);
  const auto engine = opencl_engine(settings);
  if (!engine) return;
  // Bullet's solver has 256 cells, each for a world: these take turns in two parts, from sample to sample.
  std::vector<Acceleration> accelerations;
  for (int i = 0; i < 300; ++i) accelerations.push_back(constant(3.0 + 0.02 * i, 0.25));
  std::vector<const Acceleration*> pointers;
  for (const Acceleration& acceleration : accelerations) pointers.push_back(&acceleration);
  const Layout layout = stack(2, {10, 10, 0}, {0.6, 0.5, 0.4});
  const std::vector<Run> runs = run_all(*engine, std::span(&layout, 1), pointers, settings);
  REQUIRE(runs.size() == 300);
  for (const Run& each : runs) CHECK(each.record.row.status == Status::ok);
  for (const std::size_t world : {0U, 44U, 255U, 256U, 299U}) {
    CAPTURE(world);
    CHECK(run(*engine, layout, accelerations[world], settings).record.row.state_hash ==
          runs[world].record.row.state_hash);
  }
}

TEST_CASE("opencl_engine: worlds that overflow the room for pairs together are stepped in smaller parts",
          "[parallel][opencl_engine]") {
  const Settings settings = open_floor(0.4);
  const auto engine = opencl_engine(settings);
  if (!engine) return;
  // Rods side by side across the axes: all bounding boxes overlap, 1,830 pairs a world. Of 40 worlds that makes 73,200,
  // where 4,096 bodies have room for 65,536.
  constexpr int kRods = 60;
  Layout rods = layout_of({});
  for (int i = 0; i < kRods; ++i) rods.boxes.push_back(box({8, 8 + 0.04 * i, 0}, {4, 0.02, 0.02}));
  const auto across = [](StateColumns& state) {
    for (Rotation& rotation : state.orientation) rotation = Eigen::AngleAxisd(std::atan(1.0), Vec3::UnitZ());
  };
  std::vector<Acceleration> accelerations;
  for (int i = 0; i < 40; ++i) accelerations.push_back(constant(6.0 + 0.05 * i, 0.05));
  std::vector<const Acceleration*> pointers;
  for (const Acceleration& acceleration : accelerations) pointers.push_back(&acceleration);
  const std::vector<Run> runs = run_all(*engine, std::span(&rods, 1), pointers, settings, across);
  for (const std::size_t world : {0U, 19U, 20U, 39U}) {
    CAPTURE(world, runs[world].displacement().x());
    CHECK(runs[world].record.row.status == Status::ok);
    const double expected = slide(accelerations[world].segments[0].acceleration.x(), 0.4, 0.05, 1.0 / 240);
    CHECK(-runs[world].displacement().x() == Approx(expected).margin(1e-4));
    const Run alone = run(*engine, rods, accelerations[world], settings, across);
    CHECK(alone.record.row.state_hash == runs[world].record.row.state_hash);
  }
}

TEST_CASE("opencl_engine: a world beyond the room for pairs fails alone, and the next batch runs",
          "[parallel][opencl_engine]") {
  const Settings settings = open_floor(0.5);
  const auto engine = opencl_engine(settings);
  if (!engine) return;
  // All in one place: 80,000 pairs, where 4,096 bodies have room for 65,536.
  const Layout layouts[] = {stack(1, {10, 10, 0}, {0.5, 0.5, 0.5}),
                            layout_of(std::vector<Box>(400, box({10, 10, 1}, {0.5, 0.5, 0.5})))};
  const Acceleration acceleration = constant(6.0, 0.05);
  const Acceleration* const accelerations[] = {&acceleration};
  const std::vector<Run> runs = run_all(*engine, layouts, accelerations, settings);
  CHECK(runs[1].record.row.stop_reason == StopReason::failed);
  CHECK(has(runs[1].record.row.status, Status::capacity));
  CHECK(runs[0].record.row.status == Status::ok);
  const Run next = run(*engine, layouts[0], acceleration, settings);
  CHECK(next.record.row.status == Status::ok);
  CHECK(next.record.row.state_hash == runs[0].record.row.state_hash);
}

TEST_CASE("opencl_engine: a state that is not finite ends its world and no other", "[parallel][opencl_engine]") {
  const Settings settings = open_floor(0.4);
  const auto engine = opencl_engine(settings);
  if (!engine) return;
  const Layout layout = stack(3, {10, 10, 0}, {0.6, 0.5, 0.4});
  const Acceleration acceleration = constant(6.0, 0.05);
  const Acceleration* const accelerations[] = {&acceleration, &acceleration, &acceleration};
  const auto hurl = [&](StateColumns& state) { state.velocity[layout.boxes.size() + 1] = Vec3(3e38, -3e38, 3e38); };
  const std::vector<Run> runs = run_all(*engine, std::span(&layout, 1), accelerations, settings, hurl);
  CHECK(runs[1].record.row.stop_reason == StopReason::failed);
  CHECK(has(runs[1].record.row.status, Status::non_finite));
  const Run alone = run(*engine, layout, acceleration, settings);
  for (const std::size_t world : {0U, 2U}) {
    CHECK(runs[world].record.row.status == Status::ok);
    CHECK(runs[world].record.row.state_hash == alone.record.row.state_hash);
  }
}

}  // namespace opencl_engine_test
