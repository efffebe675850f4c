#include "validate/laboratory/load_suite.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

namespace load_suite_test {

using namespace holdfast::internal;

namespace {

/// A run of two boxes with `samples` samples; the first moves by `step` per sample along x, the second sinks as much.
LoadRun run_of(std::size_t samples, double step, double sink = 0.0) {
  LoadRun run;
  for (std::size_t i = 0; i < samples; ++i) {
    const double share = static_cast<double>(i);
    run.positions.push_back({Vec3(step * share, 0, 0), Vec3(1, 0, -sink * share)});
  }
  return run;
}

double error_of(const std::vector<Measurement>& measurements, const std::string& part) {
  const auto found = std::find_if(measurements.begin(), measurements.end(),
                                  [&](const Measurement& m) { return m.metric.find(part) != std::string::npos; });
  REQUIRE(found != measurements.end());
  return found->error;
}

}  // namespace

TEST_CASE("load_suite: a run like the reference has no error", "[validate][load_suite]") {
  const std::vector<LoadRun> runs = {run_of(10, 0.001), run_of(10, 0.1, 0.02)};
  for (const Measurement& measurement : compare_loads(runs, runs, runs)) {
    CAPTURE(measurement.metric, measurement.value);
    CHECK(measurement.error == 0.0);
  }
}

TEST_CASE("load_suite: displacement counts only while the references agree to 1 mm", "[validate][load_suite]") {
  // The references separate by 0.3 mm per sample: samples 0 to 3 are predictable. The error of the run grows by 2 mm
  // per sample.
  const std::vector<LoadRun> reference = {run_of(10, 0.0)};
  const std::vector<LoadRun> second = {run_of(10, 0.0003)};
  const std::vector<LoadRun> run = {run_of(10, 0.002)};
  CHECK(error_of(compare_loads(run, reference, second), "largest (m)") == Approx(3 * 0.002));
}

TEST_CASE("load_suite: verdicts are judged at the end", "[validate][load_suite]") {
  const std::vector<LoadRun> reference = {run_of(11, 0.0), run_of(11, 0.0), run_of(11, 0.0), run_of(11, 0.0)};
  const std::vector<LoadRun> run = {run_of(11, 0.011), run_of(11, 0.009), run_of(11, 0.0, 0.006),
                                    run_of(11, 0.0, 0.004)};
  const auto measurements = compare_loads(run, reference, reference);
  CHECK(error_of(measurements, "any moved") == Approx(0.25));
  CHECK(error_of(measurements, "any fell") == Approx(0.25));
  CHECK(error_of(measurements, "number of fallen") == Approx(0.25));
}

TEST_CASE("load_suite: a failed run is counted and left out of the other measurements", "[validate][load_suite]") {
  const std::vector<LoadRun> reference = {run_of(5, 0.0), run_of(5, 0.001)};
  std::vector<LoadRun> run = reference;
  run[0].failed = true;
  run[0].positions.resize(1);
  const auto measurements = compare_loads(run, reference, reference);
  CHECK(error_of(measurements, "that failed") == Approx(0.5));
  CHECK(error_of(measurements, "any fell") == 0.0);
}

TEST_CASE("load_suite: the rank correlation is 1 for the same order, its error 2 for the opposite",
          "[validate][load_suite]") {
  const std::vector<LoadRun> reference = {run_of(5, 0.001), run_of(5, 0.002), run_of(5, 0.003)};
  const std::vector<LoadRun> same_order = {run_of(5, 0.01), run_of(5, 0.05), run_of(5, 0.06)};
  const std::vector<LoadRun> opposite = {run_of(5, 0.06), run_of(5, 0.05), run_of(5, 0.01)};
  CHECK(error_of(compare_loads(same_order, reference, reference), "rank") == Approx(0.0).margin(1e-12));
  CHECK(error_of(compare_loads(opposite, reference, reference), "rank") == Approx(2.0));
}

TEST_CASE("load_suite: every layout has the four road accelerations", "[validate][load_suite]") {
  Layout layout;
  layout.name = "a.txt";
  layout.boxes.push_back({Vec3(0, 0, 0), Vec3(1, 1, 1), 1, 2});
  const std::vector<LoadWorld> worlds = load_worlds(std::vector{layout, layout});
  REQUIRE(worlds.size() == 8);
  CHECK(worlds[0].scene.acceleration.end_time() == Approx(2.0));
  CHECK(worlds[0].scene.acceleration.segments[1].acceleration.x() == Approx(0.8 * 9.81));
  CHECK(worlds[0].scene.boxes[0].position == Vec3(0.5, 0.5, 0.5));
}

}  // namespace load_suite_test
