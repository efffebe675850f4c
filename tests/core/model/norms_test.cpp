#include "core/model/norms.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "io/input/acceleration_reader.hpp"
#include "io/input/text_file.hpp"

namespace norms_test {

using namespace holdfast::internal;

namespace {

std::vector<Acceleration> made(const char* name) {
  const Result<ChosenNorm> norm = find_norm(name);
  REQUIRE(norm);
  return norm->accelerations();
}

std::vector<std::string> names_of(const std::vector<Acceleration>& accelerations) {
  std::vector<std::string> names;
  for (const Acceleration& acceleration : accelerations) names.push_back(acceleration.name);
  return names;
}

/// The strongest segment's acceleration.
Vec3 peak(const Acceleration& acceleration) {
  Vec3 strongest = Vec3::Zero();
  for (const Segment& segment : acceleration.segments)
    if (segment.acceleration.norm() > strongest.norm()) strongest = segment.acceleration;
  return strongest;
}

std::string message_of(const char* name) {
  const Result<ChosenNorm> norm = find_norm(name);
  return norm ? "" : norm.error().message();
}

}  // namespace

TEST_CASE("norms: those of the road are the bundled files, number by number", "[core][norms]") {
  const std::vector<Acceleration> road = made("road");
  const char* files[] = {"road_brake_0g8", "road_rearward_0g5", "road_corner_right_0g5", "road_corner_left_0g5"};
  REQUIRE(road.size() == std::size(files));
  for (std::size_t i = 0; i < road.size(); ++i) {
    INFO(road[i].name << " and " << files[i]);
    const auto text = read_text_file(std::string(HOLDFAST_SOURCE_DIR "/configs/accelerations/") + files[i] + ".txt");
    REQUIRE(text);
    std::vector<Error> warnings;
    const auto file = parse_acceleration(*text, warnings);
    REQUIRE(file);
    REQUIRE(road[i].segments.size() == file->segments.size());
    for (std::size_t k = 0; k < file->segments.size(); ++k) {
      CHECK(road[i].segments[k].start == file->segments[k].start);
      CHECK(road[i].segments[k].duration == file->segments[k].duration);
      CHECK(road[i].segments[k].acceleration == file->segments[k].acceleration);
    }
  }
}

TEST_CASE("norms: an acceleration is named after norm, direction, purpose and size", "[core][norms]") {
  CHECK(names_of(made("road")) ==
        std::vector<std::string>{"road-front-0g8", "road-rear-0g5", "road-left-0g5", "road-right-0g5"});
  CHECK(names_of(made("eumos-40509:0.55"))[0] == "eumos-40509-front-0g55");
  const std::vector<std::string> rail = names_of(made("rail-en12195"));
  CHECK(rail[0] == "rail-en12195-front-sliding-1g0");
  CHECK(rail[1] == "rail-en12195-front-tipping-0g6");
  CHECK(std::set<std::string>(rail.begin(), rail.end()).size() == 8);
  CHECK(names_of(made("road-tipping"))[0] == "road-tipping-front-0g8");
  for (const std::string& name : rail) CHECK(name.find_first_of("./: $") == std::string::npos);
}

TEST_CASE("norms: what a norm states for sliding or for tipping alone says so", "[core][norms]") {
  for (const Acceleration& acceleration : made("road")) CHECK(acceleration.purpose.empty());
  for (const Acceleration& acceleration : made("road-tipping")) CHECK(acceleration.purpose == "tipping");
  CHECK(made("rail-en12195")[0].purpose == "sliding");
  CHECK(made("rail-en12195")[1].purpose == "tipping");
}

TEST_CASE("norms: braking presses the load to the front, and what is left of its weight is c_z", "[core][norms]") {
  constexpr double kG = 9.81;
  const std::vector<Acceleration> sea = made("sea-b");
  CHECK((peak(sea[0]) - Vec3(0.3 * kG, 0, -0.7 * kG)).norm() < 1e-6);
  CHECK((peak(sea[1]) - Vec3(-0.3 * kG, 0, -0.7 * kG)).norm() < 1e-6);
  CHECK((peak(sea[2]) - Vec3(0, 0.7 * kG, 0)).norm() < 1e-6);
  CHECK((peak(sea[3]) - Vec3(0, -0.7 * kG, 0)).norm() < 1e-6);
  const std::vector<Acceleration> rail = made("rail-en12195");
  CHECK((peak(rail[4]) - Vec3(0, 0.5 * kG, -0.3 * kG)).norm() < 1e-6);
  CHECK((peak(rail[5]) - Vec3(0, 0.5 * kG, 0)).norm() < 1e-6);
}

TEST_CASE("norms: the test of EUMOS rises in 50 ms by the velocity of an even rise, and holds for 0.3 s",
          "[core][norms]") {
  const std::vector<Acceleration> test = made("eumos-40509:0.5");
  REQUIRE(test.size() == 4);
  const std::vector<Segment>& segments = test[0].segments;
  REQUIRE(segments.size() == 8);  // rest, five pieces, hold, rest
  double velocity = 0.0, before = 0.0;
  for (std::size_t i = 1; i <= 5; ++i) {
    CHECK(segments[i].duration == 0.01);
    CHECK(segments[i].start == Approx(0.5 + 0.01 * static_cast<double>(i - 1)).epsilon(1e-14));
    CHECK(segments[i].acceleration.x() > before);
    before = segments[i].acceleration.x();
    velocity += segments[i].duration * before;
  }
  CHECK(velocity == Approx(0.5 * 0.05 * 0.5 * 9.81));
  CHECK(segments[6].start == 0.55);
  CHECK(segments[6].duration == 0.3);
  CHECK(segments[6].acceleration == Vec3(4.905, 0, 0));
  for (std::size_t i = 1; i < segments.size(); ++i)
    CHECK(std::abs(segments[i].start - segments[i - 1].start - segments[i - 1].duration) < kSameInstant);
}

TEST_CASE("norms: every norm has accelerations in all four directions, and a source", "[core][norms]") {
  for (const Norm& norm : norms()) {
    INFO(norm.name);
    std::set<LoadDirection> directions;
    for (const NormAcceleration& acceleration : norm.accelerations) directions.insert(acceleration.direction);
    CHECK(directions.size() == 4);
    CHECK_FALSE(norm.source.empty());
    CHECK(norm_names().find(norm.name) != std::string::npos);
  }
}

TEST_CASE("norms: equal sizes have equal names, and numbers say them", "[core][norms]") {
  CHECK(find_norm("eumos-40509:0.50")->name() == "eumos-40509:0.5");
  CHECK(find_norm("eumos-40509:5e-1")->name() == "eumos-40509:0.5");
  CHECK(find_norm("road")->name() == "road");
  CHECK(find_norm("road")->numbers() == "front 0.8 g, rear 0.5 g, left 0.5 g, right 0.5 g");
  CHECK_THAT(find_norm("eumos-40509:0.5")->numbers(), Catch::StartsWith("front 0.5 g, "));
  CHECK_THAT(find_norm("rail-en12195")->numbers(), Catch::Contains("left 0.5 g (sliding, c_z 0.7)"));
}

TEST_CASE("norms: a name that is none is told what is accepted, and what was meant", "[core][norms]") {
  CHECK(message_of("raod") == "unknown norm: raod; did you mean road? accepted are " + norm_names());
  CHECK(message_of("highway") == "unknown norm: highway; accepted are " + norm_names());
  CHECK_THAT(message_of(""), Catch::StartsWith("unknown norm"));
  CHECK(message_of("road:0.5") == "a norm that takes no size: road:0.5; road");
  for (const char* name : {"eumos-40509", "eumos-40509:", "eumos-40509:x", "eumos-40509:0", "eumos-40509:2.5"})
    CHECK(message_of(name) == "a norm without its size K: " + std::string(name) +
                                  "; eumos-40509:K with K from 0.01 to 2 g, such as eumos-40509:0.5");
}

}  // namespace norms_test
