#include "validate/laboratory/load_suite.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/model/verdict.hpp"

namespace holdfast::internal {

namespace {

constexpr double kFriction = 0.45;
constexpr double kSampleInterval = 0.01;  // s
constexpr double kPredictable = 1e-3;     // m
constexpr double kMetre = 1.0;            // scale of displacement errors, m

/// Largest distance between the boxes of two runs at a sample, m.
double distance(const LoadRun& a, const LoadRun& b, std::size_t sample) {
  double largest = 0.0;
  for (std::size_t box = 0; box < a.positions[sample].size(); ++box)
    largest = std::max(largest, (a.positions[sample][box] - b.positions[sample][box]).norm());
  return largest;
}

/// Number of samples before the references separate: from then on the motion is not predictable.
std::size_t predictable_samples(const LoadRun& reference, const LoadRun& second) {
  const std::size_t count = std::min(reference.positions.size(), second.positions.size());
  for (std::size_t sample = 0; sample < count; ++sample)
    if (distance(reference, second, sample) > kPredictable) return sample;
  return count;
}

/// Verdicts on the end of a run.
struct LoadVerdict {
  int fallen = 0;
  bool moved = false;
  double largest = 0.0;  ///< displacement, m
};

LoadVerdict judge(const LoadRun& run) {
  const Thresholds thresholds;
  LoadVerdict verdict;
  for (std::size_t box = 0; box < run.positions.front().size(); ++box) {
    const Vec3 displacement = run.positions.back()[box] - run.positions.front()[box];
    verdict.fallen += -displacement.z() > thresholds.drop ? 1 : 0;
    verdict.moved = verdict.moved || displacement.norm() > thresholds.move;
    verdict.largest = std::max(verdict.largest, displacement.norm());
  }
  return verdict;
}

/// Ranks from 1; equal values get the mean of their ranks.
std::vector<double> ranks(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::vector<double> rank(values.size());
  for (std::size_t first = 0; first < order.size();) {
    std::size_t last = first;
    while (last + 1 < order.size() && values[order[last + 1]] == values[order[first]]) ++last;
    for (std::size_t i = first; i <= last; ++i) rank[order[i]] = 0.5 * static_cast<double>(first + last) + 1.0;
    first = last + 1;
  }
  return rank;
}

/// Spearman's rank correlation: Pearson's of the ranks. 1 for fewer than two values.
double rank_correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const std::vector<double> x = ranks(a);
  const std::vector<double> y = ranks(b);
  const double mean = 0.5 * (static_cast<double>(a.size()) + 1.0);
  double xy = 0.0, xx = 0.0, yy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xy += (x[i] - mean) * (y[i] - mean);
    xx += (x[i] - mean) * (x[i] - mean);
    yy += (y[i] - mean) * (y[i] - mean);
  }
  return xx > 0.0 && yy > 0.0 ? xy / std::sqrt(xx * yy) : 1.0;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0.0 : values[values.size() / 2];
}

EngineSetting reference(const char* name, double steps_per_second, int iterations) {
  return {"native", name, [=](Settings& settings) {
            settings.native.accuracy = Accuracy::reference;
            settings.steps_per_second = steps_per_second;
            settings.native.iterations = iterations;
          }};
}

}  // namespace

std::vector<LoadWorld> load_worlds(std::span<const Layout> layouts) {
  struct Road {
    const char* name;
    Vec3 acceleration;  // in g
  };
  const Road roads[] = {{"brake 0.8 g", {0.8, 0, 0}},
                        {"rearward 0.5 g", {-0.5, 0, 0}},
                        {"corner left 0.5 g", {0, -0.5, 0}},
                        {"corner right 0.5 g", {0, 0.5, 0}}};
  std::vector<LoadWorld> worlds;
  for (const Layout& layout : layouts) {
    for (const Road& road : roads) {
      LoadWorld& world =
          worlds.emplace_back(LoadWorld{layout.name, road.name, empty_scene({5.87, 2.33, 2.20}, kFriction)});
      for (const Box& box : layout.boxes)
        world.scene.boxes.push_back(standing_box(box.corner_max - box.corner_min, box.corner_min));
      world.scene.then(0.5, Vec3::Zero())
          .then(1.0, world.scene.settings.gravity * road.acceleration)
          .then(0.5, Vec3::Zero());
    }
  }
  return worlds;
}

