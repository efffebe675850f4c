#include "validate/laboratory/measurement.hpp"

#include <catch2/catch.hpp>
#include <limits>

namespace measurement_test {

using namespace holdfast::internal;

TEST_CASE("measurement: errors are relative, relative to a scale, or of a verdict", "[validate][measurement]") {
  CHECK(relative("m", 1.02, 1.0, ToleranceClass::coarse).error == Approx(0.02));
  CHECK(relative("m", -0.98, -1.0, ToleranceClass::coarse).error == Approx(0.02));
  CHECK(scaled("m", 0.03, 0.01, 2.0, ToleranceClass::coarse).error == Approx(0.01));
  CHECK(verdict("m", true, true).passes());
  CHECK_FALSE(verdict("m", true, false).passes());
}

TEST_CASE("measurement: a lost value never passes", "[validate][measurement]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double lost : {nan, infinity, -infinity}) {
    CHECK_FALSE(relative("m", lost, 1.0, ToleranceClass::coarse).passes());
    CHECK_FALSE(scaled("m", lost, 0.0, 1.0, ToleranceClass::coarse).passes());
  }
}

TEST_CASE("measurement: classes are ordered from exact to coarse", "[validate][measurement]") {
  CHECK(tolerance_of(ToleranceClass::exact) < tolerance_of(ToleranceClass::fine));
  CHECK(tolerance_of(ToleranceClass::fine) < tolerance_of(ToleranceClass::good));
  CHECK(tolerance_of(ToleranceClass::good) < tolerance_of(ToleranceClass::coarse));
}

}  // namespace measurement_test
