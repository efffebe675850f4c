#include "validate/answers/stack.hpp"

#include <catch2/catch.hpp>
#include <cmath>

namespace stack_test {

using namespace holdfast::internal;

namespace {

constexpr double kGravity = 9.81;

}  // namespace

TEST_CASE("stack: an even stack tips at g l / H", "[validate][stack]") {
  const Stack stack = even_stack(20, {0.5, 0.75, 0.25}, 0.5);
  CHECK(tipping_load(stack, kGravity) == Approx(kGravity * 0.5 / 5.0).epsilon(1e-14));
  CHECK(sliding_load(stack, kGravity) == Approx(0.5 * kGravity));
}

TEST_CASE("stack: a heavy top tips the stack at g (l/2) Σm / Σ(m z)", "[validate][stack]") {
  const Stack stack = {{1.0, 1.0, 0.5}, {1.0, 1.0, 1000.0}, 0.5};
  CHECK(tipping_load(stack, kGravity) == Approx(kGravity * 0.5 * 1002.0 / (0.25 + 0.75 + 1250.0)).epsilon(1e-14));
}

TEST_CASE("stack: with a heavy lowest box a higher joint is the weakest", "[validate][stack]") {
  const Stack stack = {{1.0, 1.0, 0.5}, {1000.0, 1.0, 1.0}, 0.5};
  CHECK(tipping_load(stack, kGravity) == Approx(kGravity * 0.5 * 2.0 / (0.25 + 0.75)).epsilon(1e-14));
}

TEST_CASE("stack: boxes touch exactly and stand on the floor", "[validate][stack]") {
  const Scene scene = scene_of(even_stack(20, {0.5, 0.5, 0.25}, 0.5));
  REQUIRE(scene.boxes.size() == 20);
  for (std::size_t i = 0; i < scene.boxes.size(); ++i)
    CHECK(scene.boxes[i].position.z() - 0.125 == 0.25 * static_cast<double>(i));
}

TEST_CASE("stack: just above its limit a block tips as cosh", "[validate][stack]") {
  // To first order in θ and in a − g tanα: θ'' = c (a cosα − g sinα) + p² θ with p² = c (a sinα + g cosα), c = 3/(4R),
  // so θ = c (a cosα − g sinα) (cosh(p t) − 1) / p².
  const Vec3 size = {0.5, 0.5, 1.0};
  const Stack stack = even_stack(1, size, 0.9);
  const double half_diagonal = 0.5 * std::hypot(size.x(), size.z());
  const double alpha = std::atan(size.x() / size.z());
  constexpr double kDuration = 1.0;
  constexpr double kDistance = 1e-6;
  const double load = load_that_tips(stack, kGravity, kDistance, kDuration);
  const double c = 3.0 / (4.0 * half_diagonal);
  const double p = std::sqrt(c * (load * std::sin(alpha) + kGravity * std::cos(alpha)));
  const double theta =
      c * (load * std::cos(alpha) - kGravity * std::sin(alpha)) * (std::cosh(p * kDuration) - 1.0) / (p * p);
  CHECK(theta * half_diagonal == Approx(kDistance).epsilon(1e-5));
}

TEST_CASE("stack: the acceleration that tips decreases to the limit as the time grows", "[validate][stack]") {
  const Stack stack = even_stack(20, {0.5, 0.5, 0.25}, 0.5);
  const double limit = tipping_load(stack, kGravity);
  const double soon = load_that_tips(stack, kGravity, 0.01, 1.0) / limit - 1.0;
  const double late = load_that_tips(stack, kGravity, 0.01, 4.0) / limit - 1.0;
  CHECK(soon > late);
  CHECK(late > 0.0);
  CHECK(late < 1e-4);
}

}  // namespace stack_test
