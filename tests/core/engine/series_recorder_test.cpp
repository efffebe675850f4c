#include "core/engine/series_recorder.hpp"

#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>

#include "scenes.hpp"

namespace series_recorder_test {

using namespace holdfast::internal;
using namespace holdfast::internal::scenes;

namespace {

constexpr double kPi = 3.14159265358979323846;

/// One box of 1 x 2 x 3 m whose states the test sets, and a recorder.
class HandDriven {
 public:
  explicit HandDriven(const RecordingPlan& plan, const Settings& settings = {})
      : layout_(layout_of({box({0, 0, 0}, {1, 2, 3})})), recorder(plan) {
    const Acceleration* const accelerations[] = {&acceleration_};
    batch_ = scenes::batch_of(std::span(&layout_, 1), accelerations, settings);
    now = before_ = batch_.state;
  }

  StateColumns now;  ///< state at the end of the next step

  StateView view_of(const StateColumns& state) const { return view(state, batch_.worlds[0]); }
  void start() {
    recorder.start(view(batch_.boxes, batch_.worlds[0]), view_of(batch_.state), 0.0);
    recorder.accelerate(view_of(now));
  }
  /// The load settles first.
  void settle_from(double time) {
    recorder.start(view(batch_.boxes, batch_.worlds[0]), view_of(batch_.state), time);
    time_ = time;
  }
  void accelerate() {
    recorder.accelerate(view_of(before_));
    time_ = 0.0;
  }
  void step(double until, const Vec3& acceleration = Vec3::Zero(), Status status = Status::ok) {
    recorder.step({time_, until, acceleration, view_of(before_), view_of(now), status});
    before_ = now;
    time_ = until;
  }
  WorldRecord finish() {
    recorder.finish({.stop_reason = StopReason::timeout, .end_time = time_}, view_of(before_));
    return recorder.take();
  }
  void keep() { before_ = now; }

 private:
  Layout layout_;
  Acceleration acceleration_;
  WorldBatch batch_;
  StateColumns before_;
  double time_ = 0.0;

 public:
  SeriesRecorder recorder;
};

bool same_bits(float a, float b) { return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b); }
bool is_positive_zero(float number) { return same_bits(number, 0.0F); }

}  // namespace

TEST_CASE("series_recorder: samples lie at 0, at every interval and at the end", "[core][series_recorder]") {
  HandDriven world({.interval = 0.1});
  world.start();
  world.step(0.08);
  world.step(0.13);
  world.step(0.45);
  const Series series = world.finish().series;
  REQUIRE(series.time.size() == 6);
  for (std::size_t i = 0; i < 5; ++i) CHECK(series.time[i] == static_cast<double>(i) * 0.1);
  CHECK(series.time[5] == 0.45);
  CHECK(series.displacement.size() == 6);
  CHECK(series.total_kinetic_energy.size() == 6);
}

TEST_CASE("series_recorder: an end on the interval is not sampled twice", "[core][series_recorder]") {
  HandDriven world({.interval = 0.1});
  world.start();
  world.step(0.2);
  // The end of the file with the rounding of a sum of decimal times.
  world.step(0.1 + 0.2);
  CHECK(world.finish().series.time.size() == 4);

  HandDriven other({.interval = 0.1});
  other.start();
  other.step(0.3);
  CHECK(other.finish().series.time.size() == 4);
}

TEST_CASE("series_recorder: states are linear between the ends of a step", "[core][series_recorder]") {
  HandDriven world({.interval = 0.1});
  world.start();
  world.now.position[0] += Vec3(0.4, 0, -0.8);
  world.now.angular_velocity[0] = Vec3(0, 0, 4);
  world.now.orientation[0] = Rotation(Eigen::AngleAxisd(0.02, Eigen::Vector3d::UnitZ()));
  world.step(0.4);
  const Series series = world.finish().series;
  REQUIRE(series.time.size() == 5);
  for (std::size_t i = 0; i < 5; ++i) {
    const auto share = static_cast<double>(i) / 4.0;
    CHECK(series.displacement[i].x == Approx(0.4 * share).margin(1e-7));
    CHECK(series.displacement[i].z == Approx(-0.8 * share).margin(1e-7));
    CHECK(series.angular_velocity[i].z == Approx(4 * share).margin(1e-6));
    CHECK(series.orientation[i].z == Approx(std::sin(0.01 * share)).margin(1e-7));
    CHECK(series.orientation[i].w == Approx(std::cos(0.01 * share)));
    CHECK(series.fallen_count[i] == (i > 0 ? 1U : 0U));
  }
}

