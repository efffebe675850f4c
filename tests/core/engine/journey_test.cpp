#include "core/engine/journey.hpp"

#include <catch2/catch.hpp>

#include "recorded_calls.hpp"
#include "scenes.hpp"
#include "scripted_engine.hpp"

namespace journey_test {

using namespace holdfast::internal;
using namespace holdfast::internal::scenes;

TEST_CASE("journey: the load settles before the acceleration, and the world starts where it ends", "[core][journey]") {
  Settings settings = at_once();
  settings.screening.settle_seconds = 0.35;
  settings.screening.tilt_threshold = 180.0;
  const Heard heard = listen({}, constant(2.0, 1.0), settings);
  CHECK(heard.begin == -0.35);
  CHECK(heard.steps.front().begin == -0.35);
  CHECK(heard.steps_before == 84);
  CHECK(heard.steps[84].begin == 0.0);
  CHECK(heard.outcome.end_time == 1.0);
  CHECK(heard.outcome.counters.steps == heard.steps.size());
  CHECK(heard.settled_position == Vec3(1.5, 1.5, 0.5));
  // The box turns all the time.
  CHECK(has(heard.outcome.caveats, Caveat::not_at_rest));
  CHECK(has(heard.outcome.caveats, Caveat::still_moving));

  const Run one = run(ScriptedEngine({}), kOneBox, constant(2.0, 1.0), settings);
  CHECK(one.record.series.time.front() == 0.0);
  CHECK(one.record.series.time.size() == 11);
  CHECK(one.displacement().x() == Approx(-1.0));
  CHECK(one.record.end.settling_peak_tilt[0] == Approx(0.35 * 180.0 / 3.14159265358979));
}

TEST_CASE("journey: a load that is proved to rest neither settles nor runs out", "[core][journey]") {
  const Acceleration acceleration = constant(2.0, 1.0);
  const Heard heard = listen({.proves_rest = true, .still_from = -10.0}, acceleration, {});
  CHECK(heard.steps_before == 1);
  CHECK(heard.outcome.stop_reason == StopReason::sleeping);
  CHECK(heard.outcome.end_time == 1.0);
  CHECK(heard.steps.back().end == 1.0);
  CHECK(heard.outcome.caveats == Caveat::none);
}

TEST_CASE("journey: a load runs out after the acceleration, until it rests", "[core][journey]") {
  Settings settings = at_once();
  settings.screening.run_out_seconds = 5.0;
  const Acceleration acceleration = constant(2.0, 1.0);
  const Script proves{.proves_rest = true, .still_from = 1.5};
  const Heard heard = listen(proves, acceleration, settings);
  CHECK(heard.outcome.stop_reason == StopReason::sleeping);
  CHECK(heard.outcome.end_time == Approx(1.5).margin(1.0 / 240));
  CHECK(heard.steps.back().end == heard.outcome.end_time);
  CHECK(heard.steps.back().acceleration == Vec3(0, 0, 0));
  // The truth is not where the box is when the acceleration ends.
  const Run run_out = run(ScriptedEngine(proves), kOneBox, acceleration, settings);
  CHECK(run_out.displacement().x() == Approx(-2.0).margin(0.01));
  CHECK(run_out.record.end.peak_displacement[0] == Approx(2.0).margin(0.01));

  // Without proofs rest is half a second at low speed.
  const Heard slow = listen({.still_from = 1.5}, acceleration, settings);
  CHECK(slow.outcome.end_time == Approx(2.0).margin(1.0 / 240));
  CHECK(slow.outcome.stop_reason == StopReason::sleeping);

  // What does not rest is cut off, which it says.
  const Heard endless = listen({}, acceleration, settings);
  CHECK(endless.outcome.end_time == 6.0);
  CHECK(endless.outcome.stop_reason == StopReason::timeout);
  CHECK(has(endless.outcome.caveats, Caveat::still_moving));
  settings.timeout = 1.25;
  CHECK(listen({}, acceleration, settings).outcome.end_time == 1.25);
}

TEST_CASE("journey: a load that goes beyond a limit while it settles is not accelerated", "[core][journey]") {
  Settings settings;  // the box turns by 10 degrees within 0.175 s
  const Run whole = run(ScriptedEngine({}), kOneBox, constant(2.0, 1.0), settings);
  CHECK(whole.record.row.stop_reason == StopReason::decided);
  CHECK(whole.record.row.end_time == 0.0);
  CHECK(whole.record.series.time.front() == -2.0);
  CHECK(whole.record.series.time.back() == 0.0);
  CHECK(whole.record.end.first_beyond[0] == Approx(-2.0 + 42.0 / 240).margin(1e-6));
  CHECK(whole.record.end.peak_tilt[0] == whole.record.end.settling_peak_tilt[0]);
  CHECK(whole.displacement() == Vec3(0, 0, 0));
  settings.screening.stop_when = StopWhen::fallen;
  const Run early = run(ScriptedEngine({}), kOneBox, constant(2.0, 1.0), settings);
  CHECK(early.record.row.end_time == Approx(-2.0 + 42.0 / 240));
  for (const Run* world : {&whole, &early})
    CHECK(to_string(judge_world(world->record.row, world->record.end, by_run({})).verdict) == "unstable");
}

}  // namespace journey_test
