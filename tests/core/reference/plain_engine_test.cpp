// Known answers for the plain engine. Its steps are exact under constant forces, so that the bounds are those of
// rounding.

#include "core/reference/plain_engine.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "scenes.hpp"

namespace plain_engine_test {

using namespace holdfast::internal;
using namespace holdfast::internal::scenes;

namespace {

constexpr double kStep = 1.0 / 240;  ///< s
const Vec3 kFlat(1.1, 1.1, 0.25);    ///< a box that slides and does not tip, m
const Vec3 kTall(0.5, 0.5, 1.0);     ///< a box that tips and does not slide on high friction, m

Run plain_run(const Layout& layout, const Acceleration& acceleration, const Settings& settings,
              const std::function<void(StateColumns&)>& prepare = {}) {
  return run(PlainEngine(settings), layout, acceleration, settings, prepare);
}

Layout one_box(const Vec3& size, double height = 0.0) { return layout_of({box({10, 10, height}, size)}); }

double largest_displacement(const Run& run) {
  double largest = 0.0;
  for (std::size_t i = 0; i < run.start.size(); ++i) largest = std::max(largest, run.displacement(i).norm());
  return largest;
}

Eigen::Matrix3d inertia_of(const WorldBatch& batch, std::size_t i) {
  const Eigen::Matrix3d axes = batch.state.orientation[i].toRotationMatrix();
  return axes * batch.boxes.inertia[i].asDiagonal() * axes.transpose();
}

/// Kinetic energy plus potential energy under the effective gravity, J.
double energy_of(const WorldBatch& batch, const Vec3& field) {
  double energy = 0.0;
  for (std::size_t i = 0; i < batch.boxes.mass.size(); ++i) {
    const Vec3& spin = batch.state.angular_velocity[i];
    energy += batch.boxes.mass[i] * (0.5 * batch.state.velocity[i].squaredNorm() - field.dot(batch.state.position[i])) +
              0.5 * spin.dot(inertia_of(batch, i) * spin);
  }
  return energy;
}

/// Advances a world of one phase step by step, and calls a function after each step.
void watch(const Layout& layout, const Settings& settings, const Phase& phase,
           const std::function<void(WorldBatch&)>& prepare, const std::function<void(const WorldBatch&)>& look) {
  const Acceleration acceleration = acceleration_of({{phase.end, phase.acceleration}});
  const Acceleration* const accelerations[] = {&acceleration};
  WorldBatch batch = scenes::batch_of(std::span(&layout, 1), accelerations, settings);
  prepare(batch);
  const PlainEngine engine(settings);
  const std::unique_ptr<Simulation> simulation = engine.build(batch);
  for (double time = phase.begin; time < phase.end;) {
    time = scenes::advance(*simulation, 0, phase);
    simulation->read_back(0, batch.state);
    look(batch);
  }
}

}  // namespace

TEST_CASE("plain_engine: a box at rest stays", "[core][plain_engine]") {
  const Layout layout = layout_of({box({1.237, 0.791, 0}, {0.613, 0.447, 0.379})});
  const double moved = plain_run(layout, constant(0, 2), at_once()).displacement().norm();
  CAPTURE(moved);
  CHECK(moved < 1e-9);
}

TEST_CASE("plain_engine: free fall is exact", "[core][plain_engine]") {
  const Layout layout = layout_of({box({1.237, 0.791, 1.5}, {0.613, 0.447, 0.379})});
  const Run fall = plain_run(layout, constant(1.5, 0.5), at_once());
  CHECK(fall.displacement().z() == Approx(-0.5 * kGravity * 0.25).epsilon(1e-12));
  CHECK(fall.displacement().x() == Approx(-0.5 * 1.5 * 0.25).epsilon(1e-12));
  CHECK(fall.state.velocity[0].z() == Approx(-0.5 * kGravity).epsilon(1e-12));
}

TEST_CASE("plain_engine: a box slides at a - mu g, in every direction", "[core][plain_engine]") {
  const double limit = 0.5 * kGravity;
  for (const Vec3& heading : {Vec3(1, 0, 0), Vec3(0, -1, 0), Vec3(0.6, 0.8, 0)}) {
    const Run slide = plain_run(one_box(kFlat), acceleration_of({{1, 1.5 * limit * heading}}), open_floor(0.5));
    const double error = (slide.displacement() + 0.25 * limit * heading).norm() / (0.25 * limit);
    CAPTURE(heading.transpose(), error);
    CHECK(error < 1e-9);
    CHECK((slide.state.velocity[0] + 0.5 * limit * heading).norm() < 1e-9);
  }
}

TEST_CASE("plain_engine: sliding begins at mu g", "[core][plain_engine]") {
  const double limit = 0.5 * kGravity;
  const Run below = plain_run(one_box(kFlat), constant(0.999 * limit, 2), open_floor(0.5));
  const Run above = plain_run(one_box(kFlat), constant(1.001 * limit, 2), open_floor(0.5));
  CAPTURE(below.displacement().norm());
  CHECK(below.displacement().norm() < 1e-8);
  CHECK(above.displacement().x() == Approx(-0.5 * 0.001 * limit * 4).epsilon(1e-5));
}

TEST_CASE("plain_engine: tipping begins at g l/h, alone and as a stack of three", "[core][plain_engine]") {
  const double limit = 0.5 * kGravity;
  const std::size_t boxes = GENERATE(1U, 3U);
  const Layout layout = stack(boxes, {10, 10, 0}, {0.5, 0.5, 1.0 / static_cast<double>(boxes)});
  const Run below = plain_run(layout, constant(0.999 * limit, 3), open_floor(1.0));
  const Run above = plain_run(layout, constant(1.001 * limit, 3), open_floor(1.0));
  CAPTURE(boxes, largest_displacement(below), above.record.end.end_tilt[0]);
  CHECK(largest_displacement(below) < 1e-6);
  CHECK(above.record.end.end_tilt[0] > 10.0F);
}

TEST_CASE("plain_engine: an offset centre of mass tips at g x/z", "[core][plain_engine]") {
  Settings settings = open_floor(2.0);
  settings.materials[1].centre_of_mass = {0.1, 0, -0.2};
  // It is 0.3 m above the floor, 0.35 m behind the front edge and 0.15 m in front of the rear edge.
  for (const double limit : {kGravity * 0.35 / 0.3, -kGravity * 0.15 / 0.3}) {
    const Run below = plain_run(one_box(kTall), constant(0.999 * limit, 2), settings);
    const Run above = plain_run(one_box(kTall), constant(1.001 * limit, 2), settings);
    CAPTURE(limit, below.record.end.peak_displacement[0], above.record.end.peak_displacement[0]);
    CHECK(below.record.end.peak_displacement[0] < 1e-6F);
    CHECK(above.record.end.peak_displacement[0] > 0.02F);
  }
}

TEST_CASE("plain_engine: a stack of three stays, below its slide limit too", "[core][plain_engine]") {
  const Layout layout = stack(3, {10, 10, 0}, {1, 1, 0.2});
  for (const double share : {0.0, 0.95}) {
    const Run run = plain_run(layout, constant(share * 0.4 * kGravity, 1), open_floor(0.4));
    const double moved = largest_displacement(run);
    CAPTURE(share, moved, run.record.row.solve_iterations);
    CHECK(moved < 1e-8);
    CHECK(run.record.row.status == Status::ok);
  }
}

TEST_CASE("plain_engine: a landing ends on the floor, without rebound", "[core][plain_engine]") {
  const Run landing = plain_run(one_box(kFlat, 0.1), constant(0, 1), open_floor(0.5));
  CAPTURE(landing.displacement().z() + 0.1);
  CHECK(std::abs(landing.displacement().z() + 0.1) < 1e-8);
  CHECK(landing.state.velocity[0].norm() < 1e-9);
}

TEST_CASE("plain_engine: the speed after a rebound is that before it times the restitution", "[core][plain_engine]") {
  const double restitution = GENERATE(1.0, 0.5);
  Settings settings = open_floor(0.5);
  settings.contact.restitution = restitution;
  const double height = 0.4;
  const double impact = std::sqrt(2 * kGravity * height);
  double largest = 0.0;
  watch(
      one_box(kFlat, height), settings, {0.0, 0.7, Vec3::Zero()}, [](WorldBatch&) {},
      [&](const WorldBatch& batch) { largest = std::max(largest, batch.state.velocity[0].z()); });
  CAPTURE(restitution, largest, restitution * impact);
  // The largest speed is at the end of the step with the impact, and differs by up to g h from that at the impact.
  CHECK(largest < restitution * impact + 1e-3);
  CHECK(largest > restitution * impact - kGravity * kStep - 1e-3);
}

TEST_CASE("plain_engine: an elastic box bounces back to its height", "[core][plain_engine]") {
  Settings settings = open_floor(0.5);
  settings.contact.restitution = 1.0;
  const double height = 0.4;
  // Ten times down and up.
  const double end = 20 * std::sqrt(2 * height / kGravity);
  const Run bounces = plain_run(one_box(kFlat, height), constant(0, end), settings);
  CAPTURE(bounces.displacement().z(), bounces.state.velocity[0].z());
  const double energy = 0.5 * bounces.state.velocity[0].squaredNorm() + kGravity * bounces.displacement().z();
  CHECK(std::abs(energy) < 2e-3 * kGravity * height);
  CHECK(bounces.displacement().norm() < 1e-3);
}

TEST_CASE("plain_engine: a collision of two boxes conserves momentum", "[core][plain_engine]") {
  Settings settings = open_floor(0.0);
  const double restitution = GENERATE(0.0, 1.0, 0.3);
  settings.contact.restitution = restitution;
  settings.materials[2].mass = 200.0;
  settings.materials[1].mass = 100.0;
  const Layout layout = layout_of({box({5, 5, 0}, {1, 1, 1}), box({6.5, 5, 0}, {1, 1, 1}, 2)});
  const Run run = plain_run(layout, constant(0, 1), settings, [](StateColumns& state) { state.velocity[0].x() = 2; });
  const double first = run.state.velocity[0].x();
  const double second = run.state.velocity[1].x();
  CAPTURE(restitution, first, second);
  CHECK(100 * first + 200 * second == Approx(200).epsilon(1e-9));
  CHECK(second - first == Approx(2 * restitution).margin(1e-8));
  // The collision is at 0.25 s.
  CHECK(run.displacement(0).x() == Approx(0.5 + 0.75 * first).margin(1e-2));
}

TEST_CASE("plain_engine: a frictionless wall stops the normal velocity, and lets a box slide along",
          "[core][plain_engine]") {
  const Layout layout = layout_of({box({0.2, 10, 0}, kFlat)});
  const Run run = plain_run(layout, acceleration_of({{1, Vec3(2, -1, 0)}}), open_floor(0.0));
  CHECK(run.displacement().x() == Approx(-0.2).margin(1e-8));
  // In the step of an impact a body has its new velocity from the start, in every direction: an error of a h² / 2 at
  // most.
  CHECK(run.displacement().y() == Approx(0.5).margin(1.1 * kStep * kStep));
  CHECK(std::abs(run.displacement().z()) < 1e-8);
  // Only the friction of the wall acts, with mu times the normal force. It acts at the wall, not at the centre of mass;
  // the floor has no friction.
  Settings rough = open_floor(0.0);
  rough.contact.box_wall = 0.3;
  const Run along = plain_run(layout_of({box({0, 10, 0}, kFlat)}), acceleration_of({{1, Vec3(8, -4, 0)}}), rough);
  CAPTURE(along.displacement().transpose());
  // Before the clearance at the wall is closed, no force acts.
  CHECK(along.displacement().y() == Approx(0.5 * (4 - 0.3 * 8)).epsilon(1e-4));
}

TEST_CASE("plain_engine: a fixed box holds another", "[core][plain_engine]") {
  const Layout layout = layout_of({box({5, 5, 0}, {1, 1, 1}), box({6, 5, 0}, {1, 1, 1}), box({5, 5, 1}, {1, 1, 1})});
  double moved = 0.0;
  watch(
      layout, open_floor(0.5), {0.0, 0.5, Vec3(4, 0, 0)},
      [](WorldBatch& batch) {
        batch.boxes.mass[0] = std::numeric_limits<double>::infinity();
        batch.boxes.inertia[0].setConstant(std::numeric_limits<double>::infinity());
      },
      [&](const WorldBatch& batch) {
        CHECK(batch.state.position[0] == Vec3(5.5, 5.5, 0.5));
        for (std::size_t i = 1; i < 3; ++i) moved = std::max(moved, batch.state.velocity[i].norm());
      });
  CAPTURE(moved);
  CHECK(moved < 1e-8);
}

TEST_CASE("plain_engine: free rotation conserves angular momentum and energy", "[core][plain_engine]") {
  Settings settings = open_floor(0.5);
  settings.gravity = 0.0;
  const Vec3 spin(1, 0.1, 5);
  Eigen::Vector3d momentum = Vec3::Zero();
  double energy = 0.0, momentum_error = 0.0, energy_error = 0.0;
  watch(
      layout_of({box({10, 10, 5}, {0.3, 0.9, 0.5})}), settings, {0.0, 2.0, Vec3::Zero()},
      [&](WorldBatch& batch) {
        batch.state.angular_velocity[0] = spin;
        momentum = inertia_of(batch, 0) * spin;
        energy = energy_of(batch, Vec3::Zero());
      },
      [&](const WorldBatch& batch) {
        const Vec3 now = inertia_of(batch, 0) * batch.state.angular_velocity[0];
        momentum_error = std::max(momentum_error, (now - momentum).norm() / momentum.norm());
        energy_error = std::max(energy_error, std::abs(energy_of(batch, Vec3::Zero()) / energy - 1));
      });
  CAPTURE(momentum_error, energy_error);
  CHECK(momentum_error < 1e-12);
  CHECK(energy_error < 1e-4);
}

TEST_CASE("plain_engine: energy never increases when boxes fall on each other", "[core][plain_engine][slow]") {
  Settings settings = open_floor(0.4);
  settings.container.size = {3, 2, 10};
  std::mt19937 generator(GENERATE(1U, 2U, 3U));
  const auto between = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(generator()) / 4294967296.0;
  };
  Layout layout = layout_of({});
  for (int i = 0; i < 6; ++i) {
    layout.boxes.push_back(box({between(0.6, 1.9), between(0.6, 0.9), 0.6 + 1.0 * i},
                               {between(0.3, 0.6), between(0.3, 0.6), between(0.2, 0.6)}));
  }
  const Phase phase{0.0, 2.0, Vec3(3, 1, 0)};
  const Vec3 field(-3, -1, -kGravity);
  double last = 0.0, highest_rise = 0.0, dropped = 0.0, weight = 0.0, outside = 0.0;
  watch(
      layout, settings, phase,
      [&](WorldBatch& batch) {
        for (Rotation& rotation : batch.state.orientation) {
          rotation = Rotation(between(-1, 1), between(-1, 1), between(-1, 1), between(-1, 1)).normalized();
        }
        for (const double mass : batch.boxes.mass) weight += mass * kGravity;
        last = energy_of(batch, field);
      },
      [&](const WorldBatch& batch) {
        const double now = energy_of(batch, field);
        highest_rise = std::max(highest_rise, now - last);
        dropped += last - now;
        last = now;
        for (const Vec3& position : batch.state.position)
          outside = std::max({outside, -position.minCoeff(), position.x() - 3, position.y() - 2});
      });
  CAPTURE(highest_rise / weight, dropped / weight);
  // As the height by which it would lift all boxes together.
  CHECK(highest_rise < 1e-4 * weight);
  CHECK(dropped > 0.5 * weight);
  CHECK(outside == 0.0);
}

