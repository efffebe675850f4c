#include "validate/laboratory/threshold.hpp"

#include <catch2/catch.hpp>
#include <cmath>

namespace threshold_test {

using holdfast::internal::threshold_near;

TEST_CASE("threshold: found at any position", "[validate][threshold]") {
  for (const double border : {0.013, 0.5, 0.9, 0.999, 1.0, 1.0000003, 1.01, 1.7, 9.0}) {
    const double found = threshold_near(1.0, 1e-7, [&](double amplitude) { return amplitude > border; });
    CAPTURE(border, found);
    // With the requested precision, or a fiftieth of the error.
    CHECK(found >= border);
    CHECK(found - border <= std::max(1e-7, 0.021 * std::min(border, std::abs(border - 1.0))) * 1.0000001);
  }
}

TEST_CASE("threshold: a correct expectation takes few runs", "[validate][threshold]") {
  int runs = 0;
  threshold_near(1.0, 1e-7, [&](double amplitude) {
    ++runs;
    return amplitude >= 1.0;
  });
  CHECK(runs <= 3);
}

TEST_CASE("threshold: always and never exceeded", "[validate][threshold]") {
  CHECK(threshold_near(1.0, 1e-7, [](double) { return true; }) == 0.0);
  CHECK(std::isinf(threshold_near(1.0, 1e-7, [](double) { return false; })));
}

}  // namespace threshold_test
