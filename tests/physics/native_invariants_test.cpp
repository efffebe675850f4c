// What holds for the native engine in every scene: energy, penetration, momentum, and stillness at rest.

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/native/native_engine.hpp"
#include "physics/measures.hpp"

namespace native_invariants_test {

using namespace holdfast::internal;
using namespace holdfast::internal::scenes;
using namespace holdfast::internal::physics;

namespace {

/// Worst of a world's steps.
struct Worst {
  /// Rise of the energy over the lowest so far in a phase, as a height by which all boxes together would have been
  /// lifted, m.
  double rise = 0.0;
  double lost = 0.0;           ///< energy that went into impacts and friction, likewise as a height, m
  double start_overlap = 0.0;  ///< of boxes and with sides, m
  Overlap overlap;             ///< m
};

Worst worst_of(const Layout& layout, const Acceleration& acceleration, const Settings& settings,
               const std::function<void(WorldBatch&)>& prepare = {}) {
  Worst worst;
  double last = 0.0, lowest = 0.0, unit = 0.0;
  bool started = false;
  const auto pull_of = [&](const Phase& phase) { return Vec3(Vec3(0, 0, -settings.gravity) - phase.acceleration); };
  watch(
      NativeEngine(settings), layout, acceleration, settings, prepare,
      [&](const WorldBatch& batch, const Phase& phase) {
        const double now = energy_of(batch, pull_of(phase)) / unit;
        worst.rise = std::max(worst.rise, now - lowest);
        worst.lost += last - now;
        last = now;
        lowest = std::min(lowest, now);
        const Overlap overlap = overlap_of(batch, settings.container);
        worst.overlap.of_boxes = std::max(worst.overlap.of_boxes, overlap.of_boxes);
        worst.overlap.with_side = std::max(worst.overlap.with_side, overlap.with_side);
      },
      [&](const WorldBatch& batch, const Phase& phase) {
        unit = mass_of(batch) * kGravity;
        last = lowest = energy_of(batch, pull_of(phase)) / unit;
        if (started) return;
        started = true;
        const Overlap overlap = overlap_of(batch, settings.container);
        worst.start_overlap = std::max(overlap.of_boxes, overlap.with_side);
      });
  return worst;
}

/// What a scene's worst may be, m; see `Worst`.
struct Bounds {
  double rise = 0.0;
  double of_boxes = 0.0;
  double with_side = 0.0;
};

/// What is expected: an energy that rises by no more than a hundredth of a millimetre, and overlaps that nobody sees.
/// `screening` takes steps again from 1 mm only, and from 2 mm where the contact was solved, on top of what overlapped
/// before; and where a load has sunk into a wall by a tenth of a millimetre it is put back.
constexpr Bounds kExpected{1e-5, 1e-3, 1e-3};
constexpr Bounds kScreening{1e-4, 2.5e-3, 2e-3};

void check_worst(const Worst& worst, const Bounds& bounds) {
  CAPTURE(text(worst.rise), text(worst.lost), text(worst.overlap.of_boxes), text(worst.overlap.with_side),
          text(worst.start_overlap));
  CHECK(worst.start_overlap < 1e-12);
  CHECK(worst.rise < bounds.rise);
  CHECK(worst.overlap.of_boxes < bounds.of_boxes);
  CHECK(worst.overlap.with_side < bounds.with_side);
}

void check_real_loads(const Bounds& bounds) {
  Settings settings = at_once();
  settings.native.accuracy = Accuracy::screening;
  const Acceleration acceleration =
      acceleration_of({{0.45, Vec3(0.8 * kGravity, 0, 0)}, {0.35, Vec3(0, 0.5 * kGravity, 0)}});
  double lost = 0.0;
  for (const char* name : kLayouts) {
    const Worst worst = worst_of(bundled_layout(name, settings), acceleration, settings);
    CAPTURE(name);
    check_worst(worst, bounds);
    lost = std::max(lost, worst.lost);
  }
  // Something did move.
  CHECK(lost > 1e-2);
}

void check_random_scenes(Accuracy accuracy, const Bounds& bounds) {
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    const Layout layout = random_layout(random);
    const Acceleration acceleration = random_acceleration(random, 0.25);
    const Worst worst = worst_of(layout, acceleration, small_container(accuracy));
    CAPTURE(seed, layout.boxes.size());
    check_worst(worst, bounds);
    CHECK(worst.lost > 1e-2);
  }
}

/// Boxes in any orientation that fall onto each other.
void check_tumbling(const Bounds& bounds) {
  for (std::uint32_t seed = 1; seed <= 16; ++seed) {
    Random random(seed);
    Layout layout = layout_of({});
    for (int i = 0; i < 8; ++i) {
      const double x = random.between(0.6, 1.2);
      layout.boxes.push_back(box({x, 0.6, 0.7 * i + 0.5}, random.vector(0.2, 0.4)));
    }
    const Acceleration acceleration = random_acceleration(random, 0.4);
    const auto turn = [&](WorldBatch& batch) {
      for (Rotation& rotation : batch.state.orientation) rotation = random.rotation();
    };
    const Worst worst = worst_of(layout, acceleration, small_container(Accuracy::standard), turn);
    CAPTURE(seed);
    check_worst(worst, bounds);
    CHECK(worst.lost > 0.3);
  }
}

}  // namespace

