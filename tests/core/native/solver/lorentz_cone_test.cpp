// The algebra of the cones, as the least instruction set of the machine computes it.
#include "core/native/solver/simd_targets.hpp"
//
#include "core/native/solver/lorentz_cone-inl.hpp"
//
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "core/native/collision/oriented_box.hpp"
#include "random.hpp"
#include "same_bits.hpp"

using namespace holdfast::internal;
using namespace holdfast::internal::native;

namespace {

namespace kernel = holdfast::internal::native::HWY_NAMESPACE;

double first(const kernel::Four& four) {
  alignas(64) double lane[kLanes];
  four.store(lane);
  return lane[0];
}

/// The kernels' functions, of one vector in all lanes.
namespace lorentz {

kernel::Triple all(const Vec3& x) {
  return {{kernel::Four::all(x[0]), kernel::Four::all(x[1]), kernel::Four::all(x[2])}};
}
Vec3 first(const kernel::Triple& x) { return {::first(x.at[0]), ::first(x.at[1]), ::first(x.at[2])}; }

double tangential_length(const Vec3& x) { return ::first(kernel::lorentz::tangential_length(all(x))); }
double determinant(const Vec3& x) { return ::first(kernel::lorentz::determinant(all(x))); }
Vec3 product(const Vec3& a, const Vec3& b) { return first(kernel::lorentz::product(all(a), all(b))); }
Vec3 quotient(const Vec3& b, const Vec3& a) { return first(kernel::lorentz::quotient(all(b), all(a))); }
double longest_step(const Vec3& x, const Vec3& d) { return ::first(kernel::lorentz::longest_step(all(x), all(d))); }

struct Scaling {
  kernel::lorentz::Scaling fours;
  double square;
  Vec3 w;

  Scaling(const Vec3& y, const Vec3& s)
      : fours(kernel::lorentz::Scaling::of(all(y), all(s))), square(::first(fours.square)), w(first(fours.w)) {}
  Vec3 scaled(const Vec3& x) const { return first(fours.scaled(all(x))); }
  Vec3 unscaled(const Vec3& x) const { return first(fours.unscaled(all(x))); }
  Mat3 inverse_square() const {
    kernel::Four entries[3][3];
    fours.inverse_square(entries);
    Mat3 matrix;
    for (Eigen::Index i = 0; i < 3; ++i)
      for (Eigen::Index j = 0; j < 3; ++j) matrix(i, j) = ::first(entries[i][j]);
    return matrix;
  }
};

}  // namespace lorentz

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kSamples = 1000;

/// Inside the cone, of a random size, nearer to the boundary than `share` of that.
Vec3 inside(Random& random, double share) {
  const double size = std::pow(10.0, random.between(-3, 3));
  const double direction = random.between(0, 6.3);
  const double tangential = size * random.between(1.0 - share, 1.0);
  const double gap = size * share * random.between(0.1, 1.0);
  return {tangential + gap, tangential * std::cos(direction), tangential * std::sin(direction)};
}

/// How far inside the cone x is; negative outside.
double depth(const Vec3& x) { return x[0] - lorentz::tangential_length(x); }

/// Not a number where one of them is none.
double larger(double a, double b) { return a >= b || std::isnan(a) ? a : b; }

}  // namespace

TEST_CASE("lorentz_cone: the quotient is what the product undoes", "[core][lorentz_cone]") {
  Random random(1);
  for (const double share : {1.0, 1e-2, 1e-4}) {
    double worst = 0.0;
    for (int i = 0; i < kSamples; ++i) {
      const Vec3 a = inside(random, share);
      const Vec3 b = random.vector(-1, 1);
      const Vec3 x = lorentz::quotient(b, a);
      worst = larger(worst, (lorentz::product(a, x) - b).norm() / (a.norm() * x.norm()));
      const Vec3 back = lorentz::quotient(lorentz::product(a, b), a);
      worst = larger(worst, share * (back - b).norm());
    }
    CAPTURE(share, worst);
    CHECK(worst < 1e-14);
  }
}

TEST_CASE("lorentz_cone: the product commutes, and (1, 0, 0) is its unit", "[core][lorentz_cone]") {
  Random random(2);
  for (int i = 0; i < kSamples; ++i) {
    const Vec3 a = random.vector(-1, 1);
    const Vec3 b = random.vector(-1, 1);
    REQUIRE(lorentz::product(a, Vec3::UnitX()) == a);
    REQUIRE((lorentz::product(a, b) - lorentz::product(b, a)).norm() < 1e-15);
  }
}

TEST_CASE("lorentz_cone: the determinant keeps its digits near the boundary", "[core][lorentz_cone]") {
  // Lengths 5 and 13 are exact, and so are the gaps: (gap) (2 length + gap) is the determinant.
  for (const double gap : {std::ldexp(1.0, -20), std::ldexp(1.0, -35), std::ldexp(1.0, -49)}) {
    CAPTURE(gap);
    CHECK(lorentz::determinant({5.0 + gap, 3, -4}) == Approx(gap * (10.0 + gap)).epsilon(1e-15));
    CHECK(lorentz::determinant({13.0 - gap, -5, 12}) == Approx(-gap * (26.0 - gap)).epsilon(1e-15));
    CHECK(lorentz::determinant({1.0 + gap, 0, 1}) == Approx(gap * (2.0 + gap)).epsilon(1e-15));
  }
  CHECK(lorentz::determinant({5, 3, 4}) == 0.0);
}

