// Known answers for the native engine.

#include "core/native/native_engine.hpp"

#include <algorithm>
#include <cmath>

#include "core/native/native_options.hpp"
#include "physics/measures.hpp"
#include "scenes.hpp"

using namespace holdfast;
using namespace holdfast::scenes;
using namespace holdfast::physics;

namespace {

const Vec3 kFlat(1.1, 1.1, 0.25);  ///< a box that slides and does not tip, m
const Vec3 kTall(0.5, 0.5, 1.0);   ///< a box that tips and does not slide on high friction, m

Settings with(Accuracy accuracy, Settings settings) {
  settings.native.accuracy = accuracy;
  return settings;
}

Run native_run(const Layout& layout, const Motion& motion, const Settings& settings,
               const std::function<void(StateColumns&)>& prepare = {}) {
  return run(NativeEngine(settings), layout, motion, settings, prepare);
}

Layout one_box(const Vec3& size, double height = 0.0) { return layout_of({box({10, 10, height}, size)}); }

/// True when every box is where it was, to the last bit.
bool stayed(const Run& run) {
  for (std::size_t i = 0; i < run.start.size(); ++i) {
    if (run.state.position[i] != run.start[i] || run.state.velocity[i] != Vec3::Zero() ||
        run.state.angular_velocity[i] != Vec3::Zero() ||
        run.state.orientation[i].coeffs() != Rotation::Identity().coeffs())
      return false;
  }
  return true;
}

double largest_displacement(const Run& run) {
  double largest = 0.0;
  for (std::size_t i = 0; i < run.start.size(); ++i) largest = std::max(largest, run.displacement(i).norm());
  return largest;
}

double tilt_of(const Run& run, std::size_t i = 0) {
  return 2.0 * std::asin(std::min(1.0, Vec3(run.state.orientation[i].vec()).norm()));
}

}  // namespace

TEST_CASE("native_engine: a box slides at a - mu g, in every direction", "[core][native_engine]") {
  const double limit = 0.5 * kGravity;
  for (const auto& [accuracy, bound] : {std::pair(Accuracy::standard, 1e-6), std::pair(Accuracy::reference, 1e-9)}) {
    for (const Vec3& heading : {Vec3(1, 0, 0), Vec3(0, -1, 0), Vec3(0.6, 0.8, 0)}) {
      const Run slide =
          native_run(one_box(kFlat), motion_of({{1, 1.5 * limit * heading}}), with(accuracy, open_floor(0.5)));
      const double error = (slide.displacement() + 0.25 * limit * heading).norm() / (0.25 * limit);
      CAPTURE(static_cast<int>(accuracy), heading.transpose(), text(error));
      CHECK(error < bound);
      CHECK((slide.state.velocity[0] + 0.5 * limit * heading).norm() < bound * limit);
    }
  }
}

TEST_CASE("native_engine: sliding begins at mu g, below it nothing moves at all", "[core][native_engine]") {
  const double limit = 0.5 * kGravity;
  for (const auto& [accuracy, off] : {std::pair(Accuracy::standard, 1e-3), std::pair(Accuracy::reference, 1e-3),
                                      std::pair(Accuracy::reference, 1e-6)}) {
    const Settings settings = with(accuracy, open_floor(0.5));
    const Run below = native_run(one_box(kFlat), constant((1 - off) * limit, 2), settings);
    const Run above = native_run(one_box(kFlat), constant((1 + off) * limit, 2), settings);
    const double path = -0.5 * off * limit * 4;
    CAPTURE(static_cast<int>(accuracy), off, text(largest_displacement(below)),
            text(above.displacement().x() / path - 1));
    CHECK(stayed(below));
    CHECK(above.displacement().x() == Approx(path).epsilon(1e-4));
  }
}