TEST_CASE("native_invariants: on real loads energy does not rise, and boxes hardly sink into each other",
          "[physics][native_invariants]") {
  check_real_loads(kScreening);
}

TEST_CASE("native_invariants: in random scenes energy hardly rises, and boxes hardly sink into each other",
          "[physics][native_invariants]") {
  check_random_scenes(Accuracy::screening, kScreening);
  check_random_scenes(Accuracy::standard, kExpected);
}

TEST_CASE("native_invariants: the same where boxes tumble onto each other", "[physics][native_invariants]") {
  check_tumbling(kExpected);
}

// Where a low kerb stops a box, friction with the kerb presses it onto the floor, and friction with the floor onto the
// kerb.
TEST_CASE("native_invariants: a box that trips over a low kerb, which is fixed, gains no energy",
          "[physics][native_invariants]") {
  const Accuracy accuracy = GENERATE(Accuracy::screening, Accuracy::standard, Accuracy::reference);
  Settings settings = open_floor(0.3);
  settings.native.accuracy = accuracy;
  settings.materials[2].fixed = true;
  for (const double height : {2e-4, 3e-4, 4e-4, 6e-4, 8e-4, 1e-3, 1.5e-3})
    for (const double length : {0.4, 0.6, 0.8}) {
      Layout layout = layout_of({box({5, 5, 0}, {1.2, 1, height}, 2), box({6.4, 5.2, 0}, {length, 0.5, 0.6})});
      const Worst worst = worst_of(layout, constant(0.7 * kGravity, 0.8), settings);
      CAPTURE(static_cast<int>(accuracy), height, length);
      check_worst(worst, accuracy == Accuracy::screening ? Bounds{3e-4, 1e-3, 1e-3} : kExpected);
      CHECK(worst.lost > 1e-3);
    }
}

TEST_CASE("native_invariants: the deepest penetration that is reported is the deepest there was",
          "[physics][native_invariants]") {
  for (std::uint32_t seed = 1; seed <= 12; ++seed) {
    Random random(seed);
    const Layout layout = random_layout(random);
    const Acceleration acceleration = random_acceleration(random, 0.25);
    for (const Accuracy accuracy : {Accuracy::screening, Accuracy::standard}) {
      const Settings settings = small_container(accuracy);
      const Worst worst = worst_of(layout, acceleration, settings);
      const double seen = std::max(worst.overlap.of_boxes, worst.overlap.with_side);
      const double reported = run(NativeEngine(settings), layout, acceleration, settings).record.row.max_penetration;
      CAPTURE(seed, static_cast<int>(accuracy), text(seen), text(reported));
      // Of two ways out of each other a contact keeps the one it had while they are near ties.
      CHECK(reported > 0.95 * seen - 1e-9);
      CHECK(reported < 3 * seen + 1e-9);
    }
  }
}

