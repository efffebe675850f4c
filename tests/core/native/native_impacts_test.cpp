// Known answers for what meets: the native engine's landings, rebounds, and boxes that stop each other.

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "core/native/native_scenes.hpp"
#include "physics/measures.hpp"

namespace native_impacts_test {

using namespace holdfast::internal;
using namespace holdfast::internal::scenes;
using namespace holdfast::internal::native_scenes;
using namespace holdfast::internal::physics;

TEST_CASE("native_impacts: a landing ends on the floor at rest, without rebound", "[core][native_impacts]") {
  for (const auto& [accuracy, bound] : {std::pair(Accuracy::standard, 1e-5), std::pair(Accuracy::reference, 1e-6)}) {
    const Run landing = native_run(one_box(kFlat, 0.1), constant(0, 1), with(accuracy, open_floor(0.5)));
    CAPTURE(static_cast<int>(accuracy), landing.displacement().transpose());
    CHECK((landing.displacement() + Vec3(0, 0, 0.1)).norm() < bound);
    CHECK(landing.state.velocity[0] == Vec3::Zero());
    CHECK(landing.state.angular_velocity[0] == Vec3::Zero());
  }
}

namespace {

/// Deepest overlap of two cubes of half a metre at the end of any of some steps, m. The one moves, the other rests on
/// the floor.
double overlap_of_cubes(const Vec3& offset, const Vec3& velocity, double steps_per_second) {
  Settings settings = open_floor(0.5);
  settings.native.steps_per_second = steps_per_second;
  const Layout layout = layout_of({box({10, 10, 0}, {0.5, 0.5, 0.5}), box(Vec3(10, 10, 0) + offset, {0.5, 0.5, 0.5})});
  double overlap = 0.0;
  watch(
      NativeEngine(settings), layout, constant(0, 4 / steps_per_second), settings,
      [&](WorldBatch& batch) { batch.state.velocity[1] = velocity; },
      [&](const WorldBatch& batch, const Phase&) {
        overlap = std::max(overlap, overlap_of(batch, settings.container).of_boxes);
      });
  return overlap;
}

}  // namespace

TEST_CASE("native_impacts: a box that lands on another one does not sink into it", "[core][native_impacts]") {
  for (const double steps_per_second : {60.0, 240.0}) {
    const double overlap = overlap_of_cubes({0, 0, 0.502}, {0, 0, -3}, steps_per_second);
    CAPTURE(steps_per_second, text(overlap));
    CHECK(overlap < 1e-5);
  }
}

// Expected: they meet at their edges. Before the step each is beyond the other's edge, along both axes: no contact is
// known, and they overlap by as much as they go in a step.
TEST_CASE("native_impacts: boxes that approach across their edges do not pass into each other",
          "[core][native_impacts]") {
  for (const double steps_per_second : {60.0, 240.0}) {
    const double overlap = overlap_of_cubes({0.505, 0, 0.504}, {-3, 0, -3}, steps_per_second);
    CAPTURE(steps_per_second, text(overlap));
    CHECK(overlap < 1e-3);
  }
}

// Expected: contacts are found for a whole step, also at the end of a step that a phase cut short. Found for the short
// one, a plate would be beyond the other after the next.
TEST_CASE("native_impacts: a thin plate stops another that comes fast, right after a short phase too",
          "[core][native_impacts]") {
  const double thickness = 0.005;
  const Layout layout =
      layout_of({box({10, 10, 1}, {0.5, 0.5, thickness}), box({9, 9, 1 - thickness}, {2, 2, thickness})});
  for (const Accuracy accuracy : {Accuracy::screening, Accuracy::standard, Accuracy::reference}) {
    // Several times its thickness in a step.
    const double speed = accuracy == Accuracy::reference ? 24.0 : 4.0;
    const double first = 1e-4;
    const Settings settings = with(accuracy, open_floor(0.5));
    double lowest = 1.0;
    watch(
        NativeEngine(settings), layout, acceleration_of({{first, Vec3::Zero()}, {0.1, Vec3::Zero()}}), settings,
        [&](WorldBatch& batch) {
          fix(batch, 1);
          batch.state.position[0].z() += 2e-3 + speed * first;
          batch.state.velocity[0].z() = -speed;
        },
        [&](const WorldBatch& batch, const Phase&) {
          lowest = std::min(lowest, batch.state.position[0].z() - 0.5 * thickness);
        });
    CAPTURE(static_cast<int>(accuracy), text(lowest - 1));
    CHECK(lowest > 1 - 1e-4);
  }
}

// Expected: the blow gives the light plate its speed within the step, beyond the fixed one, which it stands still above
// before: there is no contact to look along.
TEST_CASE("native_impacts: a plate that is struck does not pass the one behind it", "[core][native_impacts]") {
  for (const Accuracy accuracy : {Accuracy::screening, Accuracy::standard}) {
    for (const double speed : {3.0, 6.0}) {
      for (const double thickness : {0.005, 0.01, 0.02, 0.05}) {
        for (const double gap : {0.003, 0.01, 0.03}) {
          Settings settings = with(accuracy, open_floor(0.5));
          settings.materials[1].mass = 5;
          settings.materials[2].mass = 500;
          const Layout layout =
              layout_of({box({9, 9, 1 - thickness}, {2, 2, thickness}), box({9.7, 9.7, 1 + gap}, {0.6, 0.6, thickness}),
                         box({9.7, 9.7, 1.002 + gap + thickness}, {0.6, 0.6, 0.3}, 2)});
          double lowest = 1.0;
          watch(
              NativeEngine(settings), layout, constant(0, 0.3), settings,
              [&](WorldBatch& batch) {
                fix(batch, 0);
                batch.state.velocity[2].z() = -speed;
              },
              [&](const WorldBatch& batch, const Phase&) {
                lowest = std::min(lowest, batch.state.position[1].z() - 0.5 * thickness);
              });
          CAPTURE(static_cast<int>(accuracy), speed, thickness, gap, text(lowest - 1));
          // `screening` takes a step again from 1 mm of new overlap.
          CHECK(lowest > 1 - (accuracy == Accuracy::screening ? 2e-3 : 1e-3));
        }
      }
    }
  }
}

// Expected: without friction and with e = 1 the plates exchange their velocities, whatever way a step takes them.
TEST_CASE("native_impacts: thin plates that meet at speed exchange their velocities", "[core][native_impacts]") {
  constexpr double speed = 24.0;
  Settings settings = open_floor(0.0);
  settings.contact.restitution = 1.0;
  for (const Accuracy accuracy : {Accuracy::screening, Accuracy::standard, Accuracy::reference}) {
    settings.native.accuracy = accuracy;
    for (const double thickness : {0.002, 0.003, 0.005, 0.01, 0.02}) {
      for (const double gap : {0.001, 0.037, 0.211}) {
        for (const double share : {0.0, 0.3, 0.5}) {
          const Vec3 size(thickness, 0.5, 0.5);
          const Layout layout = layout_of({box({9, 10, 0}, size), box({9 + thickness + gap, 10, 0}, size)});
          const Run run = native_run(layout, constant(0, 0.05), settings, [&](StateColumns& state) {
            state.velocity[0].x() = (1 - share) * speed;
            state.velocity[1].x() = -share * speed;
          });
          CAPTURE(static_cast<int>(accuracy), thickness, gap, share, text(run.state.velocity[0].x()),
                  text(run.state.velocity[1].x()));
          CHECK(run.state.position[0].x() + thickness < run.state.position[1].x() + 1e-6);
          CHECK(run.state.velocity[0].x() == Approx(-share * speed).margin(1e-3 * speed));
          CHECK(run.state.velocity[1].x() == Approx((1 - share) * speed).margin(1e-3 * speed));
        }
      }
    }
  }
}

// Expected: without friction and with e = 0 all boxes go on together; their momentum is that of the one that hits.
TEST_CASE("native_impacts: a row of touching boxes that is hit goes on as one", "[core][native_impacts]") {
  constexpr int kRow = 20;
  constexpr double speed = 3.0, gap = 0.05, first = 2.0;
  const Vec3 size(0.5, 0.5, 0.5);
  std::vector<Box> boxes = {box({first - size.x() - gap, 10, 0}, size)};
  for (int i = 0; i < kRow; ++i) boxes.push_back(box({first + i * size.x(), 10, 0}, size));
  for (const Accuracy accuracy : {Accuracy::screening, Accuracy::standard, Accuracy::reference}) {
    const Run run = native_run(layout_of(boxes), constant(0, 0.5), with(accuracy, open_floor(0.0)),
                               [&](StateColumns& state) { state.velocity[0].x() = speed; });
    const double together = speed / (kRow + 1);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      CAPTURE(static_cast<int>(accuracy), i, text(run.state.velocity[i].x() / together - 1));
      CHECK(run.state.velocity[i].x() == Approx(together).epsilon(1e-3));
    }
  }
}

