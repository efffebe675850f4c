#include "core/native/known_balances.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "core/native/native_scenes.hpp"

namespace known_balances_test {

using namespace holdfast::internal;
using namespace holdfast::internal::native;
using namespace holdfast::internal::scenes;
using native_scenes::kFlat;
using native_scenes::OneWorld;

namespace {

constexpr double kStep = 0.02;  // s
const std::vector<KnownBalances::Contact> kContacts{{-5, 3, 4}, {3, 4, 2}};
const KnownBalances::Island kIsland{3, kContacts};

Vec3 gravity(double x, double y) { return {-x, -y, -9.81}; }

/// Forces that depend on the effective gravity in a linear way, as impulses of a step.
double impulse_of(const Vec3& g, double step, std::size_t p, std::size_t d, std::size_t lane) {
  const double number = static_cast<double>(1 + lane + 4 * (d + 3 * p));
  return step * (number * g.x() + 2.0 * g.y() - number * number * g.z());
}

ContactProblem balanced(const Vec3& g, double step = kStep) {
  ContactProblem problem;
  problem.constraints.resize(kContacts.size());
  for (std::size_t p = 0; p < kContacts.size(); ++p)
    for (std::size_t d = 0; d < 3; ++d)
      for (std::size_t lane = 0; lane < kLanes; ++lane)
        problem.constraints[p].impulse.row[d][lane] = impulse_of(g, step, p, d, lane);
  return problem;
}

/// The largest difference from the impulses that balance it under this effective gravity, over the largest of them.
double error(const ContactProblem& problem, const Vec3& g, double step = kStep) {
  double worst = 0.0, largest = 0.0;
  for (std::size_t p = 0; p < kContacts.size(); ++p) {
    for (std::size_t d = 0; d < 3; ++d) {
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const double wanted = impulse_of(g, step, p, d, lane);
        worst = std::max(worst, std::abs(problem.constraints[p].impulse.row[d][lane] - wanted));
        largest = std::max(largest, std::abs(wanted));
      }
    }
  }
  return worst / largest;
}

KnownBalances known_under(const std::vector<Vec3>& gravities) {
  KnownBalances known;
  for (const Vec3& g : gravities) known.keep(kIsland, g, kStep, balanced(g));
  return known;
}

/// Whether the known balances imply one under this effective gravity, which then is the right one.
bool implies(const KnownBalances& known, const Vec3& g, double step = kStep) {
  ContactProblem problem = balanced(gravity(0.7, 0.7));
  const bool found = known.combine(kIsland, g, step, problem);
  CHECK(error(problem, found ? g : gravity(0.7, 0.7), found ? step : kStep) < 1e-10);
  return found;
}

}  // namespace

TEST_CASE("known_balances: an acceleration between known ones is balanced by their sum", "[core][known_balances]") {
  const KnownBalances line = known_under({gravity(0, -2), gravity(0, 3)});
  for (const double y : {-2.0, -1.9, 0.0, 1.0, 3.0}) CHECK(implies(line, gravity(0, y)));
  CHECK(implies(line, gravity(0, 1), 0.5 * kStep));
  for (const double y : {-2.1, 3.01}) CHECK_FALSE(implies(line, gravity(0, y)));
  CHECK_FALSE(implies(line, gravity(0.01, 0)));

  const KnownBalances plane = known_under({gravity(-1, -1), gravity(1, -1), gravity(1, 1), gravity(-1, 1)});
  for (const double x : {-0.9, 0.1, 0.8})
    for (const double y : {-0.8, 0.0, 0.9}) CHECK(implies(plane, gravity(x, y)));
  CHECK_FALSE(implies(plane, gravity(1.1, 0)));
  CHECK_FALSE(implies(plane, Vec3(0, 0, -9.0)));
}

TEST_CASE("known_balances: nothing is known of other contacts, of another island and of a forgotten one",
          "[core][known_balances]") {
  KnownBalances known = known_under({gravity(0, 0)});
  ContactProblem problem = balanced(gravity(0, 0));
  const std::vector<KnownBalances::Contact> others{{-5, 3, 4}, {3, 4, 3}};
  CHECK(known.combine(kIsland, gravity(0, 0), kStep, problem));
  CHECK_FALSE(known.combine({3, others}, gravity(0, 0), kStep, problem));
  CHECK_FALSE(known.combine({2, kContacts}, gravity(0, 0), kStep, problem));
  CHECK_FALSE(known.combine({4, kContacts}, gravity(0, 0), kStep, problem));
  known.forget(kIsland);
  CHECK_FALSE(known.combine(kIsland, gravity(0, 0), kStep, problem));
}

TEST_CASE("known_balances: what follows from others makes room first", "[core][known_balances]") {
  std::vector<Vec3> gravities;
  for (int i = 0; i <= 50; ++i) gravities.push_back(gravity(0, 0.1 * i));
  const KnownBalances line = known_under(gravities);
  for (const double y : {0.0, 0.05, 2.5, 5.0}) CHECK(implies(line, gravity(0, y)));
  // The four corners stay, whatever comes between them.
  gravities = {gravity(-1, -1), gravity(1, -1), gravity(1, 1), gravity(-1, 1)};
  for (int i = 0; i < 20; ++i) gravities.push_back(gravity(0.9 - 0.09 * i, 0.04 * i));
  const KnownBalances plane = known_under(gravities);
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0}) CHECK(implies(plane, gravity(x, y)));
}

TEST_CASE("known_balances: a try goes as far again, and further or less far after others", "[core][known_balances]") {
  KnownBalances known = known_under({gravity(0, 0)});
  const auto tried = [&](double y) {
    const std::optional<Vec3> g = known.beyond(kIsland, gravity(0, y));
    return g ? -g->y() : 0.0;
  };
  CHECK(tried(0.2) == Approx(0.4));
  known.note_beyond(kIsland, true);
  CHECK(tried(0.2) == Approx(0.6));
  known.note_beyond(kIsland, false);
  known.note_beyond(kIsland, false);
  CHECK(tried(0.2) == Approx(0.3));
  // More than a little change.
  CHECK(tried(2.0) == 0.0);
  for (int i = 0; i < 3; ++i) known.note_beyond(kIsland, false);
  CHECK(tried(0.2) == 0.0);
}

TEST_CASE("known_balances: a stack under a curve of samples is solved for few of them, and slides when it must",
          "[core][known_balances]") {
  // A sine of 50 samples per second up to `largest`, with friction of 0.3 beneath three boxes.
  const auto run = [](double largest) {
    Acceleration sine;
    for (int i = 0; i < 300; ++i)
      sine.segments.push_back({0.02 * i, 0.02, Vec3(0, largest * std::sin(2.0 * std::numbers::pi * i / 300.0), 0)});
    OneWorld scene(open_floor(0.3), stack(3, {5, 5, 0}, kFlat), sine);
    const Vec3 start = scene.batch.state.position[0];
    double farthest = 0.0;
    scene.run([&] {
      scene.world.read_back(scene.batch.state);
      farthest = std::max(farthest, (scene.batch.state.position[0] - start).norm());
    });
    return std::pair(scene.world.counters().solve_iterations, farthest);
  };
  const auto [iterations, farthest] = run(0.29 * kGravity);
  CHECK(farthest == 0.0);
  CHECK(iterations < 1000);  // 3000 where each sample is solved
  CHECK(run(0.31 * kGravity).second > 1e-3);
}

}  // namespace known_balances_test