TEST_CASE("series_recorder: orientations are interpolated along the shorter arc", "[core][series_recorder]") {
  HandDriven world({.interval = 0.1});
  world.start();
  world.now.orientation[0].coeffs() = -Rotation(Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitX())).coeffs();
  world.step(0.2);
  const WorldRecord record = world.finish();
  CHECK(record.series.orientation[1].w == Approx(std::cos(0.05)));
  CHECK(record.series.orientation[1].x == Approx(std::sin(0.05)));
  // The negative quaternion is the same rotation.
  CHECK(record.end.end_tilt[0] == Approx(0.2 * 180 / kPi));
}

TEST_CASE("series_recorder: at a breakpoint a sample shows the acceleration before it", "[core][series_recorder]") {
  HandDriven world({.interval = 0.1});
  world.start();
  world.step(0.1, {2, 0, 0});
  world.step(0.15, {0, 3, 0});
  world.step(0.25, {0, 0, -1});
  const Series series = world.finish().series;
  REQUIRE(series.time.size() == 4);
  CHECK(series.container_acceleration[0].x == 0.0F);
  CHECK(series.container_acceleration[1].x == 2.0F);
  CHECK(series.container_acceleration[2].z == -1.0F);
  CHECK(series.container_acceleration[3].z == -1.0F);
  const float mass = 1500.0F;
  CHECK(series.force[1].x == -2.0F * mass);
  CHECK(series.force[2].z == mass);
}

TEST_CASE("series_recorder: the force is -m a and never a negative zero", "[core][series_recorder]") {
  HandDriven world({.interval = 0.1});
  world.start();
  world.step(0.1, {2, 0, -0.0});
  const Series series = world.finish().series;
  REQUIRE(series.force.size() == 2);
  for (const Float3& force : {series.force[0], series.force[1]}) {
    CHECK(is_positive_zero(force.y));
    CHECK(is_positive_zero(force.z));
  }
  CHECK(is_positive_zero(series.force[0].x));
}

TEST_CASE("series_recorder: a number too small for a float is 0, not -0", "[core][series_recorder]") {
  HandDriven world({.interval = 0.1});
  world.start();
  world.now.velocity[0] = Vec3(-1e-60, 0, 0);
  world.now.angular_velocity[0] = Vec3(-1e-60, -0.0, 0);
  world.step(0.1, Vec3(-0.0, 0, 0));
  const WorldRecord record = world.finish();
  CHECK(is_positive_zero(record.series.angular_velocity.back().x));
  CHECK(is_positive_zero(record.series.angular_velocity.back().y));
  CHECK(is_positive_zero(record.series.container_acceleration.back().x));
  CHECK(is_positive_zero(record.series.linear_acceleration.back().x));
}

TEST_CASE("series_recorder: no external force on boxes in a free container", "[core][series_recorder]") {
  Settings settings = at_once();
  settings.container.motion = ContainerMotion::free;
  CHECK_FALSE(recording_plan(settings, true).external_force);
  HandDriven world(recording_plan(settings, true));
  world.start();
  world.step(0.1, {2, 0, 0});
  const Series series = world.finish().series;
  CHECK(is_positive_zero(series.force[1].x));
  CHECK(series.container_acceleration[1].x == 2.0F);
}

TEST_CASE("series_recorder: linear acceleration is the mean over the last step", "[core][series_recorder]") {
  HandDriven world({.interval = 0.1});
  world.start();
  world.now.velocity[0] = Vec3(1, 0, 0);
  world.step(0.05);
  world.now.velocity[0] = Vec3(1, -2, 0);
  world.step(0.15);
  const Series series = world.finish().series;
  CHECK(series.linear_acceleration[0].x == 0.0F);
  CHECK(series.linear_acceleration[1].x == 0.0F);
  CHECK(series.linear_acceleration[1].y == Approx(-20.0));
  CHECK(series.linear_acceleration[2].y == Approx(-20.0));
}

