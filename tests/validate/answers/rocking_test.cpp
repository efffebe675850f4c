#include "validate/answers/rocking.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace holdfast::internal;

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