LoadRun run_load(Laboratory& laboratory, const LoadWorld& world) {
  LoadRun run;
  const RunCost before = laboratory.cost();
  std::vector<Vec3> last;
  double last_time = 0.0;
  const Outcome outcome = laboratory.run(world.scene, [&](const Moment& moment) {
    const auto now = moment.state.position;
    if (run.positions.empty()) run.positions.emplace_back(now.begin(), now.end());
    while (static_cast<double>(run.positions.size()) * kSampleInterval <= moment.time + kSameInstant) {
      const double time = static_cast<double>(run.positions.size()) * kSampleInterval;
      const double share = std::min(1.0, (time - last_time) / (moment.time - last_time));
      std::vector<Vec3>& sample = run.positions.emplace_back();
      for (std::size_t box = 0; box < now.size(); ++box)
        sample.emplace_back(last[box] + share * (now[box] - last[box]));
    }
    last.assign(now.begin(), now.end());
    last_time = moment.time;
    return true;
  });
  run.failed = outcome.stop_reason == StopReason::failed;
  run.cpu_seconds = laboratory.cost().cpu_seconds - before.cpu_seconds;
  run.box_seconds = laboratory.cost().box_seconds - before.box_seconds;
  return run;
}

std::vector<Measurement> compare_loads(std::span<const LoadRun> runs, std::span<const LoadRun> reference,
                                       std::span<const LoadRun> second) {
  std::vector<double> errors, largest, reference_largest;
  double fell_differs = 0.0, moved_differs = 0.0, count_difference = 0.0, failed = 0.0;
  for (std::size_t world = 0; world < runs.size(); ++world) {
    if (runs[world].failed) {
      failed += 1.0;
      continue;
    }
    double error = 0.0;
    const std::size_t samples = predictable_samples(reference[world], second[world]);
    for (std::size_t i = 0; i < samples; ++i) error = std::max(error, distance(runs[world], reference[world], i));
    errors.push_back(error);
    const LoadVerdict verdict = judge(runs[world]);
    const LoadVerdict truth = judge(reference[world]);
    fell_differs += (verdict.fallen > 0) != (truth.fallen > 0) ? 1.0 : 0.0;
    moved_differs += verdict.moved != truth.moved ? 1.0 : 0.0;
    count_difference += std::abs(verdict.fallen - truth.fallen);
    largest.push_back(verdict.largest);
    reference_largest.push_back(truth.largest);
  }
  const double count = static_cast<double>(runs.size());
  const double worst = errors.empty() ? 0.0 : *std::max_element(errors.begin(), errors.end());
  const double correlation = rank_correlation(largest, reference_largest);
  const auto share = [&](const char* metric, double number) {
    return scaled(metric, number / count, 0.0, 1.0, ToleranceClass::coarse);
  };
  return {scaled("displacement error while predictable, median (m)", median(errors), 0.0, kMetre, ToleranceClass::good),
          scaled("displacement error while predictable, largest (m)", worst, 0.0, kMetre, ToleranceClass::good),
          share("share of loads where 'any fell' differs", fell_differs),
          share("share of loads where 'any moved > 10 cm' differs", moved_differs),
          share("mean difference of the number of fallen boxes", count_difference),
          scaled("rank correlation of the largest displacement", correlation, 1.0, 1.0, ToleranceClass::coarse),
          share("share of loads that failed", failed)};
}

const std::vector<EngineSetting>& load_references() {
  static const std::vector<EngineSetting> kReferences = {reference("1440 Hz, 100 it", 1440, 100),
                                                         reference("960 Hz, 200 it", 960, 200)};
  return kReferences;
}

}  // namespace holdfast::internal
