// What must be true of verdicts and margins of any load, in every engine.

#include <cmath>
#include <string>
#include <vector>

#include "analyses/margins/margin_search.hpp"
#include "core/native/native_engine.hpp"
#include "random.hpp"
#include "same_bits.hpp"
#include "scenes.hpp"

namespace physics_verdict_test {

using namespace holdfast::internal;
using namespace holdfast::internal::scenes;

namespace {

/// Columns of one to three boxes side by side, in front of the front wall, with gaps of millimetres, which the boxes of
/// a column jut out over each other by centimetres.
Layout random_load(Random& random, int rows = 3) {
  Layout layout = layout_of({});
  double x = random.between(0.0, 0.03);
  for (int row = 0; row < rows; ++row) {
    double y = random.between(0.0, 0.02);
    double longest = 0.0;
    for (int column = 0; column < 2; ++column) {
      const Vec3 size(random.between(0.4, 0.9), random.between(0.4, 0.9), random.between(0.3, 0.8));
      double z = 0.0;
      for (std::uint32_t level = random.below(3) + 1; level > 0; --level) {
        const Vec3 above(size.x() * random.between(0.8, 1.0), size.y() * random.between(0.8, 1.0), 0.6 * size.z());
        layout.boxes.push_back(box({x, y, z}, z == 0.0 ? size : above));
        z += layout.boxes.back().corner_max.z() - layout.boxes.back().corner_min.z();
      }
      y += size.y() + random.between(0.001, 0.02);
      longest = std::max(longest, size.x());
    }
    x += longest + random.between(0.001, 0.02);
  }
  return layout;
}

/// Half a second at rest, and then pushes to and fro.
Acceleration random_acceleration(Random& random) {
  const Vec3 push = random.between(0.3, 0.9) * kGravity * random.vector(-1, 1).cwiseProduct(Vec3(1, 1, 0)).normalized();
  return acceleration_of({{0.25, Vec3::Zero()}, {random.between(0.1, 0.8), push}, {0.3, -0.5 * push}});
}

std::vector<WorldRecord> records_of(const Engine& engine, const std::vector<Layout>& layouts,
                                    const std::vector<const Acceleration*>& accelerations, const Settings& settings,
                                    bool series = true) {
  WorldBatch batch = batch_of(layouts, accelerations, settings);
  std::vector<std::unique_ptr<SeriesRecorder>> recorders;
  std::vector<Recorder*> watchers;
  for (std::size_t i = 0; i < batch.worlds.size(); ++i) {
    recorders.push_back(std::make_unique<SeriesRecorder>(recording_plan(settings, series)));
    watchers.push_back(recorders.back().get());
  }
  REQUIRE(simulate(engine, batch, settings, watchers, false));
  std::vector<WorldRecord> records;
  for (const auto& recorder : recorders) records.push_back(recorder->take());
  return records;
}

Verdict verdict_of(const WorldRecord& record, const Settings& settings) {
  return judge_world(record.row, record.end, by_run(recording_plan(settings, false).thresholds)).verdict;
}

/// The verdict and everything that it rests on have the same bits.
void check_same(const std::vector<WorldRecord>& a, const std::vector<WorldRecord>& b, const Settings& settings) {
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    CAPTURE(i);
    CHECK(verdict_of(a[i], settings) == verdict_of(b[i], settings));
    CHECK(a[i].row.state_hash == b[i].row.state_hash);
    visit_ends<EndTable>([&](const OutcomeField& field, auto member) {
      CAPTURE(field.name);
      CHECK(same_bits(a[i].end.*member, b[i].end.*member));
    });
  }
}

}  // namespace

TEST_CASE("verdict: whether a load stays depends neither on an early end nor on the samples, in any engine",
          "[physics][verdict][slow]") {
  const std::string name = GENERATE("native", "native-plain", "bullet", "bullet-stock", "bullet-opencl");
  Settings settings;
  settings.native.accuracy = Accuracy::screening;
  settings.steps_per_second = 60;
  const Result<std::unique_ptr<Engine>> engine = make_engine(name, settings);
  if (!engine) {
    WARN(name + " is skipped: " + engine.error().message());
    return;
  }
  const bool is_slow = name == "native-plain" || name == "bullet-opencl";
  settings.screening.settle_seconds = is_slow ? 0.25 : 2.0;
  settings.screening.run_out_seconds = is_slow ? 1.0 : 5.0;
  Random random(7);
  std::vector<Layout> layouts;
  std::vector<Acceleration> accelerations;
  for (int i = 0; i < (is_slow ? 1 : 2); ++i) layouts.push_back(random_load(random, is_slow ? 1 : 3));
  for (int i = 0; i < 2; ++i) accelerations.push_back(random_acceleration(random));
  // The last one moves nothing.
  accelerations.push_back(constant(0.1, 0.5));
  const std::vector<const Acceleration*> pointers = {&accelerations[0], &accelerations[1], &accelerations[2]};
  CAPTURE(name);

  const std::vector<WorldRecord> whole = records_of(**engine, layouts, pointers, settings);
  std::size_t stayed = 0;
  for (const StopWhen stop_when : {StopWhen::moved, StopWhen::fallen}) {
    Settings early = settings;
    early.screening.stop_when = stop_when;
    const std::vector<WorldRecord> ended = records_of(**engine, layouts, pointers, early);
    for (std::size_t i = 0; i < whole.size(); ++i) {
      CAPTURE(i);
      const bool stays = verdict_of(whole[i], settings) == Verdict::stayed;
      CHECK((verdict_of(ended[i], settings) == Verdict::stayed) == stays);
      stayed += stays ? 1 : 0;
    }
  }
  CAPTURE(stayed);
  CHECK((name == "bullet-stock" || stayed > 0));  // whose boxes creep
  CHECK(stayed < 2 * whole.size());

  Settings sampled = settings;
  sampled.results_interval = 0.0371;
  check_same(whole, records_of(**engine, layouts, pointers, sampled), settings);
  check_same(whole, records_of(**engine, layouts, pointers, settings, false), settings);
}

TEST_CASE("verdict: below a margin a load stays, however short it is pushed, and above it it does not",
          "[physics][verdict]") {
  Settings settings;
  settings.native.accuracy = Accuracy::screening;
  Random random(3);
  const NativeEngine engine(settings);
  int below = 0, exceptions = 0;
  for (int i = 0; i < 12; ++i) {
    const Layout layout = random_load(random);
    const auto margins = find_margins(engine, layout, settings, false);
    REQUIRE(margins);
    for (std::size_t direction = 0; direction < kDirectionCount; ++direction) {
      const double margin = margins->margin_within_limits.at(direction);
      const auto stays = [&](double size, double seconds) {
        const Acceleration push = acceleration_of({{seconds, push_acceleration(direction, size)}});
        return verdict_of(records_of(engine, {layout}, {&push}, settings, false).front(), settings) == Verdict::stayed;
      };
      CAPTURE(i, direction, margin);
      CHECK(margins->margin.at(direction) <= margin);
      if (margin < kLargestMargin) CHECK_FALSE(stays(margin + 0.01, kMarginDuration));
      for (const double share : {0.5, 0.9, 1.0}) {
        for (const double seconds : {0.2, 0.6, kMarginDuration}) {
          ++below;
          if (!stays(share * margin, seconds)) ++exceptions;
        }
      }
    }
  }
  WARN(exceptions << " of " << below << " worlds below a margin do not stay");
  CHECK(exceptions <= below / 100);
}

}  // namespace physics_verdict_test