TEST_CASE("series_recorder: kinetic energy of a spinning, tilted box", "[core][series_recorder]") {
  HandDriven world({.interval = 0.1});
  const Rotation tilted(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -1).normalized()));
  const Vec3 velocity(0.3, -0.2, 0.5);
  const Vec3 spin(1, -2, 0.5);
  world.now.orientation[0] = tilted;
  world.now.velocity[0] = velocity;
  world.now.angular_velocity[0] = spin;
  world.start();
  const WorldRecord record = world.finish();

  // The formula with the tensor of inertia in the container's axes.
  const double mass = 1500.0;
  const Eigen::Matrix3d turn = tilted.toRotationMatrix();
  const Eigen::DiagonalMatrix<double, 3> inertia(mass / 12 * 13, mass / 12 * 10, mass / 12 * 5);
  const Eigen::Matrix3d tensor = turn * inertia * turn.transpose();
  const double expected = 0.5 * mass * velocity.squaredNorm() + 0.5 * spin.dot(tensor * spin);
  CHECK(record.series.kinetic_energy[0] == Approx(expected).epsilon(1e-7));
  CHECK(record.series.total_kinetic_energy[0] == Approx(expected).epsilon(1e-7));
  CHECK(record.end.peak_kinetic_energy[0] == Approx(expected).epsilon(1e-7));
  CHECK(record.row.peak_total_kinetic_energy == Approx(expected).epsilon(1e-12));
}

TEST_CASE("series_recorder: peaks are over all steps, also between samples", "[core][series_recorder]") {
  HandDriven world({.interval = 0.1});
  world.start();
  world.now.position[0] += Vec3(0, 0.5, 0);
  world.now.velocity[0] = Vec3(2, 0, 0);
  world.step(0.05);
  world.now.position[0] -= Vec3(0, 0.5, 0);
  world.now.velocity[0] = Vec3::Zero();
  world.step(0.1);
  const WorldRecord record = world.finish();
  for (const Float3& displacement : record.series.displacement) CHECK(displacement.y == 0.0F);
  CHECK(record.end.end_displacement[0].y == 0.0F);
  CHECK(record.end.peak_displacement[0] == 0.5F);
  CHECK(record.end.peak_kinetic_energy[0] == 3000.0F);
  CHECK(record.end.peak_speed[0] == 2.0F);
  CHECK(record.end.end_kinetic_energy[0] == 0.0F);
  CHECK(record.row.peak_total_kinetic_energy == 3000.0);
}

TEST_CASE("series_recorder: end values have the same bits as the last sample", "[core][series_recorder]") {
  for (const double end_time : {0.2, 0.1 + 0.1, 0.237}) {
    HandDriven world({.interval = 0.1});
    world.start();
    world.now.velocity[0] = Vec3(0.1, 0.2, 0.3);
    world.step(0.1);
    world.now.position[0] += Vec3(1.0 / 3, -1.0 / 7, 1e-3);
    world.now.orientation[0] = Rotation(Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitY()));
    world.step(end_time);
    const WorldRecord record = world.finish();
    const Float3& sample = record.series.displacement.back();
    const Float3& end = record.end.end_displacement[0];
    CHECK(same_bits(sample.x, end.x));
    CHECK(same_bits(sample.y, end.y));
    CHECK(same_bits(sample.z, end.z));
    CHECK(same_bits(record.series.kinetic_energy.back(), record.end.end_kinetic_energy[0]));
  }
}

