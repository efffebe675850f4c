#include "core/native/solver/interior_point.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <iterator>
#include <optional>

#include "core/native/constants.hpp"
#include "core/native/solver/admm.hpp"
#include "core/native/solver/each_instruction_set.hpp"
#include "core/native/solver/equilibrium.hpp"
#include "core/native/solver/resting_piles.hpp"
#include "core/native/solver/solved_problems.hpp"
#include "random.hpp"
#include "same_bits.hpp"

namespace interior_point_test {

using namespace holdfast::internal;
using namespace holdfast::internal::native;

namespace {

constexpr double kTolerance = 1e-8;  ///< of the equilibrium residual

/// Whether the problem's impulses balance its bodies, or its velocities prove that none do; neither: nothing.
std::optional<bool> decided(EquilibriumCheck& check, const ContactProblem& problem, double unit,
                            double tolerance = kTolerance) {
  double mass = 0.0;
  for (const ProblemBody& body : problem.bodies) mass += body.mass;
  if (check.residual(problem, unit) <= tolerance) return true;
  if (check.refutes_rest(problem, mass * unit)) return false;
  return std::nullopt;
}

struct Decision {
  std::optional<bool> rests;
  int iterations = 0;
};

/// Whether the bodies of the problem can rest, as a proof of rest asks.
Decision decides(InteriorPoint& method, ContactProblem& problem, double unit, double tolerance = kTolerance) {
  EquilibriumCheck check;
  Decision decision;
  method.start(problem, unit);
  while (!decision.rests && decision.iterations < kInteriorIterations && method.iterate(problem)) {
    ++decision.iterations;
    decision.rests = decided(check, problem, unit, tolerance);
  }
  return decision;
}

Decision decides(Pile& pile, double tolerance = kTolerance) {
  InteriorPoint method;
  return decides(method, pile.problem, pile.unit, tolerance);
}

/// Piles under loads of these shares of what the weakest contact of some of them holds.
std::vector<Pile> assorted_piles(const std::vector<double>& shares = {0.0, 0.5, 1.0, 1.1, 3.0}) {
  std::vector<Pile> piles;
  for (const double share : shares) {
    piles.push_back(box_on_floor({1, 1, 0.2}, 0.4, load(0.3 * share * kGravity, 0.2 * share * kGravity)));
    piles.push_back(box_on_floor({0.3, 0.5, 2}, 0.9, load(0.15 * share * kGravity)));
    piles.push_back(stack({1, 2, 4}, {0.3, 0.5, 0.4}, load(0.3 * share * kGravity)));
    piles.push_back(box_at_wall(2.0 * share, 0.3, 0.01));
  }
  piles.push_back(box_on_floor({1, 1, 1}, 0.0, load(0)));
  piles.push_back(box_on_floor({1, 1, 1}, 0.5, load(1, 0, kGravity)));
  return piles;
}

double sum(const Lanes& lanes) { return (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]); }

/// Impulses and contact velocities of a problem, point after point.
std::vector<double> contact_numbers(const ContactProblem& problem, double impulse_factor = 1.0) {
  std::vector<double> numbers;
  for (const ContactConstraint& contact : problem.constraints)
    for (std::size_t d = 0; d < 3; ++d)
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        numbers.push_back(impulse_factor * contact.impulse.row[d][lane]);
        numbers.push_back(contact.contact_velocity.row[d][lane]);
      }
  return numbers;
}

bool are_finite(const std::vector<double>& numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](double number) { return std::isfinite(number); });
}

void check_decision(Pile pile, bool rests, double tolerance = kTolerance) {
  const Decision decision = decides(pile, tolerance);
  CAPTURE(rests, decision.iterations, EquilibriumCheck().residual(pile.problem, pile.unit));
  REQUIRE(are_finite(contact_numbers(pile.problem)));
  REQUIRE(decision.rests.has_value());
  CHECK(*decision.rests == rests);
}

/// Turns all of a problem.
void turn(ContactProblem& problem, const Mat3& axes) {
  const auto turn = [&](double& x, double& y, double& z) {
    const Vec3 turned = axes * Vec3(x, y, z);
    x = turned.x();
    y = turned.y();
    z = turned.z();
  };
  for (ProblemBody& body : problem.bodies) body.inertia = (axes * body.inertia * axes.transpose()).eval();
  for (BodyVector& v : problem.free_velocity) turn(v.row[0], v.row[1], v.row[2]);
  for (ContactConstraint& contact : problem.constraints) {
    for (Direction& direction : contact.directions) turn(direction[0], direction[1], direction[2]);
    for (std::array<Lanes, 3>* arms : {&contact.arms.a, &contact.arms.b})
      for (std::size_t lane = 0; lane < kLanes; ++lane) turn((*arms)[0][lane], (*arms)[1][lane], (*arms)[2][lane]);
  }
}

}  // namespace

