#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>

#include "holdfast/holdfast.hpp"

namespace first_failure_test {

namespace {

using holdfast::Layout;
using holdfast::Screen;
using holdfast::ScreenOptions;
using holdfast::Verdict;
using holdfast::WorldOutcome;

/// The files of a folder of `configs`, by name.
std::vector<std::string> bundled(const char* folder) {
  std::vector<std::string> paths;
  for (const auto& entry : std::filesystem::directory_iterator(HOLDFAST_SOURCE_DIR "/configs/" + std::string(folder)))
    paths.push_back(entry.path().string());
  std::sort(paths.begin(), paths.end());
  return paths;
}

std::vector<holdfast::Acceleration> bundled_accelerations() {
  std::vector<holdfast::Acceleration> accelerations;
  for (const std::string& path : bundled("accelerations")) accelerations.push_back(holdfast::read_acceleration(path));
  return accelerations;
}

std::vector<Layout> bundled_layouts(const Screen& screen) {
  std::vector<Layout> layouts;
  for (const std::string& path : bundled("layouts")) layouts.push_back(screen.read_layout(path));
  return layouts;
}

bool same(const WorldOutcome& a, const WorldOutcome& b) {
  return a.verdict == b.verdict && a.state_hash == b.state_hash && a.end_time == b.end_time && a.steps == b.steps &&
         a.status == b.status && a.message == b.message && a.peak_displacement == b.peak_displacement;
}

bool is_failure(const WorldOutcome& world) {
  return world.verdict != Verdict::stayed && world.verdict != Verdict::failed && world.verdict != Verdict::not_needed;
}

/// Layouts of one box, in a number that makes several blocks; every third one is tall, and tips before it slides.
std::vector<Layout> boxes(std::size_t count) {
  std::vector<Layout> layouts(count);
  for (std::size_t i = 0; i < count; ++i)
    layouts[i].boxes = {{{2.0, 1.0, 0.0}, {2.3, 1.3, i % 3 == 0 ? 1.2 : 0.2 + 0.001 * static_cast<double>(i)}, 1}};
  return layouts;
}

/// Weak ones, and strong ones across and along the container.
std::vector<holdfast::Acceleration> pushes() {
  return {{"weak", {{0.0, 0.4, {0.5, 0.0, 0.0}}}},
          {"tips", {{0.0, 0.6, {0.0, 4.0, 0.0}}}},
          {"slides", {{0.0, 0.6, {7.0, 0.0, 0.0}}}}};
}

}  // namespace

TEST_CASE("first_failure: of the bundled worlds those that are simulated are what they are without it",
          "[api][first_failure]") {
  Screen all(bundled_accelerations(), {.accuracy = "screening"});
  Screen until(bundled_accelerations(), {.accuracy = "screening", .first_failure = true});
  const std::vector<Layout> layouts = bundled_layouts(all);
  const std::vector<WorldOutcome> whole = all.evaluate(layouts);
  const std::vector<WorldOutcome> worlds = until.evaluate(layouts);
  const std::size_t count = all.accelerations().size();
  double time = 0.0;
  double saved = 0.0;
  for (std::size_t layout = 0; layout < layouts.size(); ++layout) {
    std::size_t failures = 0;
    std::size_t not_needed = 0;
    bool holds = true;
    for (std::size_t i = layout * count; i < (layout + 1) * count; ++i) {
      CAPTURE(layouts[layout].name, i % count);
      time += whole[i].end_time;
      holds = holds && !is_failure(whole[i]);
      failures += is_failure(worlds[i]) ? 1U : 0U;
      if (worlds[i].verdict != Verdict::not_needed) {
        CHECK(same(worlds[i], whole[i]));
        continue;
      }
      ++not_needed;
      saved += whole[i].end_time;
      CHECK(worlds[i].status == holdfast::status::not_needed);
      CHECK(worlds[i].stop_reason == holdfast::StopReason::not_run);
      CHECK(worlds[i].boxes == 0);
      CHECK(worlds[i].message.starts_with("the layout does not hold "));
    }
    CHECK(failures == (holds ? 0 : 1));
    if (holds) CHECK(not_needed == 0);
  }
  WARN(100.0 * saved / time << " % of the simulated time is not needed");
  CHECK(saved > 0.0);
}

TEST_CASE("first_failure: which worlds are simulated does not depend on threads and schedulers",
          "[api][first_failure]") {
  const std::vector<Layout> layouts = boxes(40);
  Screen serial(pushes(), {.accuracy = "screening", .scheduler = "serial", .first_failure = true});
  const std::vector<WorldOutcome> expected = serial.evaluate(layouts);
  for (const int threads : {1, 2, 5}) {
    Screen screen(pushes(), {.accuracy = "screening", .threads = threads, .first_failure = true});
    for (int repeat = 0; repeat < 2; ++repeat) {
      const std::vector<WorldOutcome> worlds = screen.evaluate(layouts);
      REQUIRE(worlds.size() == expected.size());
      for (std::size_t i = 0; i < worlds.size(); ++i) CHECK(same(worlds[i], expected[i]));
    }
  }
}

TEST_CASE("first_failure: after the first block the acceleration that rejects most layouts comes first",
          "[api][first_failure]") {
  Screen screen(pushes(), {.accuracy = "screening", .first_failure = true});
  const std::vector<WorldOutcome> worlds = screen.evaluate(boxes(20));
  // In the given order a flat box is tried by all; from the ninth layout on "slides", which rejected most, comes first.
  CHECK(worlds[3 * 1].verdict == Verdict::stayed);
  CHECK(worlds[3 * 1 + 2].verdict == Verdict::moved);
  for (std::size_t layout = 8; layout < 20; ++layout) {
    CHECK(worlds[3 * layout].verdict == Verdict::not_needed);
    CHECK(worlds[3 * layout + 1].verdict == Verdict::not_needed);
    CHECK(is_failure(worlds[3 * layout + 2]));
  }
}

TEST_CASE("first_failure: a layout that is submitted takes the accelerations in their order", "[api][first_failure]") {
  Screen screen(pushes(), {.accuracy = "screening", .threads = 2, .first_failure = true});
  const std::vector<Layout> layouts = boxes(12);
  for (const Layout& layout : layouts) REQUIRE(screen.submit(layout));
  holdfast::FinishedLayout finished;
  for (std::size_t i = 0; i < layouts.size(); ++i) {
    REQUIRE(screen.poll(finished, 60.0, holdfast::PollOrder::as_submitted));
    CHECK(finished.worlds[0].verdict == Verdict::stayed);
    CHECK(is_failure(finished.worlds[i % 3 == 0 ? 1 : 2]));
    CHECK((finished.worlds[2].verdict == Verdict::not_needed) == (i % 3 == 0));
  }
}

TEST_CASE("first_failure: goes together with StopWhen", "[api][first_failure]") {
  Screen screen(pushes(), {.accuracy = "screening", .stop_when = "moved", .first_failure = true});
  const std::vector<WorldOutcome> worlds = screen.evaluate(boxes(1));
  CHECK(worlds[0].verdict == Verdict::stayed);
  CHECK(worlds[1].stop_reason == holdfast::StopReason::decided);
  CHECK(worlds[2].verdict == Verdict::not_needed);
}

}  // namespace first_failure_test