TEST_CASE("series_recorder: displacement and tilt from the layout's or the settled pose", "[core][series_recorder]") {
  for (const ReferencePose pose : {ReferencePose::layout, ReferencePose::settled}) {
    HandDriven world({.interval = 0.1, .reference_pose = pose});
    world.now.position[0] += Vec3(0, 0, -0.25);
    world.now.orientation[0] = Rotation(Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitX()));
    world.start();
    world.keep();
    world.step(0.1);
    const WorldRecord record = world.finish();
    const bool settled = pose == ReferencePose::settled;
    CHECK(record.end.settling_displacement[0].z == -0.25F);
    CHECK(record.end.end_displacement[0].z == (settled ? 0.0F : -0.25F));
    CHECK(record.end.peak_displacement[0] == (settled ? 0.0F : 0.25F));
    CHECK(record.end.end_tilt[0] == Approx(settled ? 0.0 : 0.5 * 180 / kPi).margin(1e-6));
    CHECK(record.series.fallen_count[0] == (settled ? 0U : 1U));
    // The table always has the layout's pose.
    CHECK(record.boxes.initial_position[0].z == 1.5F);
  }
}

TEST_CASE("series_recorder: peaks and end values are recorded without series too", "[core][series_recorder]") {
  HandDriven world({.interval = 0.1, .series = false});
  world.start();
  world.now.position[0] += Vec3(1, 0, 0);
  world.step(0.5);
  const WorldRecord record = world.finish();
  CHECK(record.series.time.empty());
  CHECK(record.series.displacement.empty());
  CHECK(record.end.end_displacement[0].x == 1.0F);
  CHECK(record.end.peak_displacement[0] == 1.0F);
}

TEST_CASE("series_recorder: the table of boxes", "[core][series_recorder]") {
  Settings settings = at_once();
  settings.materials[1] = {.mass = 12.5, .centre_of_mass = {0.25, 0, 0}};
  HandDriven world({.interval = 0.1}, settings);
  world.start();
  const BoxTable boxes = world.finish().boxes;
  REQUIRE(boxes.id.size() == 1);
  CHECK(boxes.id[0] == 1);
  CHECK(boxes.material[0] == 1);
  CHECK(boxes.mass[0] == 12.5F);
  CHECK(boxes.size[0].x == 1.0F);
  CHECK(boxes.size[0].z == 3.0F);
  CHECK(boxes.initial_position[0].x == 0.75F);
}

TEST_CASE("series_recorder: the options come from the settings", "[core][series_recorder]") {
  Settings settings = at_once();
  settings.results_interval = 0.25;
  settings.screening.reference_pose = ReferencePose::settled;
  settings.screening.drop_threshold = 0.3;
  settings.screening.move_threshold = 0.4;
  settings.screening.tilt_threshold = 5;
  const RecordingPlan plan = recording_plan(settings, false);
  CHECK(plan.interval == 0.25);
  CHECK_FALSE(plan.series);
  CHECK(plan.reference_pose == ReferencePose::settled);
  CHECK(plan.external_force);
  CHECK(plan.thresholds.drop == 0.3);
  CHECK(plan.thresholds.move == 0.4);
  CHECK(plan.thresholds.tilt == 5);
}

TEST_CASE("series_recorder: a box that was beyond a limit decides, also when it comes back",
          "[core][series_recorder]") {
  const auto decided = [](StopWhen stop_when, const Vec3& offset, double angle = 0.0) {
    HandDriven world({.stop_when = stop_when});
    world.start();
    const Vec3 place = world.now.position[0];
    world.now.position[0] = place + offset;
    world.now.orientation[0] = Rotation(Eigen::AngleAxisd(angle * kPi / 180.0, Eigen::Vector3d::UnitX()));
    world.step(0.1);
    const bool beyond = world.recorder.decided();
    world.now.position[0] = place;
    world.now.orientation[0] = Rotation::Identity();
    world.step(0.2);
    CHECK(world.recorder.decided() == beyond);
    return beyond;
  };
  const Vec3 slid(0.08, 0.08, 0.0);
  const Vec3 sunk(0.0, 0.0, -0.051);
  CHECK(decided(StopWhen::moved, slid));
  CHECK(decided(StopWhen::moved, sunk));
  CHECK(decided(StopWhen::moved, Vec3::Zero(), 10.1));
  CHECK_FALSE(decided(StopWhen::moved, Vec3(0.09, 0.0, -0.04), 9.9));
  CHECK(decided(StopWhen::fallen, sunk));
  CHECK_FALSE(decided(StopWhen::fallen, slid, 10.1));
  for (const Vec3& offset : {slid, sunk}) CHECK_FALSE(decided(StopWhen::end, offset, 90.0));
}