TEST_CASE("interior_point: a box at rest is carried by its weight", "[core][interior_point]") {
  Pile pile = box_on_floor({1, 1, 0.2}, 0.5, load(0));
  const Decision decision = decides(pile);
  CAPTURE(decision.iterations);
  CHECK(decision.rests == true);
  CHECK(sum(pile.problem.constraints[0].impulse.row[0]) == Approx(3.0 * pile.unit).epsilon(1e-7));
}

TEST_CASE("interior_point: a box holds up to the limit of friction, and no further", "[core][interior_point]") {
  const double friction = 0.45;
  const double direction = GENERATE(0.0, 0.4, 2.0);
  for (const double share : {0.0, 0.5, 0.99, 1.0 - 1e-6, 1.0, 1.0 + 1e-6, 1.01, 3.0}) {
    const double sideways = share * friction * kGravity;
    CAPTURE(direction, share);
    check_decision(
        box_on_floor({1, 1, 0.2}, friction, load(sideways * std::cos(direction), sideways * std::sin(direction))),
        share <= 1.0);
  }
}

TEST_CASE("interior_point: a tall box stands up to the ratio of its base to its height", "[core][interior_point]") {
  const double ratio = 0.25;
  for (const double share : {0.9, 1.0 - 1e-6, 1.0, 1.0 + 1e-6, 1.1}) {
    CAPTURE(share);
    check_decision(box_on_floor({0.5, 0.7, 2}, 0.8, load(share * ratio * kGravity)), share <= 1.0);
  }
}

TEST_CASE("interior_point: a stack holds as its weakest contact does", "[core][interior_point]") {
  struct Case {
    std::vector<double> masses, frictions;
  };
  const std::vector<Case> cases = {{{1, 5}, {0.2, 0.4}}, {{5, 1}, {0.4, 0.2}}, {{1, 30, 2}, {0.4, 0.2, 0.3}}};
  for (const Case& given : cases) {
    for (const double share : {0.9, 1.0 - 1e-6, 1.0, 1.0 + 1e-6, 1.1}) {
      CAPTURE(given.masses, given.frictions, share);
      // Exactly at the limit, rounding leaves more than `kTolerance` of the residual of some stacks.
      check_decision(stack(given.masses, given.frictions, load(0.2 * share * kGravity)), share <= 1.0,
                     share == 1.0 ? 1e-6 : kTolerance);
    }
  }
}

TEST_CASE("interior_point: contacts without friction carry a weight, and hold nothing sideways",
          "[core][interior_point]") {
  check_decision(box_on_floor({1, 1, 1}, 0.0, load(0)), true);
  check_decision(stack({1, 2}, {0.0, 0.0}, load(0)), true);
  check_decision(box_on_floor({1, 1, 1}, 0.0, load(1e-6 * kGravity)), false);
  check_decision(stack({1, 2}, {0.0, 0.5}, load(1e-6 * kGravity)), false);
  Pile pile = box_on_floor({1, 1, 1}, 0.0, load(0));
  decides(pile);
  for (const std::size_t tangent : {1U, 2U})
    for (const double impulse : pile.problem.constraints[0].impulse.row[tangent]) CHECK(impulse == 0.0);
}

TEST_CASE("interior_point: a wall holds a push up to its bound, and no further", "[core][interior_point]") {
  const double push = 3.0;
  const double needed = 2.0 * push * kStep / 4.0;  // impulse of each of four points
  for (const double share : {0.5, 0.99, 1.0 - 1e-6, 1.0, 1.0 + 1e-6, 1.01, 100.0}) {
    CAPTURE(share);
    check_decision(box_at_wall(push, 0.0, share * needed), share >= 1.0);
    // What is missing is what friction on the floor holds.
    check_decision(box_at_wall(push + 0.2 * kGravity, 0.0, share * needed, 0.2), share >= 1.0);
  }
  check_decision(box_at_wall(push, 0.0, kNoBound), true);
  check_decision(box_at_wall(push, 0.0, 0.0), false);
  check_decision(box_at_wall(0.0, 0.3, 0.0), true);
}

TEST_CASE("interior_point: nothing holds a box that is pulled away", "[core][interior_point]") {
  Pile pile = box_on_floor({1, 1, 1}, 0.5, load(0.1, 0.2, 3.0));
  CHECK(decides(pile).rests == false);
  check_decision(box_at_wall(-1.0, 0.5, kNoBound), false);
}

