#include "analyses/walls/wall_recorder.hpp"

#include <catch2/catch.hpp>
#include <cmath>

namespace wall_recorder_test {

using namespace holdfast::internal;

namespace {

constexpr std::size_t kFront = 1;
constexpr std::size_t kRear = 2;

/// A recorder of two boxes of 100 kg, driven by hand.
class Driven {
 public:
  explicit Driven(std::optional<WallNorm> norm = std::nullopt) : recorder(norm, {.mass = mass_}) {}

  /// A step in which a force acts on a side outwards, N, at a point.
  void step(double until, std::size_t side, double force, const Vec3& point = Vec3::Zero()) {
    SideImpulses impulses;
    const double duration = until - time_;
    add_contact(impulses, side, Vec3((side == kRear ? 1.0 : -1.0) * force * duration, 0, 0), point);
    recorder.step({.begin = time_, .end = until, .side_impulses = &impulses});
    time_ = until;
  }

 private:
  std::vector<double> mass_ = {100.0, 100.0};
  double time_ = 0.0;

 public:
  WallRecorder recorder;
};

}  // namespace

TEST_CASE("wall_recorder: the peak, when it began and where it pressed", "[core][walls]") {
  Driven world;
  world.step(0.1, kFront, 50.0, {0, 1, 1});
  world.step(0.3, kFront, 80.0, {0, 1, 2});
  world.step(0.4, kFront, 80.0, {0, 2, 2});  // the same force is no new peak
  world.step(0.5, kFront, 20.0);
  const WallForces& forces = world.recorder.forces();
  CHECK(forces.peak_force[kFront] == Approx(80.0));
  CHECK(forces.peak_time[kFront] == 0.1);
  CHECK(forces.peak_point[kFront].isApprox(Vec3(0, 1, 2)));
  CHECK(forces.impulse[kFront].isApprox(Vec3(-50.0 * 0.1 - 80.0 * 0.3 - 20.0 * 0.1, 0, 0)));
  world.recorder.sample();
  CHECK(forces.force.back()[kFront] == Approx(20.0F));
  CHECK(forces.peak_force[kRear] == 0.0);
  CHECK(std::isnan(forces.peak_point[kRear].x()));
}

TEST_CASE("wall_recorder: a short blow counts as its mean over 50 ms, however steps cut it", "[core][walls]") {
  for (const int steps : {1, 4, 20}) {
    Driven world;
    double time = 0.2;
    world.step(time, kRear, 0.0);
    // 500 N for 10 ms, then nothing.
    for (int i = 0; i < steps; ++i) world.step(time += 0.01 / steps, kRear, 500.0);
    for (int i = 0; i < 10; ++i) world.step(time += 0.01, kRear, 0.0);
    CAPTURE(steps);
    CHECK(world.recorder.forces().peak_force[kRear] == Approx(500.0));
    CHECK(world.recorder.forces().lasting_force[kRear] == Approx(100.0));
  }
}

TEST_CASE("wall_recorder: a force that lasts counts in full, also in one long step", "[core][walls]") {
  Driven world(WallNorm::en283);
  world.step(0.04, kFront, 700.0);
  CHECK(world.recorder.forces().lasting_force[kFront] == Approx(700.0 * 0.04 / 0.05));
  world.step(2.0, kFront, 700.0);
  const WallForces& forces = world.recorder.forces();
  CHECK(forces.lasting_force[kFront] == Approx(700.0));
  // 0.4 of the weight of 200 kg.
  CHECK(forces.limit[kFront] == Approx(0.4 * 200.0 * 9.81));
  CHECK_FALSE(forces.exceeds(kFront));
  CHECK_FALSE(forces.exceeds(0));
  world.step(2.1, kFront, 800.0);
  CHECK(world.recorder.forces().exceeds(kFront));
  CHECK(world.recorder.forces().share_of_limit(kFront) == Approx(800.0 / (0.4 * 200.0 * 9.81)));
}

}  // namespace wall_recorder_test