TEST_CASE("series_recorder: peaks, the first time beyond a limit, and what comes back", "[core][series_recorder]") {
  HandDriven world({.interval = 10.0});
  world.start();
  const Vec3 place = world.now.position[0];
  world.now.position[0] = place + Vec3(0.3, 0.4, 0.1);
  world.now.orientation[0] = Rotation(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitX()));
  world.step(0.125);
  world.now.position[0] = place + Vec3(0, 0, -0.2);
  world.now.orientation[0] = Rotation(Eigen::AngleAxisd(-0.1, Eigen::Vector3d::UnitX()));
  world.step(0.25);
  world.now.position[0] = place;
  world.step(0.375);
  const EndTable end = world.finish().end;
  CHECK(end.peak_displacement[0] == Approx(std::sqrt(0.26)));
  CHECK(end.peak_drop[0] == 0.2F);
  CHECK(end.peak_tilt[0] == Approx(0.3 * 180 / kPi));
  CHECK(end.first_beyond[0] == 0.125F);
  CHECK(end.end_displacement[0].x == 0.0F);
}

TEST_CASE("series_recorder: nothing is a peak after the first bit of the status", "[core][series_recorder]") {
  HandDriven world({.interval = 0.1});
  world.start();
  world.now.position[0].x() += 0.05;
  world.step(0.1);
  world.now.position[0].x() += 1.0;
  world.step(0.2, Vec3::Zero(), Status::not_converged);
  world.recorder.finish({.status = Status::not_converged, .stop_reason = StopReason::timeout, .end_time = 0.2},
                        world.view_of(world.now));
  const WorldRecord record = world.recorder.take();
  CHECK(record.row.status_time == 0.1);
  CHECK(record.end.peak_displacement[0] == 0.05F);
  CHECK(record.end.end_displacement[0].x == 1.05F);
  CHECK(std::isnan(record.end.first_beyond[0]));
}

TEST_CASE("series_recorder: what settling did is kept apart", "[core][series_recorder]") {
  HandDriven world({.interval = 0.1});
  world.settle_from(-1.0);
  world.now.position[0] += Vec3(0, 0, -0.03);
  world.step(-0.5);
  CHECK_FALSE(world.recorder.is_unstable());
  world.now.position[0] += Vec3(0, 0, 0.01);
  world.step(0.0);
  world.accelerate();
  world.now.position[0] += Vec3(0.04, 0, 0);
  world.step(0.1);
  const WorldRecord record = world.finish();
  CHECK(record.end.settling_peak_drop[0] == 0.03F);
  CHECK(record.end.settling_displacement[0].z == -0.02F);
  CHECK(record.end.peak_drop[0] == 0.0F);
  CHECK(record.end.peak_displacement[0] == 0.04F);
  CHECK(record.series.time == std::vector<double>{0.0, 0.1});
  CHECK(record.series.displacement[0].z == 0.0F);
}

TEST_CASE("series_recorder: the series of a world that is unstable is that of settling", "[core][series_recorder]") {
  HandDriven world({.interval = 0.5});
  world.settle_from(-1.0);
  world.now.position[0] += Vec3(0, 0, -0.3);
  world.step(-0.25);
  CHECK(world.recorder.is_unstable());
  CHECK_FALSE(world.recorder.decided());
  world.step(0.0);
  const WorldRecord record = world.finish();
  CHECK(record.series.time == std::vector<double>{-1.0, -0.5, 0.0});
  CHECK(record.end.first_beyond[0] == -0.25F);
  CHECK(record.end.peak_drop[0] == 0.3F);
  CHECK(record.end.settling_peak_drop[0] == 0.3F);
  CHECK(record.end.settling_displacement[0].z == -0.3F);
}

}  // namespace series_recorder_test