// Expected: it slides to the fixed box, comes back as fast as it went, and hands its speed to the other, which slides
// on; what it meets on its way back was no neighbour in contact before.
TEST_CASE("native_impacts: a box goes from one impact to the next within a step", "[core][native_impacts]") {
  const Vec3 size(0.5, 0.5, 0.5);
  const double friction = 0.2, speed = 3.0, step = 1.0 / 240;
  Settings settings = open_floor(friction);
  settings.contact.restitution = 1.0;
  settings.native.steps_per_second = 1.0 / step;
  for (const Accuracy accuracy : {Accuracy::screening, Accuracy::standard, Accuracy::reference}) {
    settings.native.accuracy = accuracy;
    for (const double gap : {1e-3, 2e-3, 4e-3}) {
      for (const bool fixed_first : {false, true}) {
        std::vector<Box> boxes = {box({10, 10, 0}, size), box({9.5 - gap, 10, 0}, size)};
        boxes.insert(fixed_first ? boxes.begin() : boxes.end(), box({10.5 + gap, 10, 0}, size));
        const std::size_t sliding = fixed_first ? 1 : 0;
        StateColumns end;
        watch(
            NativeEngine(settings), layout_of(boxes), constant(0, step), settings,
            [&](WorldBatch& batch) {
              fix(batch, fixed_first ? 0 : 2);
              batch.state.velocity[sliding].x() = speed;
            },
            [&](const WorldBatch& batch, const Phase&) { end = batch.state; });
        // Of all three gaps together, and of the whole way.
        const double path = speed * step - 0.5 * friction * kGravity * step * step;
        CAPTURE(static_cast<int>(accuracy), gap, fixed_first, text(end.position[sliding].x() - 10.25 + gap));
        CHECK(end.position[sliding].x() == Approx(10.25 - gap).margin(1e-9));
        CHECK(end.position[sliding + 1].x() == Approx(9.75 - gap - (path - 3 * gap)).margin(1e-9));
        CHECK(end.velocity[sliding + 1].x() == Approx(-speed + friction * kGravity * step).margin(1e-9));
      }
    }
  }
}