TEST_CASE("native_engine: tipping begins at g l/h and grows as a pendulum falls", "[core][native_engine]") {
  const double limit = 0.5 * kGravity;
  for (const auto& [accuracy, off, bound] :
       {std::tuple(Accuracy::standard, 1e-3, 5e-3), std::tuple(Accuracy::reference, 1e-3, 1e-3),
        std::tuple(Accuracy::reference, 1e-6, 1e-3)}) {
    const Settings settings = with(accuracy, open_floor(1.0));
    const Run below = native_run(one_box(kTall), constant((1 - off) * limit, 3), settings);
    const Run above = native_run(one_box(kTall), constant((1 + off) * limit, 1), settings);
    // About the edge, to first order: θ'' = 3 g / (2 h) (θ + off · l h / (l² + h²)).
    const double rate = std::sqrt(1.5 * kGravity / kTall.z());
    const double tilt = off * 0.5 / 1.25 * (std::cosh(rate) - 1);
    CAPTURE(static_cast<int>(accuracy), off, text(largest_displacement(below)), text(tilt_of(above)),
            text(tilt_of(above) / tilt - 1));
    CHECK(stayed(below));
    CHECK(tilt_of(above) == Approx(tilt).epsilon(bound));
  }
}

TEST_CASE("native_engine: an offset centre of mass tips at g x/z", "[core][native_engine]") {
  Settings settings = open_floor(2.0);
  settings.materials[1].centre_of_mass = {0.1, 0, -0.2};
  for (const Accuracy accuracy : {Accuracy::standard, Accuracy::reference}) {
    settings.native.accuracy = accuracy;
    // It lies 0.3 m up, 0.35 m behind the front edge and 0.15 m before the rear edge.
    for (const double limit : {kGravity * 0.35 / 0.3, -kGravity * 0.15 / 0.3}) {
      const Run below = native_run(one_box(kTall), constant(0.999 * limit, 2), settings);
      const Run above = native_run(one_box(kTall), constant(1.001 * limit, 2), settings);
      CAPTURE(limit, text(largest_displacement(below)), above.record.end.peak_displacement[0]);
      CHECK(stayed(below));
      CHECK(above.record.end.peak_displacement[0] > 0.02F);
    }
  }
}

TEST_CASE("native_engine: a stack of ten stays below its limit and slides above it", "[core][native_engine]") {
  Settings settings = open_floor(0.4);
  settings.contact.box_box = 0.8;
  const double limit = 0.4 * kGravity;
  const Layout layout = stack(10, {10, 10, 0}, {1, 1, 0.2});
  for (const double share : {0.0, 0.95, 0.999}) {
    for (const Accuracy accuracy : {Accuracy::standard, Accuracy::reference}) {
      settings.native.accuracy = accuracy;
      const Run below = native_run(layout, constant(share * limit, 1), settings);
      CAPTURE(static_cast<int>(accuracy), share, text(largest_displacement(below)));
      CHECK(stayed(below));
      CHECK(below.record.outcome.status == Status::ok);
    }
  }
  // The stack goes as one: only its lowest box slides.
  const double over = 0.2;
  for (const auto& [accuracy, bound] : {std::pair(Accuracy::standard, 1e-4), std::pair(Accuracy::reference, 1e-6)}) {
    settings.native.accuracy = accuracy;
    const Run above = native_run(layout, constant((1 + over) * limit, 0.5), settings);
    double worst = 0.0;
    const double path = 0.5 * over * limit * 0.25;
    for (std::size_t i = 0; i < 10; ++i)
      worst = std::max(worst, (above.displacement(i) + Vec3(path, 0, 0)).norm() / path);
    CAPTURE(static_cast<int>(accuracy), text(worst));
    CHECK(worst < bound);
  }
}

