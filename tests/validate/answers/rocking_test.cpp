#include "validate/answers/rocking.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "validate/laboratory/scene.hpp"

namespace rocking_test {

using namespace holdfast::internal;

namespace {

constexpr double kGravity = 9.81;

/// A constant acceleration along x in `pieces` intervals, and then none.
Acceleration push(double acceleration, double duration, double after, int pieces = 1) {
  Scene scene;
  for (int i = 0; i < pieces; ++i) scene.then(duration / pieces, {acceleration, 0, 0});
  return scene.then(after, Vec3::Zero()).acceleration;
}

/// Energy of a block per moment of inertia over p², beyond that of the block at rest, without inertial forces.
double energy_of(const RockingBlock& block, const RockingState& state) {
  const double speed = state.velocity / block.frequency;
  return 0.5 * speed * speed + std::cos(block.slenderness - std::abs(state.tilt)) - std::cos(block.slenderness);
}

}  // namespace

TEST_CASE("rocking: a slender block has Housner's quarter period", "[validate]") {
  // With sin(α − θ) ≈ α − θ: T/4 = arcosh(1 / (1 − θ₀/α)) / p; the error is of the order of α².
  const RockingBlock block = rocking_block(0.002, 1.0, 9.81);
  const double expected = std::acosh(1.0 / (1.0 - 0.6)) / block.frequency;
  CHECK(quarter_period(block, 0.6 * block.slenderness) == Approx(expected).epsilon(1e-5));
}

TEST_CASE("rocking: an impact conserves the angular momentum about the other edge", "[validate]") {
  const double width = 0.4;
  const double height = 1.1;
  const RockingBlock block = rocking_block(width, height, 9.81);
  // About the new edge: the part of the rotation, (w² + h²)/12, and that of the centre's velocity ω (h, −w)/2 at
  // (−w, h)/2.
  const double own = (width * width + height * height) / 12.0;
  const double before = own + 0.25 * (height * height - width * width);
  const double after = own + 0.25 * (height * height + width * width);
  CHECK(impact_ratio(block) == Approx(before / after).epsilon(1e-14));
}

TEST_CASE("rocking: peaks lose the energy of the impacts, at intervals of quarter periods", "[validate]") {
  const RockingBlock block = rocking_block(0.25, 1.0, 9.81);
  const double tilt = 0.5 * block.slenderness;
  CHECK(peak_tilt(block, tilt, 0) == Approx(tilt).epsilon(1e-12));
  const double first = peak_tilt(block, tilt, 1);
  CHECK(first < tilt);
  CHECK(peak_tilt(block, first, 1) == Approx(peak_tilt(block, tilt, 2)).epsilon(1e-12));
  CHECK(peak_time(block, tilt, 1) == Approx(quarter_period(block, tilt) + quarter_period(block, first)).epsilon(1e-12));
}

TEST_CASE("rocking: a block lifts off when the acceleration exceeds g tan α, against its direction", "[validate]") {
  const RockingBlock block = rocking_block(0.26, 1.35, kGravity);
  const double limit = kGravity * 0.26 / 1.35;
  CHECK(rocked_by(block, push(0.999999 * limit, 1.0, 0.1), kGravity, 1.0).largest_tilt == 0.0);
  const RockingState left = rocked_by(block, push(1.1 * limit, 0.3, 1e-9), kGravity, 1.0);
  const RockingState right = rocked_by(block, push(-1.1 * limit, 0.3, 1e-9), kGravity, 1.0);
  CHECK(left.tilt < -1e-3);
  CHECK(right.tilt == -left.tilt);
  CHECK(right.velocity == -left.velocity);
  CHECK(left.impacts == 0);
}

// With small angles θ'' = p² (θ + (k − 1) α) for an acceleration of k g α: θ = (k − 1) α (cosh pt − 1). The error is of
// the order of α².
TEST_CASE("rocking: a slender block rises as the hyperbolic cosine", "[validate]") {
  const RockingBlock block = rocking_block(0.002, 1.0, kGravity);
  const double k = 1.3;
  const double time = 0.4;
  const RockingState state = rocked_by(block, push(k * kGravity * 0.002, time, 1e-9), kGravity, 1.0);
  const double expected = (k - 1.0) * block.slenderness * (std::cosh(block.frequency * time) - 1.0);
  CHECK(-state.tilt == Approx(expected).epsilon(1e-5));
}

// Under a constant acceleration the field does no other work than its potential: ½ ω² + p² (cos(α − θ) +
// (a/g) sin(α − θ)) is constant for a block that tilts with the field.
TEST_CASE("rocking: energy in the field is conserved between impacts to 1e-13", "[validate]") {
  const RockingBlock block = rocking_block(0.3, 0.9, kGravity);
  const double share = 1.2 * 0.3 / 0.9;
  const double square = block.frequency * block.frequency;
  const auto energy = [&](const RockingState& state) {
    const double lean = block.slenderness - std::abs(state.tilt);
    return 0.5 * state.velocity * state.velocity / square + std::cos(lean) + share * std::sin(lean);
  };
  const double start = energy(RockingState{});
  for (const double time : {0.1, 0.35, 0.6}) {
    const RockingState state = rocked_by(block, push(share * kGravity, time, 1e-12), kGravity, 3.0);
    CAPTURE(state.tilt, energy(state) - start);
    CHECK(std::abs(energy(state) - start) < 1e-13);
  }
}

// A slender block tips over after a constant acceleration of k g α if it lasts longer than ln(k / (k − 1)) / p:
// Housner's cosh(p t) = 1 + 1 / (2 k (k − 1)).
TEST_CASE("rocking: a push overturns a slender block from Housner's duration on", "[validate]") {
  const RockingBlock block = rocking_block(0.002, 1.0, kGravity);
  for (const double k : {1.2, 1.5, 3.0}) {
    const double critical = std::log(k / (k - 1.0)) / block.frequency;
    const auto overturns = [&](double duration) {
      return rocked_by(block, push(k * kGravity * 0.002, duration, 6.0), kGravity, 2.0 * block.slenderness)
          .has_overturned;
    };
    CAPTURE(k, critical);
    CHECK(overturns(1.0001 * critical));
    CHECK_FALSE(overturns(0.9999 * critical));
  }
}

// Energy at the end of the push: the work a R (sin α − sin(α − θ)) m of the inertial force, in units of m g R. It must
// lift the centre over the edge, by R (1 − cos α).
TEST_CASE("rocking: a stout block overturns if the push has done the work that lifts it over its edge", "[validate]") {
  const RockingBlock block = rocking_block(0.6, 1.2, kGravity);
  const double share = 1.3 * 0.6 / 1.2;
  int overturned = 0;
  for (int i = 0; i < 40; ++i) {
    const double duration = 0.3 + 0.02 * i;
    const RockingState pushed = rocked_by(block, push(share * kGravity, duration, 1e-12), kGravity, 3.0);
    const double work = share * (std::sin(block.slenderness) - std::sin(block.slenderness - std::abs(pushed.tilt)));
    const bool expected = work > 1.0 - std::cos(block.slenderness);
    const RockingState later = rocked_by(block, push(share * kGravity, duration, 8.0), kGravity, 1.2);
    CAPTURE(duration, work, later.largest_tilt);
    CHECK(later.has_overturned == expected);
    overturned += expected ? 1 : 0;
  }
  CHECK(overturned > 5);
  CHECK(overturned < 35);
}

TEST_CASE("rocking: each impact keeps the square of Housner's ratio of the energy", "[validate]") {
  const RockingBlock block = rocking_block(0.26, 1.35, kGravity);
  const double limit = kGravity * 0.26 / 1.35;
  const double ratio = impact_ratio(block);
  const RockingState free = rocked_by(block, push(1.3 * limit, 0.4, 3.0), kGravity, 1.0);
  REQUIRE_FALSE(free.has_overturned);
  REQUIRE(free.impacts >= 3);
  const double first = std::cos(block.slenderness - free.largest_tilt) - std::cos(block.slenderness);
  CHECK(energy_of(block, free) == Approx(std::pow(ratio, 2 * free.impacts) * first).epsilon(1e-9));
}

TEST_CASE("rocking: the time of the impacts is that of the quarter periods", "[validate]") {
  const RockingBlock block = rocking_block(0.25, 1.0, kGravity);
  const double limit = kGravity * 0.25;
  const double pushed = 0.35;
  const RockingState at_end = rocked_by(block, push(1.3 * limit, pushed, 1e-12), kGravity, 1.0);
  const RockingState free = rocked_by(block, push(1.3 * limit, pushed, 3.0), kGravity, 1.0);
  // It passes the tilt at the end of the push again when it falls: from there to the peak and back is the rest of a
  // half period from the largest tilt.
  const double peak = free.largest_tilt;
  const auto impacts_after = [&](double time) {
    return rocked_by(block, push(1.3 * limit, pushed, time), kGravity, 1.0).impacts;
  };
  double low = 0.0;
  double high = 3.0;
  while (high - low > 1e-9) (impacts_after(0.5 * (low + high)) > 0 ? high : low) = 0.5 * (low + high);
  const double first_impact = low;
  low = first_impact;
  high = 3.0;
  while (high - low > 1e-9) (impacts_after(0.5 * (low + high)) > 1 ? high : low) = 0.5 * (low + high);
  CAPTURE(at_end.tilt, peak, first_impact, low);
  CHECK(low - first_impact == Approx(2.0 * quarter_period(block, peak_tilt(block, peak, 1))).epsilon(1e-6));
}

TEST_CASE("rocking: a block comes to rest after many small impacts and stands until it is lifted again", "[validate]") {
  const RockingBlock block = rocking_block(0.6, 1.2, kGravity);
  const double limit = kGravity * 0.5;
  const RockingState rested = rocked_by(block, push(1.2 * limit, 0.3, 20.0), kGravity, 1.0);
  CAPTURE(rested.impacts);
  CHECK(rested.tilt == 0.0);
  CHECK(rested.velocity == 0.0);
  CHECK(rested.impacts > 20);
  CHECK(rested.impacts < 200);
  // It ends alike under a push below the limit, and is lifted by a second one above it.
  Scene scene;
  scene.then(0.3, {1.2 * limit, 0, 0}).then(20.0, {0.5 * limit, 0, 0}).then(0.2, {1.5 * limit, 0, 0});
  const RockingState lifted = rocked_by(block, scene.acceleration, kGravity, 1.0);
  CHECK(lifted.velocity < 0.0);
  CHECK(lifted.tilt == Approx(rocked_by(block, push(1.5 * limit, 0.2, 1e-12), kGravity, 1.0).tilt).epsilon(1e-9));
}

TEST_CASE("rocking: dividing the intervals changes nothing beyond 1e-10", "[validate]") {
  const RockingBlock block = rocking_block(0.26, 1.35, kGravity);
  const double limit = kGravity * 0.26 / 1.35;
  const RockingState once = rocked_by(block, push(1.25 * limit, 0.5, 4.0), kGravity, 1.0);
  const RockingState often = rocked_by(block, push(1.25 * limit, 0.5, 4.0, 777), kGravity, 1.0);
  CAPTURE(once.tilt, often.tilt, once.impacts);
  CHECK(once.impacts == often.impacts);
  CHECK(once.largest_tilt == Approx(often.largest_tilt).margin(1e-10));
  CHECK(once.tilt == Approx(often.tilt).margin(1e-10));
}

}  // namespace rocking_test
