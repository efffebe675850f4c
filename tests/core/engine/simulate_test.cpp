#include "core/engine/simulate.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "analyses/walls/wall_forces.hpp"
#include "core/engine/journey.hpp"
#include "recorded_calls.hpp"
#include "same_bits.hpp"
#include "scenes.hpp"
#include "scripted_engine.hpp"

namespace simulate_test {

using namespace holdfast::internal;
using namespace holdfast::internal::scenes;

namespace {

/// An acceleration with breakpoints that are no multiples of 1/240 s.
Acceleration pulse() {
  return acceleration_of({{0.1003, Vec3(0, 0, 0)}, {0.4004, Vec3(2, -1, 0)}, {0.5, Vec3(0, 0, 0)}});
}

Settings sleeping() {
  Settings settings = at_once();
  settings.stopping_condition = StoppingCondition::sleeping;
  return settings;
}

}  // namespace

TEST_CASE("simulate: steps follow each other without gap and cross no breakpoint", "[core][simulate]") {
  const Acceleration acceleration = pulse();
  const Heard heard = listen({}, acceleration, at_once());
  double time = 0.0;
  for (const Heard::Stretch& step : heard.steps) {
    CHECK(step.begin == time);
    CHECK(step.end > step.begin);
    CHECK(step.end - step.begin <= 1.0 / 240 * (1 + 1e-6));
    for (const double edge : {0.1003, 0.5007}) CHECK_FALSE((step.begin < edge - 1e-9 && step.end > edge + 1e-9));
    const bool pushed = step.begin > 0.1 && step.end < 0.501;
    CHECK(step.acceleration == (pushed ? Vec3(2, -1, 0) : Vec3(0, 0, 0)));
    time = step.end;
  }
  CHECK(time == acceleration.end_time());
  CHECK(heard.outcome.end_time == acceleration.end_time());
  CHECK(heard.outcome.status == Status::ok);
  CHECK(heard.outcome.stop_reason == StopReason::timeout);
  CHECK(heard.outcome.counters.steps == heard.steps.size());
}

TEST_CASE("simulate: a pulse gives the exact velocity at any step", "[core][simulate]") {
  for (const double rate : {7.0, 60.0, 240.0}) {
    const Run one = run(ScriptedEngine({.steps_per_second = rate}), kOneBox, pulse(), at_once());
    CHECK(one.state.velocity[0].x() == Approx(-2 * 0.4004).epsilon(1e-12));
    CHECK(one.displacement().y() == Approx(0.5 * 0.4004 * 0.4004 + 0.4004 * 0.5).epsilon(1e-12));
  }
}

TEST_CASE("simulate: the sampling interval does not affect the motion", "[core][simulate]") {
  Settings settings = at_once();
  const auto hash = [&](double interval) {
    settings.results_interval = interval;
    return run(ScriptedEngine({}), kOneBox, pulse(), settings).record.row.state_hash;
  };
  const std::uint64_t expected = hash(0.1);
  CHECK(hash(0.001) == expected);
  CHECK(hash(0.0371) == expected);
  CHECK(hash(100.0) == expected);
}

TEST_CASE("simulate: after the acceleration ends it is zero, and an earlier end shortens it", "[core][simulate]") {
  const Acceleration acceleration = constant(2.0, 1.0);
  CHECK(latest_end(acceleration, at_once()) == 1.0);
  CHECK(latest_end(acceleration, {}) == 6.0);
  Settings settings = at_once();
  settings.timeout = 0.5;
  const Run cut = run(ScriptedEngine({}), kOneBox, acceleration, settings);
  CHECK(cut.record.row.end_time == 0.5);
  CHECK(cut.state.velocity[0].x() == Approx(-1.0));
  settings.timeout = 2.5;
  const Run longer = run(ScriptedEngine({}), kOneBox, acceleration, settings);
  CHECK(longer.record.row.end_time == 2.5);
  CHECK(longer.state.velocity[0].x() == Approx(-2.0));
  CHECK(longer.displacement().x() == Approx(-4.0));
}

TEST_CASE("simulate: an acceleration without duration ends at once, at 0", "[core][simulate]") {
  const Run none = run(ScriptedEngine({}), kOneBox, Acceleration{}, at_once());
  CHECK(none.record.row.end_time == 0.0);
  CHECK_FALSE(std::signbit(none.record.row.end_time));
  CHECK(none.record.row.steps == 0);
  CHECK(none.record.series.time == std::vector<double>{0.0});
  CHECK(none.displacement() == Vec3(0, 0, 0));
}

TEST_CASE("simulate: the bit of the status that comes first in time decides", "[core][simulate]") {
  // ½ · 2 · t² > 0.1 m from 0.316 s on.
  Settings settings = at_once();
  settings.screening.tilt_threshold = 180.0;
  const Thresholds thresholds = recording_plan(settings, false).thresholds;
  const auto fails_from = [&](double time) {
    const Script script{.status = Status::not_converged, .fails_from = time};
    const Run one = run(ScriptedEngine(script), kOneBox, constant(2.0, 1.0), settings);
    CHECK(one.record.row.status == Status::not_converged);
    CHECK(one.record.row.status_time == Approx(time).margin(1.1 / 240));
    return to_string(judge_world(one.record.row, one.record.end, by_run(thresholds)).verdict);
  };
  CHECK(fails_from(0.3) == "failed");
  CHECK(fails_from(0.33) == "moved");
  CHECK(fails_from(0.9) == "moved");
}

TEST_CASE("simulate: a state that is not finite ends the world at its last finite state", "[core][simulate]") {
  const Acceleration acceleration = constant(2.0, 1.0);
  const Run one = run(ScriptedEngine({.breaks_at = 0.42}), kOneBox, acceleration, at_once());
  const WorldRow& outcome = one.record.row;
  CHECK(outcome.status == Status::non_finite);
  CHECK(outcome.stop_reason == StopReason::failed);
  CHECK(outcome.end_time == Approx(100.0 / 240));
  CHECK(one.displacement().x() == Approx(-outcome.end_time * outcome.end_time));
  CHECK(one.record.series.time.back() == outcome.end_time);
  CHECK(one.record.series.displacement.back().x == one.record.end.end_displacement[0].x);
  CHECK(std::isfinite(one.record.end.end_kinetic_energy[0]));
  CHECK(std::isfinite(one.record.row.peak_total_kinetic_energy));
}

TEST_CASE("simulate: a state that is not finite while settling", "[core][simulate]") {
  Settings settings = at_once();
  settings.screening.settle_seconds = 1.0;
  settings.screening.tilt_threshold = 180.0;
  const Heard heard = listen({.breaks_at = -0.5}, constant(2.0, 1.0), settings);
  CHECK(heard.outcome.status == Status::non_finite);
  CHECK(heard.outcome.stop_reason == StopReason::failed);
  CHECK(heard.outcome.end_time == Approx(-0.5).margin(1.0 / 240));
  CHECK(heard.accelerations == 0);

  const Run one = run(ScriptedEngine({.breaks_at = -0.5}), kOneBox, constant(2.0, 1.0), settings);
  CHECK(one.record.series.time.front() == -1.0);
  CHECK(one.displacement() == Vec3(0, 0, 0));
  CHECK(to_string(judge_world(one.record.row, one.record.end, by_run({.tilt = 180})).verdict) == "failed");
}

TEST_CASE("simulate: a world that fails does not affect the others", "[core][simulate]") {
  const Acceleration acceleration = constant(2.0, 1.0);
  const Acceleration* const accelerations[] = {&acceleration};
  const std::vector<Layout> layouts = {kOneBox, kOneBox, kOneBox};
  for (const bool all_together : {false, true}) {
    for (const double settle : {0.0, 0.6}) {
      Settings settings = at_once();
      settings.screening.settle_seconds = settle;
      settings.screening.tilt_threshold = 180.0;
      const double breaks_at = settle > 0 ? -0.3 : 0.5;
      const ScriptedEngine engine({.all_together = all_together, .breaks_at = breaks_at, .breaking_world = 1});
      const std::vector<Run> runs = run_all(engine, layouts, accelerations, settings);
      CHECK(runs[1].record.row.status == Status::non_finite);
      for (const std::size_t i : {0U, 2U}) {
        CHECK(runs[i].record.row.status == Status::ok);
        CHECK(runs[i].record.row.end_time == 1.0);
        CHECK(runs[i].displacement().x() == Approx(-1.0));
      }
    }
  }
}

TEST_CASE("simulate: problems that the engine finds are in the status", "[core][simulate]") {
  const Run one = run(ScriptedEngine({.status = Status::not_converged}), kOneBox, constant(1, 1), at_once());
  CHECK(one.record.row.status == Status::not_converged);
  CHECK(one.record.row.stop_reason == StopReason::timeout);
  const Run both =
      run(ScriptedEngine({.breaks_at = 0.5, .status = Status::not_converged}), kOneBox, constant(1, 1), at_once());
  CHECK(both.record.row.status == (Status::not_converged | Status::non_finite));
}

TEST_CASE("simulate: sleeping waits for the last change of the acceleration", "[core][simulate]") {
  const Acceleration acceleration = acceleration_of({{1, Vec3(0, 0, 0)}, {1, Vec3(1, 0, 0)}});
  const Run one = run(ScriptedEngine({.still_from = 0.0}), kOneBox, acceleration, sleeping());
  CHECK(one.record.row.stop_reason == StopReason::sleeping);
  CHECK(one.record.row.end_time == Approx(2.5));
}

TEST_CASE("simulate: sleeping takes half a second at low speed", "[core][simulate]") {
  const Acceleration acceleration = constant(0.5, 1.0);
  const Run one = run(ScriptedEngine({.still_from = 3.0}), kOneBox, acceleration, sleeping());
  CHECK(one.record.row.stop_reason == StopReason::sleeping);
  CHECK(one.record.row.end_time == Approx(3.5).margin(1.0 / 240));
  CHECK(one.record.series.time.back() == one.record.row.end_time);
}

TEST_CASE("simulate: a world that never sleeps ends at the timeout, or after a minute", "[core][simulate]") {
  const Acceleration acceleration = constant(0.5, 1.0);
  CHECK(latest_end(acceleration, sleeping()) == 61.0);
  const Run one = run(ScriptedEngine({}), kOneBox, acceleration, sleeping());
  CHECK(one.record.row.stop_reason == StopReason::timeout);
  CHECK(one.record.row.end_time == 61.0);
  Settings settings = sleeping();
  settings.timeout = 2.0;
  CHECK(run(ScriptedEngine({}), kOneBox, acceleration, settings).record.row.end_time == 2.0);
  settings.timeout = 1.2;
  const Run early = run(ScriptedEngine({.still_from = 0.0}), kOneBox, acceleration, settings);
  CHECK(early.record.row.stop_reason == StopReason::timeout);
}

TEST_CASE("simulate: an abort ends the simulation", "[core][simulate]") {
  const Acceleration acceleration = constant(1.0, 1.0);
  const Acceleration* const accelerations[] = {&acceleration};
  WorldBatch batch = scenes::batch_of(std::span(&kOneBox, 1), accelerations, at_once());
  std::atomic<bool> abort = false;

  /// Aborts at its third step.
  class Aborting final : public Recorder {
   public:
    explicit Aborting(std::atomic<bool>& flag) : flag_(flag) {}
    void start(const BoxView&, const StateView&, double) override {}
    void accelerate(const StateView&) override {}
    void step(const Step&) override { flag_ = ++steps == 3; }
    void finish(const Outcome&, const StateView&) override { finished = true; }
    int steps = 0;
    bool finished = false;

   private:
    std::atomic<bool>& flag_;
  } recorder(abort);
  Recorder* const recorders[] = {&recorder};
  CHECK_FALSE(simulate(ScriptedEngine({}), batch, at_once(), recorders, abort));
  CHECK(recorder.steps == 3);
  CHECK_FALSE(recorder.finished);
  // Settling too.
  CHECK_FALSE(simulate(ScriptedEngine({}), batch, {}, recorders, abort));
  CHECK(recorder.steps == 3);
}

TEST_CASE("simulate: a world is the same alone, in a batch and together with others", "[core][simulate]") {
  const std::vector<Layout> layouts = {kOneBox, stack(3, {2, 0, 0}, {1, 2, 0.5}), layout_of({})};
  const Acceleration one = pulse();
  const Acceleration other = constant(-1.0, 1.3);
  const Acceleration* const accelerations[] = {&one, &other};
  const std::vector<Run> batch = run_all(ScriptedEngine({}), layouts, accelerations, at_once());
  const std::vector<Run> together = run_all(ScriptedEngine({.all_together = true}), layouts, accelerations, at_once());
  REQUIRE(batch.size() == 6);
  for (std::size_t i = 0; i < batch.size(); ++i) {
    const Run alone = run(ScriptedEngine({}), layouts[i / 2], *accelerations[i % 2], at_once());
    for (const Run* same : {&batch[i], &together[i]}) {
      CHECK(same->record.row.state_hash == alone.record.row.state_hash);
      CHECK(same->record.series.time == alone.record.series.time);
      CHECK(same->record.row.peak_total_kinetic_energy == alone.record.row.peak_total_kinetic_energy);
      CHECK(same->record.row.end_time == alone.record.row.end_time);
    }
  }
}

TEST_CASE("simulate: the worlds of a load one after another are what each is alone", "[core][simulate]") {
  const Layout resting = stack(3, {1, 1, 0}, {0.6, 0.6, 0.6});
  const Layout falling = stack(2, {1, 1, 0.05}, {0.6, 0.6, 0.6});
  Layout leaning = resting;
  leaning.boxes.push_back(box({3, 1, 0}, {0.2, 0.6, 0.2}));
  leaning.boxes.push_back(box({3.15, 1, 0.2}, {0.6, 0.6, 0.6}));
  const std::vector<Acceleration> accelerations = {constant(2.0, 0.3), constant(6.0, 0.4), constant(-14.0, 0.4),
                                                   constant(2.0, 0.3)};
  for (const char* const name : {"native", "native-plain"}) {
    Settings settings;
    settings.native.accuracy = Accuracy::screening;
    settings.screening.wall_forces = name == std::string("native");  // native-plain measures none
    const std::unique_ptr<Engine> engine = engine_of(name, settings);
    for (const Layout& layout : {resting, falling, leaning}) {
      LoadSimulation load(*engine, layout, settings);
      for (const Acceleration& acceleration : accelerations) {
        INFO(name << ", " << layout.boxes.size() << " boxes, " << acceleration.segments[0].acceleration.x());
        const WorldRecord alone = run(*engine, layout, acceleration, settings).record;
        SeriesRecorder recorder(recording_plan(settings, true, methods_of(analyses_of(settings))));
        REQUIRE(load.run(acceleration, recorder, false));
        const WorldRecord after = recorder.take();
        CHECK(after.row.state_hash == alone.row.state_hash);
        CHECK(after.row.end_time == alone.row.end_time);
        CHECK(after.row.steps == alone.row.steps);
        CHECK(after.row.steps_skipped == alone.row.steps_skipped);
        CHECK(after.row.solve_iterations == alone.row.solve_iterations);
        CHECK(after.row.max_residual == alone.row.max_residual);
        CHECK(after.row.status == alone.row.status);
        CHECK(after.row.caveats == alone.row.caveats);
        CHECK(same_bits(after.end.peak_displacement, alone.end.peak_displacement));
        CHECK(after.series.time == alone.series.time);
        CHECK(same_bits(after.series.displacement, alone.series.displacement));
        CHECK(same_bits(after.found.value<WallForces>().force, alone.found.value<WallForces>().force));
      }
    }
  }
}

TEST_CASE("simulate: worlds that advance together keep their own accelerations", "[core][simulate]") {
  const Layout layouts[] = {kOneBox, kOneBox};
  const Acceleration first = pulse();
  const Acceleration second = acceleration_of({{0.3001, Vec3(0, 3, 0)}, {0.9, Vec3(1, 0, 0)}});
  const Acceleration* const accelerations[] = {&first, &second};
  Settings settings = at_once();
  settings.screening.settle_seconds = 0.1;
  settings.screening.tilt_threshold = 180.0;
  const std::vector<Run> alone = run_all(ScriptedEngine({}), layouts, accelerations, settings);
  const std::vector<Run> together = run_all(ScriptedEngine({.all_together = true}), layouts, accelerations, settings);
  REQUIRE(together.size() == 4);
  for (std::size_t i = 0; i < together.size(); ++i) {
    CHECK(together[i].record.row.state_hash == alone[i].record.row.state_hash);
    CHECK(together[i].record.row.end_time == alone[i].record.row.end_time);
    CHECK(together[i].record.row.steps == alone[i].record.row.steps);
    CHECK(together[i].record.series.time == alone[i].record.series.time);
  }
}

TEST_CASE("simulate: worlds that advance together end separately", "[core][simulate]") {
  const Layout layouts[] = {kOneBox, kOneBox};
  const Acceleration acceleration = pulse();
  const Acceleration* const accelerations[] = {&acceleration};
  const Script script{.all_together = true, .breaks_at = 0.2, .breaking_world = 1};
  const std::vector<Run> runs = run_all(ScriptedEngine(script), layouts, accelerations, at_once());
  CHECK(runs[0].record.row.stop_reason == StopReason::timeout);
  CHECK(runs[0].record.row.end_time == acceleration.end_time());
  CHECK(runs[1].record.row.stop_reason == StopReason::failed);
  CHECK(runs[1].record.row.end_time == Approx(0.2).margin(1.0 / 240));
}

TEST_CASE("simulate: a world whose engine lost contacts fails with the last valid state", "[core][simulate]") {
  const Run lost = run(ScriptedEngine({.status = Status::capacity}), kOneBox, pulse(), at_once());
  CHECK(lost.record.row.stop_reason == StopReason::failed);
  CHECK(has(lost.record.row.status, Status::capacity));
  CHECK(lost.record.row.end_time == 0.0);
}

TEST_CASE("simulate: a world ends with the step that decides it", "[core][simulate]") {
  Settings settings = at_once();
  settings.screening.stop_when = StopWhen::moved;
  // ½ · 2 · t² > 0.1 m from 0.316 s on; the rotation about z is 10° at 0.175 s.
  settings.screening.tilt_threshold = 180.0;
  const Acceleration acceleration = constant(2.0, 1.0);
  const Run early = run(ScriptedEngine({}), kOneBox, acceleration, settings);
  CHECK(early.record.row.stop_reason == StopReason::decided);
  CHECK(early.record.row.end_time == 76.0 / 240);
  CHECK(early.record.row.steps == 76);
  CHECK(early.record.series.time.back() == early.record.row.end_time);
  CHECK(time_saved(Status::ok, StopReason::decided, early.record.row.end_time, planned_end(acceleration, settings)) ==
        1.0 - 76.0 / 240);
  settings.screening.tilt_threshold = 10.0;
  CHECK(run(ScriptedEngine({}), kOneBox, acceleration, settings).record.row.end_time == 42.0 / 240);

  settings.screening.stop_when = StopWhen::fallen;
  const Run whole = run(ScriptedEngine({}), kOneBox, acceleration, settings);
  CHECK(whole.record.row.stop_reason == StopReason::timeout);
  CHECK(whole.record.row.end_time == 1.0);
  CHECK(time_saved(Status::ok, StopReason::timeout, 0.5, 1.0) == 0.0);
  CHECK(time_saved(Status::not_needed, StopReason::not_run, 0.0, 1.0) == 1.0);
  CHECK(time_saved(Status::bad_layout, StopReason::not_run, 0.0, 1.0) == 0.0);
}

TEST_CASE("simulate: a world that is decided by its last step has run to its end", "[core][simulate]") {
  Settings settings = at_once();
  settings.screening.stop_when = StopWhen::moved;
  settings.screening.tilt_threshold = 180.0;
  const Run whole = run(ScriptedEngine({}), kOneBox, constant(2.0, 76.0 / 240), settings);
  CHECK(whole.record.row.stop_reason == StopReason::timeout);
  CHECK(whole.record.row.steps == 76);
}

TEST_CASE("simulate: worlds that advance together are decided separately", "[core][simulate]") {
  const Layout layouts[] = {kOneBox};
  const Acceleration slow = constant(0.1, 1.0);
  const Acceleration fast = constant(2.0, 1.0);
  const Acceleration* const accelerations[] = {&slow, &fast};
  Settings settings = at_once();
  settings.screening.stop_when = StopWhen::moved;
  settings.screening.tilt_threshold = 180.0;
  const std::vector<Run> runs = run_all(ScriptedEngine({.all_together = true}), layouts, accelerations, settings);
  CHECK(runs[0].record.row.end_time == 1.0);
  CHECK(runs[1].record.row.end_time == 76.0 / 240);
  CHECK(runs[1].record.row.state_hash == run(ScriptedEngine({}), kOneBox, fast, settings).record.row.state_hash);
}

}  // namespace simulate_test