TEST_CASE("lorentz_cone: the longest step ends on the boundary", "[core][lorentz_cone]") {
  Random random(3);
  for (const double share : {1.0, 1e-3, 1e-6}) {
    double worst = 0.0;
    int ended = 0;
    for (int i = 0; i < kSamples; ++i) {
      const Vec3 x = inside(random, share);
      const Vec3 d = x.norm() * random.vector(-1, 1);
      const double step = lorentz::longest_step(x, d);
      REQUIRE(step > 0.0);
      if (step == kInfinity) {
        REQUIRE(depth(d) > -1e-12 * d.norm());
        continue;
      }
      ++ended;
      const Vec3 end = x + step * d;
      worst = larger(worst, std::abs(depth(end)) / (x.norm() + step * d.norm()));
      REQUIRE(depth(x + 0.99 * step * d) > 0.0);
      REQUIRE(depth(x + 1.01 * step * d) < 0.0);
    }
    CAPTURE(share, worst, ended);
    CHECK(ended > kSamples / 2);
    CHECK(worst < 1e-14);
  }
}

TEST_CASE("lorentz_cone: the longest step to the tip is the whole way", "[core][lorentz_cone]") {
  Random random(4);
  double worst = 0.0;
  for (int i = 0; i < kSamples; ++i) {
    const Vec3 x = inside(random, 1.0);
    worst = larger(worst, std::abs(lorentz::longest_step(x, -0.25 * x) - 4.0));
  }
  CAPTURE(worst);
  // The boundary is met twice there, and a double root has half of the digits.
  CHECK(worst < 1e-6);
}

TEST_CASE("lorentz_cone: the longest step is no number where the direction is none", "[core][lorentz_cone]") {
  for (const Eigen::Index i : {0, 1, 2}) {
    Vec3 d(1, 2, 3);
    d[i] = std::numeric_limits<double>::quiet_NaN();
    CHECK(std::isnan(lorentz::longest_step(Vec3(2, 1, 1), d)));
  }
}

TEST_CASE("lorentz_cone: a step along the cone has no end", "[core][lorentz_cone]") {
  Random random(5);
  for (int i = 0; i < kSamples; ++i) {
    const Vec3 x = inside(random, 1e-3);
    REQUIRE(lorentz::longest_step(x, inside(random, 1e-3)) == kInfinity);
    // Along the boundary, and nowhere.
    REQUIRE(lorentz::longest_step(x, Vec3(5, -3, 4)) == kInfinity);
    REQUIRE(lorentz::longest_step(x, Vec3(2, 0, 2)) == kInfinity);
    REQUIRE(lorentz::longest_step(x, Vec3::Zero()) == kInfinity);
  }
}

TEST_CASE("lorentz_cone: the scaling takes y to s in two halves", "[core][lorentz_cone]") {
  Random random(6);
  for (const double share : {1.0, 1e-2, 1e-4}) {
    double halves = 0.0;
    double squared = 0.0;
    double inverse = 0.0;
    double unit = 0.0;
    for (int i = 0; i < kSamples; ++i) {
      const Vec3 y = inside(random, share);
      const Vec3 s = inside(random, share);
      const lorentz::Scaling scaling(y, s);
      halves = larger(halves, (scaling.square * scaling.scaled(scaling.scaled(y)) - s).norm() / s.norm());
      squared = larger(squared, (scaling.inverse_square() * s - y).norm() / y.norm());
      // Both variables are the same in the scaled space: W y = W⁻¹ s.
      unit =
          larger(unit, (scaling.square * scaling.scaled(y) - scaling.unscaled(s)).norm() / scaling.unscaled(s).norm());
      const Vec3 x = random.vector(-1, 1);
      inverse = larger(inverse, (scaling.unscaled(scaling.scaled(x)) - x).norm());
      inverse = larger(inverse, (scaling.scaled(scaling.unscaled(x)) - x).norm());
    }
    CAPTURE(share, halves, squared, unit, inverse);
    // W̄ stretches by up to 1 / share.
    CHECK(halves < 1e-14 / share);
    CHECK(squared < 1e-14 / share);
    CHECK(unit < 1e-14 / share);
    CHECK(inverse < 1e-14 / share);
  }
}

TEST_CASE("lorentz_cone: the scaling of equals is the identity", "[core][lorentz_cone]") {
  Random random(7);
  for (int i = 0; i < kSamples; ++i) {
    const Vec3 y = inside(random, 1.0);
    const lorentz::Scaling scaling(y, y);
    REQUIRE(scaling.square == 1.0);
    REQUIRE((scaling.w - Vec3::UnitX()).norm() < 1e-13);
  }
}

TEST_CASE("lorentz_cone: powers of 2 pass the scaling without a changed bit", "[core][lorentz_cone]") {
  Random random(8);
  for (int i = 0; i < kSamples; ++i) {
    const Vec3 y = inside(random, 1e-3);
    const Vec3 s = inside(random, 1e-3);
    const Vec3 x = random.vector(-1, 1);
    const double of_y = std::ldexp(1.0, static_cast<int>(random.below(21)) - 10);
    const double of_s = std::ldexp(1.0, static_cast<int>(random.below(21)) - 10);
    const lorentz::Scaling scaling(y, s);
    const lorentz::Scaling other(of_y * y, of_s * s);
    REQUIRE(other.square == of_s / of_y * scaling.square);
    REQUIRE(same_bits(std::vector{other.w}, std::vector{scaling.w}));
    REQUIRE(same_bits(std::vector{other.scaled(of_y * x)}, std::vector<Vec3>{of_y * scaling.scaled(x)}));
    REQUIRE(same_bits(std::vector{other.unscaled(of_s * x)}, std::vector<Vec3>{of_s * scaling.unscaled(x)}));
    REQUIRE(same_bits(std::vector{other.inverse_square()}, std::vector<Mat3>{of_y / of_s * scaling.inverse_square()}));
    REQUIRE(lorentz::longest_step(of_y * y, of_s * x) == of_y / of_s * lorentz::longest_step(y, x));
  }
}