// Expected: friction brakes the box about as much as the stop does. Whether it comes to touch within the step, at the
// step's end or in the next one, it ends there and has nothing of the other box's room.
TEST_CASE("native_impacts: what friction nearly stops ends at what it touches", "[core][native_impacts]") {
  const double gap = 2.2e-4, steps_per_second = 240.0;
  const Layout layout = layout_of({box({10, 10, 0}, kFlat), box({10 + kFlat.x() + gap, 10, 0}, kFlat)});
  Settings settings = open_floor(0.9);
  settings.native.steps_per_second = steps_per_second;
  for (int i = 0; i <= 40; ++i) {
    const double speed = 0.066 + 0.0005 * i;
    double lowest = gap;
    watch(
        NativeEngine(settings), layout, constant(0, 5 / steps_per_second), settings,
        [&](WorldBatch& batch) {
          fix(batch, 1);
          batch.state.velocity[0].x() = speed;
        },
        [&](const WorldBatch& batch, const Phase&) {
          lowest = std::min(lowest, batch.state.position[1].x() - batch.state.position[0].x() - kFlat.x());
        });
    const double path = 0.5 * speed * speed / (0.9 * kGravity);
    CAPTURE(speed, text(lowest), text(gap - path));
    CHECK(lowest > -native::kTouch);
    CHECK(lowest == Approx(std::max(0.0, gap - path)).margin(1e-4));
  }
}

// Expected: free fall, an elastic impact that turns the velocity round, free fall.
TEST_CASE("native_impacts: an impact is located however shortly before a step's end", "[core][native_impacts]") {
  Settings settings = open_floor(0.5);
  settings.contact.restitution = 1.0;
  const double step = 1.0 / 240;
  settings.native.steps_per_second = 1.0 / step;
  const double speed = 10.0;
  for (const auto& [rest, bound] : {std::pair(0.3, 1e-11), std::pair(1e-2, 1e-11), std::pair(2e-4, 1e-11),
                                    // What overlaps by less than contacts may goes into the next step.
                                    std::pair(1e-5, 1e-6)}) {
    const double fall = (24 - rest) * step;
    const double height = speed * fall + 0.5 * kGravity * fall * fall;
    const Run bounce = native_run(one_box(kFlat, height), constant(0, 30 * step), settings,
                                  [&](StateColumns& state) { state.velocity[0].z() = -speed; });
    const double after = 30 * step - fall;
    const double expected = (speed + kGravity * fall) * after - 0.5 * kGravity * after * after - height;
    CAPTURE(rest, text(bounce.displacement().z() - expected));
    CHECK(std::abs(bounce.displacement().z() - expected) < bound);
  }
}

