// A world that ends early says so, and takes nothing back: every other verdict is that of the whole run.

#include <cmath>
#include <cstring>
#include <filesystem>
#include <vector>

#include "core/native/native_engine.hpp"
#include "io/input/acceleration_reader.hpp"
#include "physics/measures.hpp"

namespace early_end_test {

using namespace holdfast::internal;
using namespace holdfast::internal::scenes;
using namespace holdfast::internal::physics;

namespace {

std::vector<Acceleration> bundled_accelerations() {
  std::vector<Acceleration> accelerations;
  for (const auto& entry : std::filesystem::directory_iterator(HOLDFAST_SOURCE_DIR "/configs/accelerations")) {
    const Result<TextFile> file = read_text_file(entry.path().string());
    REQUIRE(file);
    std::vector<Error> warnings;
    Result<Acceleration> acceleration = parse_acceleration(*file, warnings);
    REQUIRE(acceleration);
    accelerations.push_back(std::move(*acceleration));
  }
  return accelerations;
}

Verdict verdict_of(const WorldRecord& record, const Settings& settings) {
  const Thresholds thresholds = recording_plan(settings, true).thresholds;
  return judge_world(record.row, record.end, by_run(thresholds)).verdict;
}

/// Whether the samples of a world that ended early are the first ones of the whole world, the one at its end aside.
bool begins_like(const Series& early, const Series& whole) {
  const auto begins = [](const auto& part, const auto& all, std::size_t count) {
    return std::memcmp(part.data(), all.data(), count * sizeof(part[0])) == 0;
  };
  const std::size_t samples = early.time.size() - 1;
  const std::size_t rows = early.displacement.size() / early.time.size() * samples;
  return samples <= whole.time.size() && begins(early.time, whole.time, samples) &&
         begins(early.displacement, whole.displacement, rows) && begins(early.orientation, whole.orientation, rows);
}

}  // namespace

TEST_CASE("early_end: a world that ends early is at least what it says, and whether it stays does not depend on that",
          "[physics][early_end][slow]") {
  Settings settings;
  settings.native.accuracy = Accuracy::screening;
  std::vector<Layout> layouts;
  for (const char* name : kLayouts) layouts.push_back(bundled_layout(name, settings));
  const std::vector<Acceleration> accelerations = bundled_accelerations();
  std::vector<const Acceleration*> pointers;
  for (const Acceleration& acceleration : accelerations) pointers.push_back(&acceleration);
  const NativeEngine engine(settings);
  const std::vector<Run> whole = run_all(engine, layouts, pointers, settings);

  for (const StopWhen stop_when : {StopWhen::moved, StopWhen::fallen}) {
    settings.screening.stop_when = stop_when;
    const std::vector<Run> early = run_all(engine, layouts, pointers, settings);
    double time = 0.0;
    double saved = 0.0;
    std::size_t ended = 0;
    for (std::size_t i = 0; i < whole.size(); ++i) {
      const WorldRecord& all = whole[i].record;
      const WorldRecord& part = early[i].record;
      CAPTURE(layouts[i / accelerations.size()].name, i % accelerations.size(), static_cast<int>(stop_when));
      const Verdict given = verdict_of(part, settings);
      const Verdict expected = verdict_of(all, settings);
      CHECK((given == Verdict::stayed) == (expected == Verdict::stayed));
      time += all.row.end_time;
      if (all.row.stop_reason == StopReason::decided) {
        CHECK(to_string(expected) == "unstable");
        CHECK(to_string(given) == "unstable");
        continue;
      }
      if (part.row.stop_reason != StopReason::decided) {
        CHECK(to_string(given) == to_string(expected));
        CHECK(part.row.state_hash == all.row.state_hash);
        CHECK(part.row.end_time == all.row.end_time);
        continue;
      }
      ++ended;
      saved += time_saved(part.row.status, part.row.stop_reason, part.row.end_time, all.row.end_time);
      CHECK(part.row.end_time < all.row.end_time);
      CHECK((given == Verdict::moved || given == Verdict::fell));
      CHECK((expected == Verdict::moved || expected == Verdict::fell));
      CHECK((given == Verdict::moved || expected == Verdict::fell));  // at least
      for (std::size_t box = 0; box < part.end.first_beyond.size(); ++box)
        if (!std::isnan(part.end.first_beyond[box])) CHECK(part.end.first_beyond[box] == all.end.first_beyond[box]);
      CHECK(begins_like(part.series, all.series));
    }
    WARN((stop_when == StopWhen::moved ? "moved: " : "fallen: ")
         << ended << " of " << whole.size() << " worlds ended early, " << text(100.0 * saved / time)
         << " % of the time saved");
    CHECK(ended > 0);
  }
}

}  // namespace early_end_test