// Expected: without friction impacts that rebound keep the energy, whoever hits whom; the floor's and the wall's
// rounding and what a contact may overlap are all that is left.
TEST_CASE("native_invariants: a row of elastic boxes rattles between walls and gains no energy",
          "[physics][native_invariants]") {
  // Of 1,200 such worlds ten rise by more than 1e-3, where several impacts meet.
  int rising = 0;
  for (std::uint32_t seed = 1; seed <= 40; ++seed) {
    Random random(seed);
    const std::uint32_t count = 2 + random.below(4);
    const double gap = random.between(1e-5, 1e-3);
    Layout layout = layout_of({});
    for (std::uint32_t i = 0; i < count; ++i)
      layout.boxes.push_back(box({gap + i * (0.3 + gap), 0.3, 0}, {0.3, 0.3, 0.3}));
    const double speed = random.between(0.2, 6);
    for (const Accuracy accuracy : {Accuracy::screening, Accuracy::standard}) {
      Settings settings = open_floor(0.0);
      settings.container.size = {gap + count * (0.3 + gap), 1, 1};
      settings.contact.restitution = 1.0;
      settings.native.accuracy = accuracy;
      const Worst worst = worst_of(layout, constant(0, 0.3), settings, [&](WorldBatch& batch) {
        batch.state.velocity[0].x() = speed;
        if (count > 2) batch.state.velocity[2].x() = -0.7 * speed;
      });
      CAPTURE(seed, static_cast<int>(accuracy), count, text(worst.rise));
      CHECK(worst.rise < 0.01);
      rising += worst.rise > 1e-4 ? 1 : 0;
    }
  }
  CHECK(rising <= 3);
}

namespace {

/// Largest changes that a meeting of two boxes brought, over the momentum there was (for the spin: times 1 m).
struct Meeting {
  double momentum = 0.0;
  double spin = 0.0;     ///< about the vertical
  double parting = 0.0;  ///< speed at the end along x, m/s
};

constexpr double kApproach = 2.0;  ///< m/s

/// @param oblique off centre, one yawed, the other spinning
Meeting meeting_of(Accuracy accuracy, double restitution, bool oblique) {
  Settings settings = open_floor(0.0);
  settings.materials[1].mass = 100.0;
  settings.materials[2].mass = 250.0;
  settings.native.accuracy = accuracy;
  settings.contact.restitution = restitution;
  const Layout layout =
      layout_of({box({9, 10, 0}, {0.8, 0.8, 0.5}), box({10.5, oblique ? 10.4 : 10.0, 0}, {0.9, 0.8, 0.5}, 2)});
  struct Sum {
    Vec3 linear = Vec3::Zero();
    double angular = 0.0;
  };
  const auto sum_of = [](const WorldBatch& batch) {
    Sum sum;
    for (std::size_t i = 0; i < 2; ++i) {
      const Vec3 own = batch.boxes.mass[i] * batch.state.velocity[i];
      // The floor pushes upwards only.
      sum.linear.head<2>() += own.head<2>();
      sum.angular += Vec3(batch.state.position[i] - Vec3(10, 10, 0)).cross(own).z() +
                     Vec3(inertia_of(batch, i) * batch.state.angular_velocity[i]).z();
    }
    return sum;
  };
  Meeting meeting;
  Sum start;
  watch(
      NativeEngine(settings), layout, constant(0, 0.8), settings,
      [&](WorldBatch& batch) {
        batch.state.velocity[0] = Vec3(kApproach, oblique ? 0.1 : 0.0, 0);
        if (oblique) {
          batch.state.orientation[0] = Rotation(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ()));
          batch.state.angular_velocity[1].z() = 0.5;
        }
        start = sum_of(batch);
      },
      [&](const WorldBatch& batch, const Phase&) {
        const Sum now = sum_of(batch);
        const double unit = start.linear.norm();
        meeting.momentum = std::max(meeting.momentum, (now.linear - start.linear).norm() / unit);
        meeting.spin = std::max(meeting.spin, std::abs(now.angular - start.angular) / unit);
        meeting.parting = batch.state.velocity[1].x() - batch.state.velocity[0].x();
      });
  return meeting;
}

