#include "parallel/screening/unit_runner.hpp"

#include <catch2/catch.hpp>
#include <fstream>

#include "api/memory_run.hpp"
#include "core/engine/engine_support.hpp"
#include "io/input/layout_files.hpp"
#include "io/results/results_fixture.hpp"
#include "scenes.hpp"
#include "scripted_engine.hpp"

namespace unit_runner_test {

using namespace holdfast::internal;
using namespace holdfast::internal::scenes;
using results_fixture::Folder;

TEST_CASE(
    "unit_runner: a world that blows up is marked, as is one of a bad input, and the others are as they are alone",
    "[parallel][unit_runner]") {
  const Folder folder;
  const std::vector<std::string> paths = {folder / "a.txt"};
  std::ofstream(paths[0]) << "1 1\n0 0 0 80 59 106 1\n";
  const std::vector<ReadAcceleration> accelerations = {
      {constant(1.0, 0.5), ""}, {{}, "b.txt: is empty"}, {constant(2.0, 0.5), ""}, {constant(3.0, 0.5), ""}};
  const Settings settings = at_once();
  LayoutFiles layouts(paths, settings);
  const std::atomic<bool> abort = false;
  StageCosts costs;
  const auto worlds_of = [&](const Script& script) {
    const ScriptedEngine engine(script);
    UnitRunner runner(engine, settings, true, layouts, accelerations, abort, costs);
    const std::optional<UnitRecord> unit = runner.run({0, 1, 0, accelerations.size()}, 1);
    REQUIRE(unit);
    REQUIRE(unit->worlds.size() == accelerations.size());
    return unit->worlds;
  };
  const std::vector<WorldRecord> calm = worlds_of({});
  const std::vector<WorldRecord> worlds = worlds_of({.breaks_at = 0.2, .breaking_world = 1});

  CHECK(worlds[2].row.status == Status::non_finite);
  CHECK(worlds[2].row.stop_reason == StopReason::failed);
  CHECK(worlds[2].row.end_time <= 0.2);
  CHECK(worlds[2].row.message == "a state became infinite or undefined; try a smaller step");
  CHECK(worlds[1].row.status == Status::bad_acceleration);
  CHECK(worlds[1].row.stop_reason == StopReason::not_run);
  CHECK(worlds[1].row.message == "b.txt: is empty");
  for (const std::size_t i : {0U, 3U}) {
    CHECK(worlds[i].row.acceleration == i);
    CHECK(worlds[i].row.status == Status::ok);
    CHECK(worlds[i].row.message.empty());
    CHECK(worlds[i].row.state_hash == calm[i].row.state_hash);
  }
  CHECK(worlds[2].row.state_hash != calm[2].row.state_hash);
}

TEST_CASE("unit_runner: a series that would be too large is not begun, and the others are as they are alone",
          "[parallel][unit_runner]") {
  const Folder folder;
  const std::vector<std::string> paths = {folder / "a.txt", folder / "b.txt"};
  std::ofstream(paths[0]) << "1 1\n0 0 0 80 59 106 1\n";
  std::ofstream large(paths[1]);
  large << "1 201\n";
  for (int i = 0; i < 201; ++i) large << 2 * i << " 0 0 " << 2 * i + 2 << " 50 50 1\n";
  large.close();
  Settings settings = at_once();
  settings.results_interval = 1e-5;
  const std::vector<ReadAcceleration> accelerations = {{constant(1.0, 0.001), ""}, {constant(1.0, 1.0), ""}};
  LayoutFiles layouts(paths, settings);
  const std::atomic<bool> abort = false;
  StageCosts costs;
  const ScriptedEngine engine({});
  UnitRunner runner(engine, settings, true, layouts, accelerations, abort, costs);
  const std::optional<UnitRecord> unit = runner.run({0, 2, 0, 2}, 1);
  REQUIRE(unit);
  REQUIRE(unit->worlds.size() == 4);
  const std::vector<std::size_t> boxes = {1, 1, 201, 0};
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(unit->worlds[i].row.layout == i / 2);
    CHECK(unit->worlds[i].row.acceleration == i % 2);
    CHECK(unit->worlds[i].row.status == (i == 3 ? Status::too_large : Status::ok));
    CHECK(unit->worlds[i].boxes.id.size() == boxes[i]);
  }
  CHECK(unit->worlds[3].row.stop_reason == StopReason::not_run);
  CHECK(unit->worlds[3].row.message.find("samples of 201 boxes: 2010") != std::string::npos);
  UnitRunner without(engine, settings, false, layouts, accelerations, abort, costs);
  CHECK(without.run({1, 2, 1, 2}, 1)->worlds[0].row.status == Status::ok);
}

TEST_CASE("unit_runner: a layout with a mat cannot be used by an engine without, and the others can",
          "[parallel][unit_runner]") {
  std::vector<ReadLayout> read(2);
  for (ReadLayout& one : read) {
    one.layout = layout_of({box({1, 1, 0}, {1, 1, 1}), box({3, 1, 0}, {1, 1, 1})});
    one.layout.sha256 = "abc";
  }
  read[0].layout.name = "on mats";
  read[0].layout.boxes[1].mat = 0.6;
  read[0].layout.boxes[1].line = 7;
  const Settings settings = at_once();
  MemoryLayouts layouts(read);
  const std::vector<ReadAcceleration> accelerations = {{constant(1.0, 0.1), ""}};
  const std::atomic<bool> abort = false;
  StageCosts costs;
  const ScriptedEngine engine({});
  UnitRunner runner(engine, settings, true, layouts, accelerations, abort, costs);
  const std::optional<UnitRecord> unit = runner.run({0, 2, 0, 1}, 1);
  REQUIRE(unit);
  const WorldRow& refused = unit->worlds[0].row;
  CHECK(refused.status == Status::bad_layout);
  CHECK(refused.stop_reason == StopReason::not_run);
  CHECK(refused.message == "on mats:7: a box stands on an anti-slip mat, which this engine cannot model: " +
                               engine.traits().name + "; boxes without mats, or another engine, such as native");
  CHECK(unit->layouts[0].layout->boxes.empty());
  CHECK(unit->layouts[0].layout->sha256 == "abc");
  CHECK(unit->worlds[1].row.status == Status::ok);
  CHECK(unit->layouts[1].layout->boxes.size() == 2);
  for (const char* name : {"native", "native-plain", "bullet", "bullet-f64", "bullet-stock"}) {
    ReadLayout same = read[0];
    CHECK_FALSE(refuse_unsupported(same, *engine_of(name, settings), "on mats"));
    CHECK(same.error.empty());
    CHECK(same.layout.boxes.size() == 2);
  }
}

}  // namespace unit_runner_test