TEST_CASE("interior_point: the motion of a refuted box is the nearest one of the dual cones",
          "[core][interior_point]") {
  // A box that slides rises by mu of its slip: (1, mu) is the direction of the dual cone's edge.
  const double friction = 0.4;
  const double sideways = 0.7 * kGravity;
  Pile pile = box_on_floor({2, 2, 0.1}, friction, load(sideways));
  InteriorPoint method;
  method.start(pile.problem, pile.unit);
  for (int i = 0; i < 30; ++i) method.iterate(pile.problem);
  const double slip = kStep * (sideways - friction * kGravity) / (1.0 + friction * friction);
  const double* v = pile.problem.velocity[0].row;
  CHECK(v[0] == Approx(slip).epsilon(1e-6));
  CHECK(v[2] == Approx(friction * slip).epsilon(1e-6));
  CHECK(std::abs(v[1]) < 1e-6 * slip);
  CHECK(angular(pile.problem.velocity[0]).norm() < 1e-6 * slip);
}

TEST_CASE("interior_point: impulses and contact velocities are in their cones after every iteration",
          "[core][interior_point]") {
  for (Pile& pile : assorted_piles()) {
    InteriorPoint method;
    method.start(pile.problem, pile.unit);
    EquilibriumCheck check;
    for (int i = 0; i < kInteriorIterations; ++i) {
      CAPTURE(i);
      REQUIRE(are_finite(contact_numbers(pile.problem)));
      REQUIRE(impulses_are_in_cones(pile.problem));
      for (std::size_t p = 0; p < pile.problem.constraints.size(); ++p) {
        const ContactConstraint& contact = pile.problem.constraints[p];
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
          const double slip = std::hypot(contact.contact_velocity.row[1][lane], contact.contact_velocity.row[2][lane]);
          REQUIRE(contact.contact_velocity.row[0][lane] >= (1.0 - 1e-9) * contact.friction * slip);
          REQUIRE(contact.impulse.row[0][lane] <= (1.0 + 1e-9) * pile.problem.normal_bounds[p].lane[lane]);
        }
      }
      if (decided(check, pile.problem, pile.unit) || !method.iterate(pile.problem)) break;
    }
  }
}

TEST_CASE("interior_point: what rounding ends stays as it is", "[core][interior_point]") {
  // Beyond the decision, exactly at the limit of friction too.
  for (Pile& pile : assorted_piles()) {
    InteriorPoint method;
    method.start(pile.problem, pile.unit);
    ContactProblem before = pile.problem;
    int iterations = 0;
    for (; iterations < kInteriorIterations && method.iterate(pile.problem); ++iterations) {
      CAPTURE(iterations);
      REQUIRE(are_finite(contact_numbers(pile.problem)));
      for (const BodyVector& v : pile.problem.velocity) REQUIRE(are_finite({std::begin(v.row), std::end(v.row)}));
      before = pile.problem;
    }
    CAPTURE(iterations);
    CHECK(same_bits(before.velocity, pile.problem.velocity));
    CHECK(same_bits(contact_numbers(before), contact_numbers(pile.problem)));
  }
}

TEST_CASE("interior_point: masses times 2 double the impulses to the bit", "[core][interior_point]") {
  for (Pile& pile : assorted_piles()) {
    Pile heavy = pile;
    for (ProblemBody& body : heavy.problem.bodies) {
      body.mass *= 2.0;
      body.inertia *= 2.0;
    }
    for (ContactConstraint& contact : heavy.problem.constraints) contact.effective_mass *= 2.0;
    for (NormalBounds& bounds : heavy.problem.normal_bounds)
      for (double& bound : bounds.lane) bound *= 2.0;
    const Decision decision = decides(pile);
    const Decision other = decides(heavy);
    CHECK(other.rests == decision.rests);
    CHECK(other.iterations == decision.iterations);
    CHECK(same_bits(heavy.problem.velocity, pile.problem.velocity));
    CHECK(same_bits(contact_numbers(heavy.problem), contact_numbers(pile.problem, 2.0)));
  }
}

TEST_CASE("interior_point: a result does not depend on what the object solved before", "[core][interior_point]") {
  InteriorPoint used;
  for (int round = 0; round < 2; ++round) {
    for (Pile& pile : assorted_piles()) {
      Pile again = pile;
      const Decision fresh = decides(pile);
      const Decision other = decides(used, again.problem, again.unit);
      CHECK(other.rests == fresh.rests);
      CHECK(other.iterations == fresh.iterations);
      CHECK(same_bits(again.problem.velocity, pile.problem.velocity));
      CHECK(same_bits(contact_numbers(again.problem), contact_numbers(pile.problem)));
    }
  }
}

TEST_CASE("interior_point: what is in the problem's velocities does not matter", "[core][interior_point]") {
  Pile pile = box_on_floor({1, 1, 0.2}, 0.4, load(2));
  Pile moving = pile;
  moving.problem.velocity[0].row[0] = 5.0;
  moving.problem.constraints[0].contact_velocity.row[2].fill(3.0);
  decides(pile);
  decides(moving);
  CHECK(same_bits(moving.problem.velocity, pile.problem.velocity));
  CHECK(same_bits(contact_numbers(moving.problem), contact_numbers(pile.problem)));
}