/// Checks head-on and oblique meetings of boxes of all restitutions. Impulses of a pair are opposite however far a
/// solve came: momentum is kept to rounding.
/// @param share largest change of the spin, and half of what the speed of parting may be off
void check_meetings(Accuracy accuracy, double share) {
  for (const double restitution : {0.0, 0.4, 1.0}) {
    for (const bool off_centre : {false, true}) {
      const Meeting meeting = meeting_of(accuracy, restitution, off_centre);
      CAPTURE(static_cast<int>(accuracy), restitution, off_centre, text(meeting.momentum), text(meeting.spin),
              text(meeting.parting));
      CHECK(meeting.momentum < 1e-13);
      CHECK(meeting.spin < share);
      // They did meet.
      CHECK(meeting.parting > -0.5 * kApproach);
      if (!off_centre) CHECK(meeting.parting == Approx(restitution * kApproach).margin(2 * share));
    }
  }
}

}  // namespace

TEST_CASE("native_invariants: two boxes that meet on a frictionless floor keep their momentum",
          "[physics][native_invariants]") {
  check_meetings(Accuracy::screening, 1e-6);
  check_meetings(Accuracy::standard, 1e-6);
  check_meetings(Accuracy::reference, 1e-9);
}

namespace {

/// A scene that must stand still.
struct Standing {
  const char* name;
  Layout layout;
  double top_mass = 0.0;  ///< of the boxes of material 2, kg; 0: as all others
};

std::vector<Standing> standing_scenes() {
  const Vec3 corner(10, 10, 0);
  Layout heavy_top = stack(10, corner, {1.5, 1.5, 0.1});
  heavy_top.boxes.back().material = 2;
  return {{"one box", stack(1, corner, {1.5, 1.5, 0.25})},
          {"stack of 10", stack(10, corner, {1.5, 1.5, 0.1})},
          {"stack of 20", stack(20, corner, {1.5, 1.5, 0.1})},
          {"stack of 10 with a top of 1000 times the mass", heavy_top, 1000 * 1.5 * 1.5 * 0.1 * 250},
          {"plates", stack(12, corner, {1.2, 0.8, 0.01})}};
}

Settings standing_settings(const Standing& scene, Accuracy accuracy) {
  Settings settings = open_floor(0.5);
  settings.contact.box_box = 0.8;
  settings.native.accuracy = accuracy;
  if (scene.top_mass > 0.0) settings.materials[2].mass = scene.top_mass;
  return settings;
}

/// Largest displacement, rotation or speed that any box ever had in a minute, m, rad, m/s and rad/s in one number; 0
/// when nothing ever changed.
double creep_of(const Standing& scene, Accuracy accuracy, double share) {
  const Settings settings = standing_settings(scene, accuracy);
  double creep = 0.0;
  std::vector<Vec3> start;
  watch(
      NativeEngine(settings), scene.layout, constant(share * 0.5 * kGravity, 60), settings,
      [&](WorldBatch& batch) { start = batch.state.position; },
      [&](const WorldBatch& batch, const Phase&) {
        for (std::size_t i = 0; i < start.size(); ++i) {
          creep = std::max({creep, (batch.state.position[i] - start[i]).norm(),
                            Vec3(batch.state.orientation[i].vec()).norm(), batch.state.velocity[i].norm(),
                            batch.state.angular_velocity[i].norm()});
        }
      });
  return creep;
}

}  // namespace