TEST_CASE("native_engine: free fall is exact", "[core][native_engine]") {
  const Layout layout = layout_of({box({1.237, 0.791, 1.5}, {0.613, 0.447, 0.379})});
  for (const Accuracy accuracy : {Accuracy::screening, Accuracy::standard, Accuracy::reference}) {
    Settings settings;
    settings.native.accuracy = accuracy;
    const Run fall = native_run(layout, constant(1.5, 0.5), settings);
    CHECK(fall.displacement().z() == Approx(-0.5 * kGravity * 0.25).epsilon(1e-12));
    CHECK(fall.displacement().x() == Approx(-0.5 * 1.5 * 0.25).epsilon(1e-12));
    CHECK(fall.state.velocity[0].z() == Approx(-0.5 * kGravity).epsilon(1e-12));
    CHECK(tilt_of(fall) == 0.0);
  }
}

TEST_CASE("native_engine: a landing ends on the floor at rest, without rebound", "[core][native_engine]") {
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

TEST_CASE("native_engine: a box that lands on another one does not sink into it", "[core][native_engine]") {
  for (const double steps_per_second : {60.0, 240.0}) {
    const double overlap = overlap_of_cubes({0, 0, 0.502}, {0, 0, -3}, steps_per_second);
    CAPTURE(steps_per_second, text(overlap));
    CHECK(overlap < 1e-5);
  }
}

// Expected: they meet at their edges. Before the step each is beyond the other's edge, along both axes: no contact is
// known, and they overlap by as much as they go in a step.
TEST_CASE("native_engine: boxes that approach across their edges do not pass into each other",
          "[core][native_engine]") {
  for (const double steps_per_second : {60.0, 240.0}) {
    const double overlap = overlap_of_cubes({0.505, 0, 0.504}, {-3, 0, -3}, steps_per_second);
    CAPTURE(steps_per_second, text(overlap));
    CHECK(overlap < 1e-3);
  }
}

// Expected: contacts are found for a whole step, also at the end of a step that a phase cut short. Found for the short
// one, a plate would be beyond the other after the next.
TEST_CASE("native_engine: a thin plate stops another that comes fast, right after a short phase too",
          "[core][native_engine]") {
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
        NativeEngine(settings), layout, motion_of({{first, Vec3::Zero()}, {0.1, Vec3::Zero()}}), settings,
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

// Expected: it slides to the fixed box, comes back as fast as it went, and hands its speed to the other, which slides
// on; what it meets on its way back was no neighbour in contact before.
TEST_CASE("native_engine: a box goes from one impact to the next within a step", "[core][native_engine]") {
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
TEST_CASE("native_engine: what friction nearly stops ends at what it touches", "[core][native_engine]") {
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
    CHECK(lowest > -2e-6);
    CHECK(lowest == Approx(std::max(0.0, gap - path)).margin(1e-4));
  }
}

// Expected: free fall, an elastic impact that turns the velocity round, free fall.
TEST_CASE("native_engine: an impact is located however shortly before a step's end", "[core][native_engine]") {
  Settings settings = open_floor(0.5);
  settings.contact.restitution = 1.0;
  const double step = 1.0 / 240;
  settings.native.steps_per_second = 1.0 / step;
  const double speed = 10.0;
  for (const auto& [rest, bound] : {std::pair(0.3, 1e-11), std::pair(1e-2, 1e-11), std::pair(9e-5, 1e-11),
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
TEST_CASE("native_engine: a kerb throws over what is fast enough, and nothing slower", "[core][native_engine]") {
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

TEST_CASE("native_engine: an oblique elastic impact is nearly the same at every accuracy", "[core][native_engine]") {
  Settings settings = open_floor(0.0);
  settings.contact.restitution = 1.0;
  const Layout layout = layout_of({box({9, 10, 0}, {0.8, 0.8, 0.5}), box({10.5, 10, 0}, {0.9, 0.8, 0.5})});
  std::vector<double> parting;
  for (const Accuracy accuracy : {Accuracy::screening, Accuracy::standard, Accuracy::reference}) {
    settings.native.accuracy = accuracy;
    const Run run = native_run(layout, constant(0, 0.5), settings, [](StateColumns& state) {
      state.velocity[0].x() = 2;
      state.orientation[0] = Rotation(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ()));
    });
    parting.push_back(run.state.velocity[1].x() - run.state.velocity[0].x());
  }
  CAPTURE(text(parting[0]), text(parting[1]), text(parting[2]));
  CHECK(parting[0] == Approx(parting[2]).epsilon(5e-3));
  CHECK(parting[1] == Approx(parting[2]).epsilon(5e-3));
}

TEST_CASE("native_engine: an elastic box bounces to where it came from", "[core][native_engine]") {
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

TEST_CASE("native_engine: restitution is the box's on the floor, the smaller one of two boxes",
          "[core][native_engine]") {
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
      const double parting = run.state.velocity[1].x() - run.state.velocity[0].x();
      CAPTURE(static_cast<int>(accuracy), first, second, text(parting));
      CHECK(parting == Approx(2 * restitution).epsilon(1e-4));
    }
  }
}

TEST_CASE("native_engine: friction of a pair is the product of its materials", "[core][native_engine]") {
  Settings settings = open_floor(0.0);
  settings.contact.friction_model = FrictionModel::product;
  settings.container.friction = 0.8;
  settings.materials[1].friction = 0.5;
  settings.materials[2].friction = 1.2;
  settings.materials[2].mass = 1e5;
  for (const auto& [accuracy, bound] : {std::pair(Accuracy::standard, 1e-4), std::pair(Accuracy::reference, 1e-7)}) {
    settings.native.accuracy = accuracy;
    // 0.5 · 0.8 of a box on the floor; 0.5 · 1.2 of the same box on one that holds.
    const Layout layout =
        layout_of({box({5, 5, 0}, kFlat, 1), box({10, 10, 0}, {3, 3, 0.4}, 2), box({11, 11, 0.4}, {1, 1, 0.2}, 1)});
    const Run run = native_run(layout, constant(0.7 * kGravity, 0.5), settings);
    const double on_floor = 0.125 * kGravity * (0.7 - 0.4);
    const double on_box = 0.125 * kGravity * (0.7 - 0.6);
    CAPTURE(static_cast<int>(accuracy), text(-run.displacement(0).x() / on_floor - 1),
            text(-run.displacement(2).x() / on_box - 1));
    CHECK(run.displacement(0).x() == Approx(-on_floor).epsilon(bound));
    CHECK(run.displacement(1).norm() < 1e-3 * bound * on_box);
    CHECK(run.displacement(2).x() == Approx(-on_box).epsilon(bound));
  }
}

TEST_CASE("native_engine: a frictionless wall stops what is across it, and lets it slide along",
          "[core][native_engine]") {
  const Layout layout = layout_of({box({0.2, 10, 0}, kFlat)});
  for (const auto& [accuracy, bound] : {std::pair(Accuracy::standard, 1e-5), std::pair(Accuracy::reference, 1e-6)}) {
    const Run run = native_run(layout, motion_of({{1, Vec3(2, -1, 0)}}), with(accuracy, open_floor(0.0)));
    CAPTURE(static_cast<int>(accuracy), run.displacement().transpose());
    CHECK(run.displacement().x() == Approx(-0.2).margin(1e-5));
    CHECK(run.displacement().y() == Approx(0.5).margin(bound));
    CHECK(std::abs(run.displacement().z()) < 1e-5);
    // Friction of the wall alone holds with mu times the push. It acts off the centre of mass, at the wall, and the
    // floor takes no part.
    Settings rough = with(accuracy, open_floor(0.0));
    rough.contact.box_wall = 0.3;
    const Run along = native_run(layout_of({box({0, 10, 0}, kFlat)}), motion_of({{1, Vec3(8, -4, 0)}}), rough);
    CAPTURE(along.displacement().transpose());
    CHECK(along.displacement().y() == Approx(0.5 * (4 - 0.3 * 8)).epsilon(10 * bound));
  }
}

TEST_CASE("native_engine: a fixed box holds others and never moves", "[core][native_engine]") {
  const Layout layout = layout_of(
      {box({5, 5, 0}, {1, 1, 1}), box({6, 5, 0}, {1, 1, 1}), box({5, 5, 1}, {1, 1, 1}), box({7.2, 5, 0}, {1, 1, 1})});
  for (const Accuracy accuracy : {Accuracy::standard, Accuracy::reference}) {
    const Settings settings = with(accuracy, open_floor(0.5));
    bool fixed_moved = false, others_moved = false;
    double last = 0.0;
    // Against the acceleration the fourth box slides by 0.2 m, into the second, which leans on the first.
    watch(
        NativeEngine(settings), layout, constant(6, 1.5), settings,
        [](WorldBatch& batch) {
          fix(batch, 0);
          batch.boxes.friction[3] = 0.0;
        },
        [&](const WorldBatch& batch, const Phase&) {
          fixed_moved = fixed_moved || batch.state.position[0] != Vec3(5.5, 5.5, 0.5);
          others_moved = others_moved || (batch.state.position[1] - Vec3(6.5, 5.5, 0.5)).norm() > 1e-5;
          last = batch.state.position[3].x();
        });
    CAPTURE(static_cast<int>(accuracy), text(last));
    CHECK_FALSE(fixed_moved);
    CHECK_FALSE(others_moved);
    CHECK(last == Approx(7.5).margin(1e-5));
  }
}

TEST_CASE("native_engine: a box that spins freely keeps its angular momentum and energy", "[core][native_engine]") {
  for (const auto& [accuracy, bound] : {std::pair(Accuracy::standard, 1e-4), std::pair(Accuracy::reference, 1e-5)}) {
    Settings settings = with(accuracy, open_floor(0.5));
    settings.gravity = 0.0;
    const Vec3 spin(1, 0.1, 5);
    Eigen::Vector3d momentum = Vec3::Zero();
    double energy = 0.0, momentum_error = 0.0, energy_error = 0.0;
    watch(
        NativeEngine(settings), layout_of({box({10, 10, 5}, {0.3, 0.9, 0.5})}), constant(0, 2), settings,
        [&](WorldBatch& batch) {
          batch.state.angular_velocity[0] = spin;
          momentum = inertia_of(batch, 0) * spin;
          energy = energy_of(batch, Vec3::Zero());
        },
        [&](const WorldBatch& batch, const Phase&) {
          const Vec3 now = inertia_of(batch, 0) * batch.state.angular_velocity[0];
          momentum_error = std::max(momentum_error, (now - momentum).norm() / momentum.norm());
          energy_error = std::max(energy_error, std::abs(energy_of(batch, Vec3::Zero()) / energy - 1));
        });
    CAPTURE(static_cast<int>(accuracy), text(momentum_error), text(energy_error));
    CHECK(momentum_error < 1e-11);
    CHECK(energy_error < bound);
  }
}

TEST_CASE("native_engine: steps follow the settings, and never straddle a change of the acceleration",
          "[core][native_engine]") {
  const Motion pulse = motion_of({{0.1003, Vec3(0, 0, 0)}, {0.4004, Vec3(3, 0, 0)}, {0.3, Vec3(0, 0, 0)}});
  const Run run = native_run(one_box(kFlat), pulse, open_floor(0.0));
  CHECK(run.state.velocity[0].x() == Approx(-3 * 0.4004).epsilon(1e-6));
  CHECK(run.displacement().x() == Approx(-3 * 0.4004 * (0.2002 + 0.3)).epsilon(1e-6));
  CHECK(run.record.outcome.counters.steps == 25 + 97 + 72);
  // At rest until the pulse.
  CHECK(run.record.outcome.counters.steps_skipped == 25);
}