TEST_CASE("interior_point: every instruction set computes the same bits", "[core][interior_point]") {
  for (const Pile& pile : assorted_piles()) {
    std::vector<Pile> solved;
    std::vector<int> iterations;
    for_each_instruction_set([&](std::int64_t) {
      Pile& own = solved.emplace_back(pile);
      iterations.push_back(decides(own).iterations);
    });
    REQUIRE_FALSE(solved.empty());
    for (std::size_t i = 0; i < solved.size(); ++i) {
      CHECK(iterations[i] == iterations[0]);
      CHECK(same_bits(solved[i].problem.velocity, solved[0].problem.velocity));
      CHECK(same_bits(contact_numbers(solved[i].problem), contact_numbers(solved[0].problem)));
    }
  }
}

TEST_CASE("interior_point: lanes without a point, and points whose bound is 0, take no part",
          "[core][interior_point]") {
  // A box on three corners, and a wall that may not press it.
  Pile pile = box_at_wall(0.0, 0.3, 0.0);
  ContactConstraint& floor = pile.problem.constraints[0];
  floor.count = 3;
  decides(pile);
  for (const ContactConstraint& contact : pile.problem.constraints) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const bool takes_part = &contact == &floor && lane < 3;
      CAPTURE(&contact - &floor, lane);
      for (std::size_t d = 0; d < 3; ++d) {
        CHECK((takes_part || contact.impulse.row[d][lane] == 0.0));
        CHECK((takes_part || contact.contact_velocity.row[d][lane] == 0.0));
      }
      CHECK((!takes_part || contact.contact_velocity.row[0][lane] > 0.0));
    }
  }
}

TEST_CASE("interior_point: it decides as the splitting does", "[core][interior_point]") {
  int rests = 0;
  int refuted = 0;
  const auto compare = [&](const ContactProblem& given, double unit) {
    ContactProblem problem = given;
    ContactProblem split = given;
    InteriorPoint method;
    const Decision decision = decides(method, problem, unit, 1e-6);
    const SolveLimits limits{.tolerance = 1e-8,
                             .velocity_unit = unit,
                             .iterations = 3000,
                             .sticking = kRestPenalty,
                             .sliding = kRestPenalty,
                             .idle_penalty = kRestIdlePenalty,
                             .refit_share = 0.0,
                             .projection = Projection::orthogonal,
                             .plain_iterations = 0};
    AdmmSolver().solve(split, limits);
    const double residual = EquilibriumCheck().residual(split, unit);
    CAPTURE(unit, decision.iterations, residual);
    REQUIRE(decision.rests.has_value());
    CHECK(*decision.rests == (residual <= 1e-6));
    ++(*decision.rests ? rests : refuted);
  };
  for (Pile& pile : assorted_piles({0.0, 0.5, 0.9, 1.1, 3.0})) {
    pile.problem.impulse_per_mass = pile.unit;
    compare(pile.problem, pile.unit);
  }
  for (const SolvedProblem& kept : problems_of_a_stack())
    if (kept.given.limits.projection == Projection::orthogonal)
      compare(kept.given.problem, kept.given.limits.velocity_unit);
  CAPTURE(rests, refuted);
  CHECK(rests > 5);
  CHECK(refuted > 5);
}

TEST_CASE("interior_point: a turned pile is decided as it was, with its motion turned", "[core][interior_point]") {
  // Not at share 0: nothing pushes the box to the wall, nor does the floor's friction hold it. That is exactly a limit,
  // where rounding has a say.
  Random random(9);
  for (Pile& pile : assorted_piles({0.5, 1.1, 3.0})) {
    Pile turned = pile;
    const Mat3 axes = random.rotation().toRotationMatrix();
    turn(turned.problem, axes);
    const Decision decision = decides(pile);
    const Decision other = decides(turned);
    CHECK(other.rests == decision.rests);
    CHECK(other.iterations == decision.iterations);
    for (std::size_t i = 0; i < pile.boxes.size(); ++i) {
      const BodyVector& v = pile.problem.velocity[i];
      const BodyVector& other_v = turned.problem.velocity[i];
      const double error = (axes * linear(v) - linear(other_v)).norm();
      const double turning_error = pile.problem.bodies[i].radius * (axes * angular(v) - angular(other_v)).norm();
      CAPTURE(i, error, turning_error);
      CHECK(error < 1e-6 * pile.unit);
      CHECK(turning_error < 1e-6 * pile.unit);
    }
  }
}

}  // namespace interior_point_test