TEST_CASE("native_invariants: below the limit nothing ever moves, not by a bit", "[physics][native_invariants]") {
  for (const Standing& scene : standing_scenes()) {
    for (const Accuracy accuracy : {Accuracy::screening, Accuracy::standard, Accuracy::reference}) {
      const double creep = creep_of(scene, accuracy, 0.9);
      CAPTURE(scene.name, static_cast<int>(accuracy), text(creep));
      CHECK(creep == 0.0);
    }
  }
}

TEST_CASE("native_invariants: gaps and overlaps of a micrometre settle once, then nothing moves",
          "[physics][native_invariants]") {
  for (const Accuracy accuracy : {Accuracy::screening, Accuracy::standard, Accuracy::reference}) {
    for (std::uint32_t seed = 1; seed <= 3; ++seed) {
      Random random(seed);
      // Columns side by side; every box is off by up to a micrometre in every direction.
      Layout layout = layout_of({});
      for (int x = 0; x < 2; ++x) {
        for (int y = 0; y < 2; ++y) {
          for (int z = 0; z < 5; ++z) {
            const Vec3 corner = Vec3(10 + 0.8 * x, 10 + 0.6 * y, 0.3 * z) + random.vector(-1e-6, 1e-6);
            layout.boxes.push_back(box(corner, {0.8, 0.6, 0.3}));
          }
        }
      }
      Settings settings = open_floor(0.5);
      settings.contact.box_box = 0.8;
      settings.native.accuracy = accuracy;
      const Acceleration acceleration =
          acceleration_of({{2, Vec3(0.45 * kGravity, 0, 0)}, {58, Vec3(0.45 * kGravity, 0, 0)}});
      StateColumns settled;
      bool still = true;
      double moved = 0.0;
      std::vector<Vec3> start;
      watch(
          NativeEngine(settings), layout, acceleration, settings, [&](WorldBatch& b) { start = b.state.position; },
          [&](const WorldBatch& batch, const Phase& phase) {
            for (std::size_t i = 0; i < start.size(); ++i)
              moved = std::max(moved, (batch.state.position[i] - start[i]).norm());
            if (phase.begin == 0.0) {
              settled = batch.state;
            } else {
              still = still && same_bits(settled, batch.state);
            }
          });
      double speed = 0.0;
      for (const Vec3& velocity : settled.velocity) speed = std::max(speed, velocity.norm());
      CAPTURE(static_cast<int>(accuracy), seed, text(moved), text(speed));
      CHECK(still);
      CHECK(speed == 0.0);
      // In a step of `screening` a box would fall by 1.4 mm.
      CHECK(moved < (accuracy == Accuracy::screening ? 5e-5 : 1e-5));
    }
  }
}

// Wedged boxes with much friction: the splitting alone leaves residuals of many |g - a| h, in steps of any length.
TEST_CASE("native: loads with a friction coefficient of 2 are solved in every step", "[physics][convergence]") {
  Settings settings;
  settings.contact.friction_model = FrictionModel::pairs;
  settings.contact.box_box = settings.contact.box_floor = settings.contact.box_wall = 2.0;
  for (const char* name : {"BR15_077_wall", "unstable_BR15_077_bpjs"}) {
    const Layout layout = bundled_layout(name, settings);
    for (const Vec3& push : {Vec3(0.8 * kGravity, 0, 0), Vec3(-0.5 * kGravity, 0, 0)}) {
      CAPTURE(name, push.x());
      const Run result = run(NativeEngine(settings), layout,
                             acceleration_of({{0.5, Vec3::Zero()}, {1.0, push}, {1.5, Vec3::Zero()}}), settings);
      CHECK(result.record.row.status == Status::ok);
    }
  }
}

}  // namespace native_invariants_test
