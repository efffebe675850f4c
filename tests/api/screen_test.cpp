#include <atomic>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <thread>

#include "holdfast/holdfast.hpp"
#include "io/results/results_reader.hpp"

namespace screen_test {

namespace {

using holdfast::Layout;
using holdfast::LengthUnit;
using holdfast::Screen;
using holdfast::Verdict;
using holdfast::WorldOutcome;

/// A container at constant acceleration along x for a second, m/s².
holdfast::Acceleration constant(double acceleration, const char* name = "constant") {
  return {name, {{0.0, 1.0, {acceleration, 0.0, 0.0}}}};
}

/// One box of 0.5 m a side in the middle of the floor.
Layout one_box(const char* name = "one") { return {name, {{{2.0, 1.0, 0.0}, {2.5, 1.5, 0.5}, 1}}}; }

Layout sample() { return Screen({constant(1.0)}).read_layout(HOLDFAST_SOURCE_DIR "/configs/layouts/seed_example.txt"); }

}  // namespace

TEST_CASE("screen: a box stays below its limit of friction and slides by Coulomb's law above it", "[api][screen]") {
  Screen screen({constant(4.8, "below"), constant(7.0, "above")});
  const std::vector<Layout> layouts = {one_box()};
  const std::vector<WorldOutcome> worlds = screen.evaluate(layouts);
  REQUIRE(worlds.size() == 2);
  CHECK(worlds[0].verdict == Verdict::stayed);
  CHECK(worlds[0].peak_displacement == 0.0F);
  CHECK(worlds[0].stop_reason == holdfast::StopReason::sleeping);
  CHECK(worlds[0].end_time == 1.0);
  CHECK(worlds[1].acceleration == 1);
  CHECK(worlds[1].verdict == Verdict::moved);
  // The friction coefficient of a box on the floor is 0.5: it has the speed v = 7 − 0.5 · 9.81 after 1 s, and slides
  // on until it stands, v²/2 / (0.5 · 9.81).
  const double speed = 7.0 - 0.5 * 9.81;
  CHECK(worlds[1].end_displacement == Approx(0.5 * speed + 0.5 * speed * speed / (0.5 * 9.81)).epsilon(1e-3));
  CHECK(worlds[1].peak_displacement == worlds[1].end_displacement);
  CHECK(worlds[1].critical_box == 1);
  CHECK(worlds[1].boxes == 1);
  CHECK(worlds[1].moved == 1);
}

TEST_CASE("screen: results depend neither on threads, nor on the batch, nor on earlier calls", "[api][screen]") {
  const std::vector<Layout> layouts = {sample(), one_box(), sample()};
  const std::vector<holdfast::Acceleration> accelerations = {constant(3.0), constant(8.0)};
  Screen serial(accelerations, {.accuracy = "screening", .scheduler = "serial"});
  Screen parallel(accelerations, {.accuracy = "screening", .threads = 3});
  const std::vector<WorldOutcome> expected = serial.evaluate(layouts);
  REQUIRE(expected.size() == 6);
  CHECK(expected[0].state_hash == expected[4].state_hash);
  for (int repeat = 0; repeat < 2; ++repeat) {
    const std::vector<WorldOutcome> worlds = parallel.evaluate(layouts);
    for (std::size_t i = 0; i < worlds.size(); ++i) CHECK(worlds[i].state_hash == expected[i].state_hash);
  }
  for (std::size_t i = 0; i < layouts.size(); ++i) {
    const std::vector<WorldOutcome> alone = parallel.evaluate({&layouts[i], 1});
    for (std::size_t j = 0; j < 2; ++j) CHECK(alone[j].state_hash == expected[2 * i + j].state_hash);
  }
}

TEST_CASE("screen: forces on the sides are there on request, with the limits of a norm", "[api][screen][walls]") {
  const std::vector<Layout> layouts = {one_box()};
  CHECK(Screen({constant(4.0)}).evaluate(layouts)[0].walls.empty());
  Screen screen({constant(4.0)}, {.settings = {{"Screening", "Walls", "en283"}}});
  const std::vector<holdfast::WallForce> walls = screen.evaluate(layouts)[0].walls;
  REQUIRE(walls.size() == 8);
  const double weight = 250.0 * 0.125 * 9.81;
  CHECK(walls[0].peak_force == Approx(weight));
  CHECK(walls[0].lasting_force == Approx(weight));
  CHECK(walls[0].peak_point[2] == Approx(0.0).margin(1e-9));
  CHECK(std::isnan(walls[0].limit));
  CHECK(walls[0].impulse[0] == Approx(-weight / 9.81 * 4.0));
  CHECK(walls[1].peak_force == 0.0);
  CHECK(walls[1].limit == Approx(0.4 * weight));
  CHECK_THROWS_WITH(
      Screen({constant(4.0)}, {.settings = {{"Screening", "WallForces", "yes"}}, .engine = "native-plain"}),
      Catch::Contains("wall forces are not measured by this engine"));
}

TEST_CASE("screen: boxes and series are there on request, and agree with the verdict", "[api][screen]") {
  Screen screen({constant(7.0)}, {.keep_boxes = true, .keep_series = true});
  const std::vector<Layout> layouts = {sample()};
  const WorldOutcome world = screen.evaluate(layouts)[0];
  REQUIRE(world.box_outcomes.size() == world.boxes);
  std::uint32_t moved = 0;
  for (const holdfast::BoxOutcome& box : world.box_outcomes) moved += box.moved ? 1U : 0U;
  CHECK(moved == world.moved);
  REQUIRE(world.series.time.size() > 2);
  CHECK(world.series.time.front() == 0.0);
  CHECK(world.series.time.back() == world.end_time);
  const std::size_t rows = world.series.time.size() * world.boxes;
  REQUIRE(world.series.displacement.size() == rows);
  REQUIRE(world.series.orientation.size() == rows);
  for (std::size_t box = 0; box < world.boxes; ++box)
    CHECK(world.series.displacement[rows - world.boxes + box] == world.box_outcomes[box].end_displacement);
}

TEST_CASE("screen: centimetres give the bits of a layout file, and metres that look like them are refused",
          "[api][screen]") {
  const char* const path = HOLDFAST_SOURCE_DIR "/configs/layouts/seed_example.txt";
  Screen metres({constant(8.0)});
  Screen centimetres({constant(8.0)}, {.unit = LengthUnit::centimetre});
  const std::vector<Layout> in_metres = {metres.read_layout(path)};
  const std::vector<Layout> in_centimetres = {centimetres.read_layout(path)};
  CHECK(in_centimetres[0].boxes[0].corner_max[0] == std::round(in_centimetres[0].boxes[0].corner_max[0]));
  CHECK(metres.evaluate(in_metres)[0].state_hash == centimetres.evaluate(in_centimetres)[0].state_hash);
  CHECK_THROWS_WITH(metres.evaluate(in_centimetres), Catch::Contains("seem to be centimetres"));
}

TEST_CASE("screen: a bad layout raises with layout, box and value, or is marked and leaves the others alone",
          "[api][screen]") {
  Layout bad = one_box("bad one");
  bad.boxes.push_back(bad.boxes[0]);
  const std::vector<Layout> layouts = {one_box(), bad};
  Screen strict({constant(1.0)});
  try {
    strict.evaluate(layouts);
    FAIL("nothing was thrown");
  } catch (const holdfast::Error& error) {
    REQUIRE(error.problems().size() == 1);
    CHECK(error.problems()[0].file == "bad one");
    CHECK(error.problems()[0].what == "box 2 overlaps box 1");
    CHECK(error.problems()[0].value == "500 mm deep");
  }
  Screen tolerant({constant(1.0)}, {.bad_layouts = holdfast::BadLayouts::mark});
  const std::vector<WorldOutcome> worlds = tolerant.evaluate(layouts);
  CHECK(worlds[0].verdict == Verdict::stayed);
  CHECK(worlds[1].verdict == Verdict::failed);
  CHECK(worlds[1].status == holdfast::status::bad_layout);
  CHECK(worlds[1].stop_reason == holdfast::StopReason::not_run);
  CHECK(worlds[1].fallen == 0);
  CHECK_THAT(worlds[1].message, Catch::Contains("overlaps"));
}

TEST_CASE("screen: what cannot be used is an error when the screen is made", "[api][screen]") {
  CHECK_THROWS_WITH(Screen(std::vector<holdfast::Acceleration>()), Catch::Contains("at least one acceleration"));
  CHECK_THROWS_WITH(Screen({holdfast::Acceleration{"none", {}}}),
                    Catch::Contains("none: the acceleration has no segments"));
  CHECK_THROWS_WITH(Screen({constant(1e5)}), Catch::Contains("segment 1: ax is too large"));
  CHECK_THROWS_WITH(Screen({constant(1.0)}, {.engine = "warp"}), Catch::Contains("accepted are native, bullet"));
  CHECK_THROWS_WITH(Screen({constant(1.0)}, {.accuracy = "perfect"}), Catch::Contains("unknown accuracy: perfect"));
  CHECK_THROWS_WITH(Screen({constant(1.0)}, {.config = "[Container]\nLenght = 3\n"}), Catch::Contains("config:2"));
  CHECK_THROWS_WITH(holdfast::read_acceleration("/nowhere.txt"), Catch::Contains("/nowhere.txt: cannot be read"));
}

TEST_CASE("screen: cancel ends a call from another thread, and the next call is whole", "[api][screen]") {
  Screen screen({constant(8.0)}, {.accuracy = "reference", .threads = 2});
  const std::vector<Layout> layouts(20, sample());
  std::atomic<bool> done = false;
  std::thread canceller([&] {
    while (!done) screen.cancel();
  });
  const std::vector<WorldOutcome> worlds = screen.evaluate(layouts);
  done = true;
  canceller.join();
  REQUIRE(worlds.size() == 20);
  CHECK(worlds.back().stop_reason == holdfast::StopReason::not_run);
  CHECK(worlds.back().verdict == Verdict::failed);
  CHECK(screen.cancelled());
  const std::vector<Layout> one = {one_box()};
  CHECK(screen.evaluate(one)[0].stop_reason == holdfast::StopReason::sleeping);
  CHECK_FALSE(screen.cancelled());
}

TEST_CASE("screen: a type of a configuration gives what no key gives beside it", "[api][screen]") {
  const std::vector<Layout> one = {{"", {{{4.0, 1.0, 0.0}, {4.5, 1.5, 0.5}, 1}}}};
  const auto with = [&](const std::string& config, const std::vector<holdfast::Setting>& settings) {
    Screen screen({constant(1.0)}, {.config = config, .settings = settings});
    return screen.evaluate(one)[0].verdict;
  };
  CHECK(with("[Container]\nType = 20\n", {}) == Verdict::stayed);
  CHECK_THROWS_WITH(with("[Container]\nType = 20\nLength = 300\n", {}), Catch::Contains("outside the container"));
  CHECK_THROWS_WITH(with("[Container]\nLength = 300\n", {{"Container", "Type", "20"}}),
                    Catch::Contains("outside the container"));
}

TEST_CASE("screen: a record is the results file of the same verdicts, resumed or refused when it is there",
          "[api][screen]") {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "holdfast_screen_test";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  const std::string path = (folder / "results.h5").string();
  Screen screen({constant(3.0), constant(8.0)}, {.accuracy = "screening"});
  const std::vector<Layout> layouts = {sample(), one_box()};
  CHECK(screen.record(layouts, path));
  const std::vector<WorldOutcome> expected = screen.evaluate(layouts);
  auto results = holdfast::internal::ResultsReader::open(path);
  REQUIRE(results);
  const auto rows = results->worlds(0, 4);
  REQUIRE(rows);
  for (std::size_t i = 0; i < 4; ++i) CHECK((*rows)[i].state_hash == expected[i].state_hash);
  CHECK(results->info().layouts == std::vector<std::string>{"seed_example.txt", "one"});
  CHECK_THROWS_WITH(screen.record(layouts, path), Catch::Contains("exists already"));
  CHECK(screen.record(layouts, path, {.resume = true}));
  CHECK_THROWS_WITH(screen.record({&layouts[1], 1}, path, {.resume = true}), Catch::Contains("layouts"));
  CHECK(screen.record({&layouts[1], 1}, path, {.overwrite = true}));
  std::filesystem::remove_all(folder);
}

TEST_CASE("screen: engines are listed, the default first, and the version is that of the header", "[api][screen]") {
  CHECK(holdfast::engines().front().name == "native");
  CHECK(holdfast::engines().front().missing.empty());
  int major = 0;
  int minor = 0;
  int patch = 0;
  REQUIRE(std::sscanf(holdfast::version(), "%d.%d.%d", &major, &minor, &patch) == 3);
  CHECK(HOLDFAST_VERSION == 10000 * major + 100 * minor + patch);
}

TEST_CASE("screen: a world ends when its verdict is decided, and the others stay what they are", "[api][screen]") {
  const std::vector<holdfast::Acceleration> accelerations = {constant(4.8, "below"), constant(7.0, "above")};
  const std::vector<Layout> layouts = {one_box()};
  const std::vector<WorldOutcome> whole = Screen(accelerations).evaluate(layouts);
  const std::vector<WorldOutcome> early = Screen(accelerations, {.stop_when = "moved"}).evaluate(layouts);
  CHECK(early[0].verdict == Verdict::stayed);
  CHECK(early[0].state_hash == whole[0].state_hash);
  CHECK(early[1].verdict == Verdict::moved);
  CHECK(early[1].status == holdfast::status::ok);
  CHECK(early[1].stop_reason == holdfast::StopReason::decided);
  CHECK(early[1].moved == 1);
  // 0.1 m at 7 − 0.5 · 9.81 m/s².
  CHECK(early[1].end_time == Approx(std::sqrt(2 * 0.1 / (7.0 - 0.5 * 9.81))).margin(1.0 / 240));
  const std::vector<WorldOutcome> by_key =
      Screen(accelerations, {.settings = {{"Screening", "StopWhen", "moved"}}}).evaluate(layouts);
  CHECK(by_key[1].state_hash == early[1].state_hash);
  CHECK(Screen(accelerations, {.stop_when = "fallen"}).evaluate(layouts)[1].verdict == Verdict::moved);
  CHECK_THROWS_WITH(Screen(accelerations, {.stop_when = "never"}), Catch::Contains("end, moved or fallen"));
}

TEST_CASE("screen: what holds is what stays under every acceleration", "[api][screen]") {
  const std::vector<Layout> layouts = {one_box(), sample(), one_box()};
  for (const double strong : {4.8, 7.0}) {
    Screen screen({constant(3.0), constant(strong)}, {.accuracy = "screening"});
    const std::vector<WorldOutcome> worlds = screen.evaluate(layouts);
    const std::vector<bool> holds = screen.holds(layouts);
    REQUIRE(holds.size() == layouts.size());
    for (std::size_t i = 0; i < layouts.size(); ++i)
      CHECK(holds[i] == (worlds[2 * i].verdict == Verdict::stayed && worlds[2 * i + 1].verdict == Verdict::stayed));
    CHECK(holds[0] == (strong < 5.0));
    CHECK(holds[2] == holds[0]);
  }
  CHECK(Screen({constant(1.0), constant(2.0)}).holds(std::vector<Layout>{}).empty());
}

TEST_CASE("screen: accelerations of a norm that are for sliding or tipping alone are never cut short",
          "[api][screen]") {
  Screen screen(holdfast::ScreenOptions{.norm = "rail-en12195", .stop_when = "moved"});
  const std::vector<Layout> layouts = {one_box()};
  const std::vector<WorldOutcome> worlds = screen.evaluate(layouts);
  CHECK(screen.accelerations()[0].purpose == "sliding");
  CHECK(worlds[0].verdict == Verdict::moved);  // 1 g against a friction of 0.5
  CHECK(worlds[0].stop_reason == holdfast::StopReason::sleeping);
}

}  // namespace screen_test
