#include "core/native/native_world.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <memory>
#include <utility>
#include <vector>

#include "core/native/native_scenes.hpp"
#include "physics/measures.hpp"
#include "same_bits.hpp"

namespace native_world_test {

using namespace holdfast::internal;
using namespace holdfast::internal::native;
using namespace holdfast::internal::scenes;
using holdfast::internal::physics::bundled_layout;
using native_scenes::kFlat;
using native_scenes::OneWorld;

namespace {

/// The engine's solver, whose calls are counted.
class CountedSolver final : public ContactSolver {
 public:
  explicit CountedSolver(int& solves) : solves_(solves) {}

  std::span<const std::uint32_t> order(std::size_t count, std::span<const BodyPair> pairs) override {
    return solver_->order(count, pairs);
  }
  SolveResult solve(ContactProblem& problem, const SolveLimits& limits) override {
    ++solves_;
    return solver_->solve(problem, limits);
  }

 private:
  int& solves_;
  std::unique_ptr<ContactSolver> solver_ = make_contact_solver();
};

/// The engine's solver; counts moving steps that are solved again, and those that start where the solve before ended.
class RepeatsCounted final : public ContactSolver {
 public:
  struct Counts {
    int repeated = 0, warm = 0;
  };
  explicit RepeatsCounted(Counts& counts) : counts_(counts) {}

  std::span<const std::uint32_t> order(std::size_t count, std::span<const BodyPair> pairs) override {
    return solver_->order(count, pairs);
  }
  SolveResult solve(ContactProblem& problem, const SolveLimits& limits) override {
    // The same bodies from the same velocities, in an order that changes with their contacts. Only the solves of steps
    // may take more iterations.
    std::vector<Key> free;
    if (limits.more_iterations > 0) free = sorted(problem.free_velocity);
    if (!free.empty() && free == free_) {
      ++counts_.repeated;
      if (sorted(problem.velocity) == found_) ++counts_.warm;
    }
    const SolveResult result = solver_->solve(problem, limits);
    free_ = free;
    found_ = sorted(problem.velocity);
    return result;
  }

 private:
  using Key = std::array<double, 3>;

  static std::vector<Key> sorted(const std::vector<BodyVector>& velocities) {
    std::vector<Key> keys;
    for (const BodyVector& v : velocities) keys.push_back({v.row[0], v.row[1], v.row[2]});
    std::sort(keys.begin(), keys.end());
    return keys;
  }

