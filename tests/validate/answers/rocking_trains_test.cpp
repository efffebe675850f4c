#include "validate/answers/rocking_trains.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "validate/answers/rocking.hpp"

namespace rocking_trains_test {

using namespace holdfast::internal;

namespace {

constexpr double kGravity = 9.81;

/// The trains that fall at how many of seven amplitudes within 3 %.
int falls_of_seven(const RockingTrain& train, const Vec3& size) {
  int falls = 0;
  for (int i = -3; i <= 3; ++i) falls += largest_tilt(train, size, kGravity, 1.0 + 0.01 * i) > kFallenTilt ? 1 : 0;
  return falls;
}

}  // namespace

TEST_CASE("rocking_trains: every train has the same answer at all amplitudes within 3 %",
          "[validate][rocking_trains]") {
  for (const RockingTrains& trains : rocking_trains()) {
    CAPTURE(trains.size.transpose());
    for (const RockingTrain& train : trains.falling) {
      CAPTURE(train.cycles, train.period, train.amplitude);
      CHECK(falls_of_seven(train, trains.size) == 7);
    }
    for (const RockingTrain& train : trains.standing) {
      CAPTURE(train.cycles, train.period, train.amplitude);
      CHECK(falls_of_seven(train, trains.size) == 0);
    }
  }
}

TEST_CASE("rocking_trains: at least a third of the trains stands, of each block", "[validate][rocking_trains]") {
  for (const RockingTrains& trains : rocking_trains()) {
    CAPTURE(trains.falling.size(), trains.standing.size());
    CHECK(3 * trains.standing.size() >= trains.falling.size() + trains.standing.size());
    for (const int cycles : {1, 2, 4, 8}) {
      int count = 0;
      for (const auto* list : {&trains.falling, &trains.standing})
        for (const RockingTrain& train : *list) {
          count += train.cycles == cycles ? 1 : 0;
          CHECK(train.period >= 0.5);
          CHECK(train.period <= 4.0);
          CHECK(train.amplitude >= 1.03);
          CHECK(train.amplitude <= 1.8);
        }
      CHECK(count >= 6);
    }
  }
  CHECK(rocking_trains().front().falling.size() + rocking_trains().front().standing.size() == 54);
}

TEST_CASE("rocking_trains: tilts that are compared depend little on the amplitude", "[validate][rocking_trains]") {
  for (const RockingTrains& trains : rocking_trains())
    for (const RockingTrain& train : trains.swinging) {
      const double tilt = largest_tilt(train, trains.size, kGravity);
      const double more = largest_tilt(train, trains.size, kGravity, 1.001);
      CAPTURE(trains.size.transpose(), train.cycles, train.period, train.amplitude, tilt, more);
      CHECK(tilt > 2.0 * M_PI / 180.0);
      CHECK(tilt < 9.0 * M_PI / 180.0);
      CHECK(std::abs(more / tilt - 1.0) < 0.01);
      for (int i = -6; i <= 6; ++i)
        CHECK(std::abs(largest_tilt(train, trains.size, kGravity, 1.0 + 0.005 * i) / tilt - 1.0) < 0.3);
    }
}

TEST_CASE("rocking_trains: a train is sampled 100 times per second and ends with two seconds of rest",
          "[validate][rocking_trains]") {
  const Vec3 size(0.3, 1.0, 0.9);
  const Acceleration acceleration = acceleration_of({2, 1.25, 1.5}, size, kGravity);
  REQUIRE(acceleration.segments.size() == 251);
  CHECK(acceleration.end_time() == Approx(4.5));
  double largest = 0.0;
  for (const Segment& segment : acceleration.segments) largest = std::max(largest, segment.acceleration.x());
  CHECK(largest == Approx(1.5 * kGravity / 3.0).epsilon(1e-3));
  CHECK(acceleration.segments.back().acceleration.isZero(0.0));
}

}  // namespace rocking_trains_test