TEST_CASE("plain_engine: overlaps of a layout are corrected without adding velocity", "[core][plain_engine]") {
  const Layout layout = layout_of({box({5, 5, 0}, {1, 1, 1}), box({6 - 1e-3, 5, 0}, {1, 1, 1})});
  const Run run = plain_run(layout, constant(0, 0.2), open_floor(0.5));
  CHECK(run.displacement(1).x() - run.displacement(0).x() == Approx(1e-3 - 1e-5).margin(1e-6));
  CHECK(run.state.velocity[0].norm() < 1e-8);
}

TEST_CASE("plain_engine: steps follow the settings, and never cross a change of the acceleration",
          "[core][plain_engine]") {
  const Acceleration pulse = acceleration_of({{0.1003, Vec3(0, 0, 0)}, {0.4004, Vec3(3, 0, 0)}, {0.3, Vec3(0, 0, 0)}});
  Settings settings = open_floor(0.0);
  const Run run = plain_run(one_box(kFlat), pulse, settings);
  CHECK(run.state.velocity[0].x() == Approx(-3 * 0.4004).epsilon(1e-9));
  CHECK(run.displacement().x() == Approx(-3 * 0.4004 * (0.2002 + 0.3)).epsilon(1e-9));
  CHECK(run.record.row.steps == 25 + 97 + 72);
  CHECK(run.record.row.max_residual < 1e-9);
  settings.steps_per_second = 60;
  CHECK(plain_run(one_box(kFlat), constant(0, 1), settings).record.row.steps == 60);
}

TEST_CASE("plain_engine: a free container is refused", "[core][plain_engine]") {
  Settings settings = at_once();
  CHECK(unsupported_by_plain(settings).empty());
  settings.container.motion = ContainerMotion::free;
  CHECK(unsupported_by_plain(settings).size() == 1);
}

}  // namespace plain_engine_test