// Expected: the impact keeps the moment of momentum about the point at the kerb's height above the edge that slides on,
// K w = v (h/2 - k) with K = l^2/4 + (h/2 - k)^2 + (l^2 + h^2)/12; the box falls over when K w^2 / 2 lifts its centre
// above that edge.
TEST_CASE("native_impacts: a kerb throws over what is fast enough, and nothing slower", "[core][native_impacts]") {
  const double kerb = 0.2, length = 0.5, height = 1.0, gap = 0.1037;
  const double lever = 0.5 * height - kerb;
  const double inertia = 0.25 * length * length + lever * lever + (length * length + height * height) / 12.0;
  const double lift = 0.5 * std::hypot(length, height) - 0.5 * height;
  const double critical = std::sqrt(2.0 * kGravity * lift * inertia) / lever;
  const Layout layout =
      layout_of({box({4 - gap - length, 3.75, 0}, {length, 0.5, height}), box({4, 3, 0}, {1, 2, kerb})});
  for (const Accuracy accuracy : {Accuracy::standard, Accuracy::reference}) {
    for (const double share : {0.8, 0.95, 0.99, 1.01, 1.05}) {
      const Settings settings = with(accuracy, open_floor(0.0));
      double tilt = 0.0;
      watch(
          NativeEngine(settings), layout, constant(0, 0.8), settings,
          [&](WorldBatch& batch) {
            fix(batch, 1);
            batch.state.velocity[0].x() = share * critical;
          },
          [&](const WorldBatch& batch, const Phase&) {
            tilt = std::max(tilt, 2.0 * std::asin(std::min(1.0, Vec3(batch.state.orientation[0].vec()).norm())));
          });
      CAPTURE(static_cast<int>(accuracy), share, tilt);
      CHECK((tilt > std::atan2(length, height) + 0.1) == (share > 1.0));
    }
  }
}

TEST_CASE("native_impacts: an oblique elastic impact is nearly the same at every accuracy", "[core][native_impacts]") {
  Settings settings = open_floor(0.0);
  settings.contact.restitution = 1.0;
  const Layout layout = layout_of({box({9, 10, 0}, {0.8, 0.8, 0.5}), box({10.5, 10, 0}, {0.9, 0.8, 0.5})});
  std::vector<double> separation_speed;
  for (const Accuracy accuracy : {Accuracy::screening, Accuracy::standard, Accuracy::reference}) {
    settings.native.accuracy = accuracy;
    const Run run = native_run(layout, constant(0, 0.5), settings, [](StateColumns& state) {
      state.velocity[0].x() = 2;
      state.orientation[0] = Rotation(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ()));
    });
    separation_speed.push_back(run.state.velocity[1].x() - run.state.velocity[0].x());
  }
  CAPTURE(text(separation_speed[0]), text(separation_speed[1]), text(separation_speed[2]));
  CHECK(separation_speed[0] == Approx(separation_speed[2]).epsilon(5e-3));
  CHECK(separation_speed[1] == Approx(separation_speed[2]).epsilon(5e-3));
}

TEST_CASE("native_impacts: an elastic box bounces to where it came from", "[core][native_impacts]") {
  Settings settings = open_floor(0.5);
  settings.contact.restitution = 1.0;
  const double height = 0.4;
  // Ten times down and up.
  const double end = 20 * std::sqrt(2 * height / kGravity);
  for (const auto& [accuracy, bound] : {std::pair(Accuracy::standard, 1e-9), std::pair(Accuracy::reference, 1e-9)}) {
    settings.native.accuracy = accuracy;
    const Run bounces = native_run(one_box(kFlat, height), constant(0, end), settings);
    const double energy = 0.5 * bounces.state.velocity[0].squaredNorm() + kGravity * bounces.displacement().z();
    CAPTURE(static_cast<int>(accuracy), text(energy / (kGravity * height)), text(bounces.displacement().norm()));
    CHECK(std::abs(energy) < bound * kGravity * height);
    CHECK(bounces.displacement().norm() < bound);
  }
}

