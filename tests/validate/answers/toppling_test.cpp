#include "validate/answers/toppling.hpp"

#include <catch2/catch.hpp>
#include <cmath>

namespace toppling_test {

using namespace holdfast::internal;

namespace {

constexpr double kGravity = 9.81;

}  // namespace

TEST_CASE("toppling: the rate agrees with the energy at every angle", "[validate][toppling]") {
  const Pivoted body = about_edge(0.5, 1.0);
  const double acceleration = 0.6 * kGravity;
  Toppling toppling(body, acceleration, kGravity);
  for (const double time : {0.1, 0.2, 0.35, 0.5, 0.7}) {
    toppling.advance_to(time);
    // ½ k² θ'² = work of inertial force and weight, per unit of mass.
    const double lean = body.lean - toppling.angle();
    const double work = body.arm * (acceleration * (std::sin(body.lean) - std::sin(lean)) -
                                    kGravity * (std::cos(lean) - std::cos(body.lean)));
    CAPTURE(time, toppling.angle());
    CHECK(0.5 * body.gyration_squared * toppling.rate() * toppling.rate() == Approx(work).epsilon(1e-11));
  }
}

TEST_CASE("toppling: small angles grow like a hyperbolic cosine", "[validate][toppling]") {
  const Pivoted body = about_edge(0.3, 1.0);
  const double threshold = kGravity * 0.3;
  const double acceleration = threshold * (1 + 1e-8);
  Toppling toppling(body, acceleration, kGravity);
  const double time = 1.0;
  toppling.advance_to(time);
  // θ'' = (R/k²) [(a − g tan α) cos α + (g cos α + a sin α) θ], linear in θ.
  const double scale = body.arm / body.gyration_squared;
  const double growth = std::sqrt(scale * (kGravity * std::cos(body.lean) + acceleration * std::sin(body.lean)));
  const double push = scale * (acceleration - threshold) * std::cos(body.lean);
  CHECK(toppling.angle() == Approx(push / (growth * growth) * (std::cosh(growth * time) - 1)).epsilon(1e-6));
}

TEST_CASE("toppling: the angle at the returned time is the requested one", "[validate][toppling]") {
  const Pivoted body = about_edge(0.5, 1.0);
  Toppling first(body, 5.4, kGravity);
  const double time = first.time_to(0.5);
  CHECK(first.angle() == Approx(0.5).epsilon(1e-14));
  Toppling second(body, 5.4, kGravity);
  second.advance_to(time);
  CHECK(second.angle() == Approx(0.5).epsilon(1e-12));
}

TEST_CASE("toppling: below the threshold nothing moves", "[validate][toppling]") {
  Toppling toppling(about_edge(0.5, 1.0), 0.499 * kGravity, kGravity);
  toppling.advance_to(1.0);
  CHECK(toppling.angle() == 0.0);
  CHECK(std::isinf(toppling.time_to(0.1)));
}

TEST_CASE("toppling: at the start the pivot carries the weight and the inertial force", "[validate][toppling]") {
  // From rest at the threshold nothing accelerates: N = m g, T = m a.
  const Toppling toppling(about_edge(0.5, 1.0), 0.5 * kGravity, kGravity);
  CHECK(toppling.support() == Approx(kGravity).epsilon(1e-12));
  CHECK(toppling.friction_needed() == Approx(0.5).epsilon(1e-12));
}

TEST_CASE("toppling: the pivot holds below 45 degrees and lifts off before 60", "[validate][toppling]") {
  for (const double over : {1.02, 1.1}) {
    Toppling toppling(about_edge(0.5, 1.0), over * 0.5 * kGravity, kGravity);
    for (double time = 0.0; toppling.angle() < 0.7854; toppling.advance_to(time += 0.01)) {
      CHECK(toppling.support() > 0.0);
      CHECK(toppling.friction_needed() < 0.8);
    }
    toppling.time_to(1.0472);
    CHECK(toppling.support() < 0.0);
  }
}

TEST_CASE("toppling: the threshold for a limited time is above that for unlimited time", "[validate][toppling]") {
  const Pivoted body = about_edge(1.0, 4.0);
  const double threshold = toppling_threshold(body, kGravity, 0.1745, 5.0);
  CHECK(threshold > 0.25 * kGravity);
  CHECK(threshold < 0.2502 * kGravity);
  CHECK(Toppling(body, threshold, kGravity).time_to(0.1745) == Approx(5.0).epsilon(1e-6));
  // Short boxes fall so fast that five seconds are as long as unlimited time.
  CHECK(toppling_threshold(about_edge(0.2, 1.0), kGravity, 0.1745, 5.0) == Approx(0.2 * kGravity).epsilon(1e-7));
}

TEST_CASE("toppling: after the shortest pulse the body just reaches the upright balance", "[validate][toppling]") {
  const Pivoted body = about_edge(0.5, 1.0);
  const double acceleration = 0.75 * kGravity;
  Toppling pushed(body, acceleration, kGravity);
  pushed.advance_to(overturning_pulse(body, acceleration, kGravity));
  const double kinetic = 0.5 * body.gyration_squared * pushed.rate() * pushed.rate();
  const double to_the_top = body.arm * kGravity * (1.0 - std::cos(body.lean - pushed.angle()));
  CHECK(kinetic == Approx(to_the_top).epsilon(1e-10));
}

}  // namespace toppling_test
