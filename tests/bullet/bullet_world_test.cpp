// The result of a world depends only on its own inputs.

#include <filesystem>
#include <thread>

#include "io/input/layout_reader.hpp"
#include "scenes.hpp"

namespace bullet_world_test {

using namespace holdfast::internal;
using namespace holdfast::internal::scenes;

namespace {

std::string any_engine() { return GENERATE(as<std::string>{}, "bullet", "bullet-f64", "bullet-stock"); }

/// A pile that falls over: many contacts, some of which open and others close.
Layout pile() {
  Layout layout = stack(4, {2.1, 0.9, 0}, {0.4, 0.5, 0.5});
  for (const Box& more : stack(3, {2.5, 0.7, 0}, {0.3, 0.8, 0.4}).boxes) layout.boxes.push_back(more);
  layout.boxes.push_back(box({2.1, 0.1, 0}, {0.7, 0.6, 0.3}));
  return layout;
}

Acceleration swerve() {
  return acceleration_of({{0.2, Vec3(0, 0, 0)}, {0.6, Vec3(7, 3, 0)}, {0.4003, Vec3(-5, -4, 0)}});
}

std::uint64_t hash_alone(const std::string& engine, const Layout& layout) {
  return run(engine, layout, swerve(), at_once()).record.row.state_hash;
}

}  // namespace

TEST_CASE("bullet_world: the same bits alone, again and in any batch", "[bullet][bullet_world]") {
  const std::string engine = any_engine();
  CAPTURE(engine);
  const std::uint64_t expected = hash_alone(engine, pile());
  CHECK(hash_alone(engine, pile()) == expected);

  const std::vector<Layout> layouts = {stack(6, {1, 1, 0}, {0.5, 0.5, 0.3}), pile(), layout_of({}), pile()};
  const Acceleration other = constant(3, 0.5);
  const Acceleration same = swerve();
  const Acceleration* const accelerations[] = {&other, &same};
  const std::vector<Run> runs = run_all(*engine_of(engine, at_once()), layouts, accelerations, at_once());
  CHECK(runs[3].record.row.state_hash == expected);
  CHECK(runs[7].record.row.state_hash == expected);
}

TEST_CASE("bullet_world: the same bits from several threads at once", "[bullet][bullet_world]") {
  const std::string engine = any_engine();
  CAPTURE(engine);
  const std::uint64_t expected = hash_alone(engine, pile());
  // One engine, shared by all threads; Catch's assertions may be used in this thread only.
  const std::unique_ptr<Engine> shared = engine_of(engine, at_once());
  std::vector<std::uint64_t> hashes(4);
  std::vector<std::thread> threads;
  for (std::uint64_t& hash : hashes) {
    threads.emplace_back([&] {
      const Layout layout = pile();
      const Acceleration acceleration = swerve();
      const Acceleration* const accelerations[] = {&acceleration};
      WorldBatch batch = scenes::batch_of(std::span(&layout, 1), accelerations, at_once());
      SeriesRecorder recorder(recording_plan({}, true));
      Recorder* const recorders[] = {&recorder};
      simulate(*shared, batch, at_once(), recorders, false);
      hash = recorder.take().row.state_hash;
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const std::uint64_t hash : hashes) CHECK(hash == expected);
}

TEST_CASE("bullet_world: engines of both precisions do not mix up", "[bullet][bullet_world]") {
  const std::unique_ptr<Engine> in_float = engine_of("bullet", at_once());
  const std::unique_ptr<Engine> in_double = engine_of("bullet-f64", at_once());
  CHECK(run(*in_float, pile(), swerve(), at_once()).record.row.state_hash == hash_alone("bullet", pile()));
  CHECK(run(*in_double, pile(), swerve(), at_once()).record.row.state_hash == hash_alone("bullet-f64", pile()));
  CHECK(hash_alone("bullet", pile()) != hash_alone("bullet-f64", pile()));
  CHECK(hash_alone("bullet", pile()) != hash_alone("bullet-stock", pile()));
}

TEST_CASE("bullet_world: sampling does not change the motion", "[bullet][bullet_world]") {
  Settings settings = at_once();
  settings.results_interval = 0.0123;
  CHECK(run("bullet", pile(), swerve(), settings).record.row.state_hash == hash_alone("bullet", pile()));
}

TEST_CASE("bullet_world: a change of the acceleration wakes sleeping boxes", "[bullet][bullet_world]") {
  const std::string engine = any_engine();
  CAPTURE(engine);
  const Layout layout = layout_of({box({10, 10, 0}, {1.1, 1.1, 0.25})});
  const double limit = 0.5 * kGravity;
  const Acceleration acceleration = acceleration_of({{3, Vec3(0, 0, 0)}, {1, Vec3(1.5 * limit, 0, 0)}});
  Settings settings = open_floor(0.5);
  settings.bullet.sleeping = BulletSleeping::wake_on_change;
  const Run one = run(engine, layout, acceleration, settings);
  CHECK(one.displacement().x() == Approx(-0.25 * limit * (1 + 1.0 / 240)).epsilon(1e-3));
  // The box was asleep: Bullet puts bodies to sleep after 2 s.
  const WorldRow awake = run(engine, layout, acceleration, open_floor(0.5)).record.row;
  const WorldRow& asleep = one.record.row;
  CHECK(asleep.steps == awake.steps);
  CAPTURE(asleep.solve_iterations, awake.solve_iterations);
  CHECK(asleep.solve_iterations < awake.solve_iterations / 8 * 7);
}

TEST_CASE("bullet_world: the layouts that come with the program stay finite", "[bullet][bullet_world]") {
  Settings settings = at_once();
  settings.steps_per_second = 60;
  const std::unique_ptr<Engine> engine = engine_of("bullet", settings);
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(HOLDFAST_SOURCE_DIR "/configs/layouts")) {
    CAPTURE(entry.path().string());
    const Result<TextFile> file = read_text_file(entry.path().string());
    REQUIRE(file);
    std::vector<Error> warnings;
    const Result<Layout> layout = parse_layout(*file, settings, warnings);
    REQUIRE(layout);
    const Run one = run(*engine, *layout, constant(0.8 * kGravity, 0.2), settings);
    CHECK(one.record.row.status == Status::ok);
    CHECK(one.record.row.end_time == 0.2);
    // ½ · 0.8 g · 0.2² is 16 cm; no box can have moved much farther.
    for (const Float3& moved : one.record.end.end_displacement) CHECK(length(moved) < 0.3F);
    ++count;
  }
  CHECK(count >= 15);
}

}  // namespace bullet_world_test