TEST_CASE("native_impacts: restitution is the box's on the floor, the smaller one of two boxes",
          "[core][native_impacts]") {
  Settings settings = open_floor(0.0);
  settings.materials[1].restitution = 0.9;
  settings.materials[2].restitution = 0.3;
  for (const Accuracy accuracy : {Accuracy::standard, Accuracy::reference}) {
    settings.native.accuracy = accuracy;
    for (const auto& [material, restitution] : {std::pair(1, 0.9), std::pair(2, 0.3)}) {
      Settings dropped = settings;
      dropped.container.size.z() = 2;
      double highest = 0.0;
      bool down = false;
      watch(NativeEngine(dropped), layout_of({box({10, 10, 0.4}, kFlat, material)}), constant(0, 0.6), dropped, {},
            [&](const WorldBatch& batch, const Phase&) {
              down = down || batch.state.velocity[0].z() > 0.1;
              if (down) highest = std::max(highest, batch.state.position[0].z() - 0.5 * kFlat.z());
            });
      CAPTURE(static_cast<int>(accuracy), material, text(highest));
      CHECK(highest == Approx(0.4 * restitution * restitution).epsilon(2e-3));
    }
    for (const auto& [first, second, restitution] : {std::tuple(1, 2, 0.3), std::tuple(1, 1, 0.9)}) {
      const Layout layout = layout_of({box({5, 5, 0}, {1, 1, 1}, first), box({6.5, 5, 0}, {1, 1, 1}, second)});
      const Run run = native_run(layout, constant(0, 1), settings, [](StateColumns& s) { s.velocity[0].x() = 2; });
      const double normal_speed = run.state.velocity[1].x() - run.state.velocity[0].x();
      CAPTURE(static_cast<int>(accuracy), first, second, text(normal_speed));
      CHECK(normal_speed == Approx(2 * restitution).epsilon(1e-4));
    }
  }
}

// Expected: of a box that slides with v against a row of n that stands, what is left of v² after the gap is
// v² - 2 μ g gap. All go on with 1/(n + 1) of the speed, and friction slows them down from then on: they come
// v² / (2 μ g) far. If friction acted for the whole step in which the row is hit, it would come up to a quarter less
// far.
TEST_CASE("native_impacts: friction opposes a row of twenty from the time at which a box hits it",
          "[core][native_impacts]") {
  constexpr double kFriction = 0.3, kSpeed = 6.0;
  constexpr std::size_t kRow = 20;
  for (const double gap : {0.03, 0.07, 0.11, 0.15}) {
    Layout layout = layout_of({box({5.1, 5, 0}, {0.4, 0.5, 0.25})});
    for (std::size_t i = 0; i < kRow; ++i)
      layout.boxes.push_back(box({5.5 + gap + 0.4 * static_cast<double>(i), 5, 0}, {0.4, 0.5, 0.25}));
    const double hit = std::sqrt(kSpeed * kSpeed - 2.0 * kFriction * kGravity * gap);
    const double expected = std::pow(hit / (kRow + 1.0), 2) / (2.0 * kFriction * kGravity);
    for (const auto& [accuracy, error] : {std::pair(Accuracy::screening, 0.05), std::pair(Accuracy::standard, 0.05),
                                          std::pair(Accuracy::reference, 0.01)}) {
      const Run run =
          native_run(layout, constant(0, 0.5), with(accuracy, open_floor(kFriction)), [&](StateColumns& state) {
            state.velocity[0] = {kSpeed, 0, 0};
          });
      CAPTURE(gap, static_cast<int>(accuracy));
      for (std::size_t i = 1; i <= kRow; ++i) CHECK(run.displacement(i).x() == Approx(expected).epsilon(error));
    }
  }
}

// Two neighbours that tip as one overlap by w θ²/2: the lower corner of one jams on the other as soon as it has gone
// through the gap between them. Expected: a three-dimensional Moreau integration of the same boxes, in steps of 5 to
// 100 µs, which agree to all digits.
TEST_CASE("native_impacts: neighbours that tip together jam when they meet", "[core][native_impacts]") {
  Settings settings = with(Accuracy::standard, open_floor(0.72));
  settings.contact.box_box = 0.43;
  const double gap = 1e-5;
  for (const auto& [count, tilt] : {std::pair(2, 7.69), std::pair(3, 5.40)}) {
    Layout layout;
    for (int i = 0; i < count; ++i) layout.boxes.push_back(box({9.0 + (0.35 + gap) * i, 9.0, 0.0}, {0.35, 1.0, 1.1}));
    const Run row = native_run(layout, acceleration_of({{0.3, {4.94, 0, 0}}, {0.7, Vec3::Zero()}}), settings);
    const std::vector<float>& tilts = row.record.end.peak_tilt;
    CAPTURE(count);
    CHECK(*std::max_element(tilts.begin(), tilts.end()) == Approx(tilt).epsilon(0.01));
  }
}

}  // namespace native_impacts_test
