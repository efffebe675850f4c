#include "core/native/solver/anderson.hpp"

#include <catch2/catch.hpp>

namespace anderson_test {

using namespace holdfast::internal::native;

namespace {

constexpr double kLargestImpulse = 1e3;

/// One constraint of one number: the others stay 0.
struct OneNumber {
  std::vector<ContactConstraint> constraints = std::vector<ContactConstraint>(1);
  std::vector<ConstraintVector> g = std::vector<ConstraintVector>(1);
  std::vector<ConstraintVector> r = std::vector<ConstraintVector>(1);

  OneNumber() {
    for (auto& lanes : constraints[0].inverse_penalty)
      for (double& weight : lanes) weight = 1.0;
  }

  /// What the acceleration makes of an iterate and its residual.
  double next(Anderson& anderson, double iterate, double residual) {
    g[0] = {};
    r[0] = {};
    g[0].row[0][0] = iterate;
    r[0].row[0][0] = residual;
    anderson.accelerate(constraints, kLargestImpulse, g, r);
    return g[0].row[0][0];
  }
};

}  // namespace

TEST_CASE("anderson: of a linear iteration in one direction the second step is the last", "[core][anderson]") {
  // x <- 0.9 x + 1 ends at 10.
  OneNumber one;
  Anderson anderson;
  anderson.restart();
  CHECK(one.next(anderson, 1.0, 1.0) == 1.0);
  CHECK(one.next(anderson, 1.9, 0.9) == Approx(10.0));
}

TEST_CASE("anderson: what residuals hardly see does not grow without bound", "[core][anderson]") {
  // The iterate drifts on by nearly 1 each time, and would come to rest far away.
  for (const double far : {1e6, 1e12}) {
    OneNumber one;
    Anderson anderson;
    anderson.restart();
    CHECK(one.next(anderson, 1.0, 1.0) == 1.0);
    for (int i = 1; i < 20; ++i) CHECK(one.next(anderson, 1.0 + i, 1.0 - i / far) == 1.0 + i);
  }
}

TEST_CASE("anderson: pauses grow with every residual that jumps, and never end by themselves", "[core][anderson]") {
  OneNumber one;
  Anderson anderson;
  anderson.restart();
  const int jumps = GENERATE(1, 2, 29, 30, 31, 32, 40, 60);
  double residual = 1e-80;
  one.next(anderson, 0.0, residual);
  for (int i = 0; i < jumps; ++i) CHECK(one.next(anderson, 0.0, residual *= 10.0) == 0.0);
  // From here on as above: it would go to the end at once, were there no pause.
  const int pause = jumps < 10 ? kAndersonPause << (jumps - 1) : 1000;
  double x = 0.0;
  int paused = 0;
  while (paused < pause) {
    const double g = 0.9 * x + residual;
    const double accelerated = one.next(anderson, g, g - x);
    if (accelerated != g) break;
    x = g;
    ++paused;
  }
  CAPTURE(jumps, pause);
  // The iteration that jumps is the first of its pause.
  CHECK(paused == (jumps < 10 ? pause - 1 : pause));
}

}  // namespace anderson_test
