#include "app/world_json.hpp"

#include <catch2/catch.hpp>
#include <limits>

namespace world_json_test {

using namespace holdfast::internal;

namespace {

WorldRecord record_of_two_boxes() {
  WorldRecord world;
  world.row.stop_reason = StopReason::timeout;
  world.row.caveats = Caveat::marginal;
  world.row.boxes = 2;
  world.row.end_time = 2.5;
  world.row.steps = 600;
  world.row.steps_skipped = 5;
  world.row.max_penetration = 0.125;
  world.row.state_hash = 0xab;
  world.row.cpu_seconds = 0.25;
  world.row.peak_total_kinetic_energy = 8;
  visit_ends<EndTable>([&](const OutcomeField&, auto member) { (world.end.*member).resize(2); });
  world.end.end_displacement = {{0, 0, -0.5F}, {}};
  world.end.end_tilt = {45, 0};
  world.end.end_kinetic_energy = {1.5F, 0};
  world.end.peak_displacement = {0.75F, 0};
  world.end.peak_drop = {0.75F, 0};
  world.end.peak_tilt = {45, 0};
  world.end.first_beyond = {0.5F, std::numeric_limits<float>::quiet_NaN()};
  return world;
}

}  // namespace

TEST_CASE("world_json: all of a world on one line, in this order", "[app][world_json]") {
  CHECK(
      world_json(record_of_two_boxes(), "a.txt", "b.txt", 7, {}, 0.75) ==
      R"({"world":7,"layout":"a.txt","acceleration":"b.txt","verdict":"fell","status":"ok","status_text":"","status_time_s":null,"caveats":"marginal","stop_reason":"timeout",)"
      R"("boxes":2,"fallen_boxes":1,"unstable_boxes":0,"moved_boxes":1,"tilted_boxes":1,)"
      R"("fallen_at_end":1,"critical_box":1,"peak_displacement_m":0.75,"peak_drop_m":0.75,"peak_tilt_deg":45.0,)"
      R"("end_displacement_m":0.5,"peak_kinetic_energy_J":8.0,"end_kinetic_energy_J":1.5,"end_time_s":2.5,"steps":600,"steps_skipped":5,"max_residual":0.0,"residual_scale":0.0,)"
      R"("max_penetration_m":0.125,"cpu_seconds":0.25,"state_hash":"00000000000000ab","time_saved_s":0.75})");
}

TEST_CASE("world_json: counts follow the thresholds", "[app][world_json]") {
  const std::string json = world_json(record_of_two_boxes(), "a", "b", 0, {.drop = 1, .move = 1, .tilt = 50}, 0.0);
  CHECK(json.find(R"("fallen_boxes":0,"unstable_boxes":0,"moved_boxes":0,"tilted_boxes":0)") != std::string::npos);
}

TEST_CASE("world_json: a bad layout is a row without boxes, and nothing is said of them", "[app][world_json]") {
  WorldRecord world;
  world.row.status = Status::bad_layout;
  world.row.message = "a.txt:3: box 1 has no \"height\"";
  const std::string json = world_json(world, "a.txt", "b.txt", 0, {}, 0.0);
  CHECK(
      json.find(
          R"("status":"bad_layout","status_text":"a.txt:3: box 1 has no \"height\"","status_time_s":null,"caveats":"","stop_reason":"not_run")") !=
      std::string::npos);
  CHECK(json.find(R"("verdict":"failed")") != std::string::npos);
  CHECK(json.find(R"("boxes":0,"fallen_boxes":null,"unstable_boxes":null,"moved_boxes":null,"tilted_boxes":null,)"
                  R"("fallen_at_end":null,"critical_box":null,"peak_displacement_m":null,)") != std::string::npos);
}

TEST_CASE("world_json: names that are not UTF-8, and line breaks, stay one line of valid JSON", "[app][world_json]") {
  const std::string json = world_json(record_of_two_boxes(), "a\xff.txt", "b\n.txt", 0, {}, 0.0);
  CHECK(json.find("a\xEF\xBF\xBD.txt") != std::string::npos);
  CHECK(json.find("b\\n.txt") != std::string::npos);
  CHECK(json.find('\n') == std::string::npos);
}

TEST_CASE("world_json: numbers that are not finite are null", "[app][world_json]") {
  WorldRecord world = record_of_two_boxes();
  world.row.max_residual = std::numeric_limits<double>::infinity();
  CHECK(world_json(world, "a", "b", 0, {}, 0.0).find(R"("max_residual":null)") != std::string::npos);
}

}  // namespace world_json_test