  Counts& counts_;
  std::vector<Key> free_, found_;
  std::unique_ptr<ContactSolver> solver_ = make_contact_solver();
};

Phase first_phase(const Acceleration& acceleration) { return phases_of(acceleration, acceleration.end_time()).front(); }

}  // namespace

TEST_CASE("native_world: what rests is taken to the end of the phase at once", "[core][native_world]") {
  OneWorld scene(open_floor(0.5), stack(3, {5, 5, 0}, kFlat), constant(2.0, 3.0));
  const Phase phase = first_phase(scene.acceleration);
  CHECK(scene.world.advance(phase) == phase.end);
  CHECK(scene.world.counters().steps == scene.world.counters().steps_skipped);
  const StateColumns start = scene.batch.state;
  scene.world.read_back(scene.batch.state);
  CHECK(same_bits(scene.batch.state.position, start.position));
}

TEST_CASE("native_world: what moves is taken one step further", "[core][native_world]") {
  OneWorld scene(open_floor(0.1), stack(1, {5, 5, 0}, kFlat), constant(2.0, 1.0));
  const Phase phase = first_phase(scene.acceleration);
  const double step = 1.0 / native_options(scene.settings).steps_per_second;
  CHECK(scene.world.advance(phase) == Approx(phase.begin + step));
  CHECK(scene.world.counters().steps == 1);
  CHECK(scene.world.counters().steps_skipped == 0);
}

TEST_CASE("native_world: an island that moves leaves one that rests alone", "[core][native_world]") {
  Layout layout = layout_of({box({5, 5, 0}, kFlat), box({10, 10, 0}, kFlat)});
  layout.boxes[1].material = 2;
  Settings settings = open_floor(0.5);
  settings.contact.friction_model = FrictionModel::product;
  settings.materials[2].friction = 0.1;
  OneWorld scene(settings, layout, constant(2.0, 1.0));
  const Vec3 start = scene.batch.state.position[0];
  scene.run();
  CHECK((scene.batch.state.position[0] - start).norm() == 0.0);
  CHECK((scene.batch.state.position[1] - scene.batch.state.position[0]).norm() > 1.0);
}

TEST_CASE("native_world: a long row of thin poles topples alike with few steps and with many", "[core][native_world]") {
  std::vector<Box> poles;
  for (int i = 0; i < 150; ++i) poles.push_back(box({0.1 + 0.013 * i, 0.5, 0}, {0.01, 0.01, 0.6}));
  const Layout layout = layout_of(poles);
  const auto run_at = [&](Accuracy accuracy) {
    return native_scenes::native_run(layout, constant(7.848, 0.6), native_scenes::with(accuracy, at_once()));
  };
  const Run screening = run_at(Accuracy::screening), standard = run_at(Accuracy::standard);
  // They lean on each other and on the front wall. With 60 steps per second they were thrown about, in 50 times the
  // iterations.
  CHECK(screening.record.row.solve_iterations < 2 * standard.record.row.solve_iterations);
  for (std::size_t i = 0; i < poles.size(); ++i)
    CHECK(screening.record.end.peak_tilt[i] == Approx(standard.record.end.peak_tilt[i]).margin(2.0));
}

TEST_CASE("native_world: contacts are solved by the solver that it is given", "[core][native_world]") {
  const Layout layout = stack(2, {5, 5, 0}, {0.5, 0.5, 0.5});
  int solves = 0;
  OneWorld counted(open_floor(0.3), layout, constant(4.0, 0.5), std::make_unique<CountedSolver>(solves));
  OneWorld plain(open_floor(0.3), layout, constant(4.0, 0.5));
  counted.run();
  plain.run();
  CHECK(solves > 50);
  CHECK(same_bits(counted.batch.state.position, plain.batch.state.position));
}

TEST_CASE("native_world: a step that is solved again starts where its last solve has ended", "[core][native_world]") {
  Settings settings = at_once();
  settings.native.accuracy = Accuracy::screening;
  RepeatsCounted::Counts counts;
  OneWorld scene(settings, bundled_layout("BR8_009_ep", settings), constant(kGravity, 1.0),
                 std::make_unique<RepeatsCounted>(counts));
  scene.run();
  CHECK(counts.repeated > 10);
  // A contact that has ended in the step starts anew.
  CHECK(counts.warm >= counts.repeated - 2);
}

TEST_CASE("native_world: a world of a batch writes its own bodies alone", "[core][native_world]") {
  const Settings settings = open_floor(0.1);
  const std::vector<Layout> layouts{stack(2, {5, 5, 0}, kFlat), stack(3, {5, 5, 0}, kFlat)};
  const Acceleration acceleration = constant(3.0, 0.5);
  const Acceleration* pointer = &acceleration;
  WorldBatch batch = batch_of(layouts, {&pointer, 1}, settings);
  NativeWorld second(batch, batch.worlds[1], settings, native_options(settings),
                     std::make_unique<WorldMemory>(native_options(settings)));
  const Phase phase = first_phase(acceleration);
  while (second.advance(phase) < phase.end) {
  }
  const StateColumns start = batch.state;
  second.read_back(batch.state);
  for (std::size_t i = 0; i < 2; ++i) CHECK(batch.state.position[i] == start.position[i]);
  for (std::size_t i = 2; i < 5; ++i) CHECK(batch.state.position[i].x() != start.position[i].x());
}

}  // namespace native_world_test
