#pragma once

#include <cmath>
#include <string>

namespace holdfast::internal {

/// Class of the tolerance of a measurement; the same for all engines and settings.
enum class ToleranceClass {
  exact,    ///< 1e-12: results without any reason for an error, such as rest
  fine,     ///< 1e-6: closed formulas
  good,     ///< 1e-4: trajectories integrated in time
  coarse,   ///< 1e-2: orders of magnitude, scaling laws
  verdict,  ///< right or wrong
};

/// The tolerance of a class; 0.5 for verdicts, whose error is 0 or 1.
double tolerance_of(ToleranceClass tolerance);
std::string to_string(ToleranceClass tolerance);

/// One measured number and its known value.
struct Measurement {
  std::string metric;  ///< name with unit: "displacement (m)"
  double value = 0.0;
  double expected = 0.0;
  double error = 0.0;  ///< not negative; relative unless it was created with a scale; infinite if the value is lost
  ToleranceClass tolerance = ToleranceClass::fine;

  bool passes() const { return error <= tolerance_of(tolerance); }  // false for NaN
};

/// Error relative to the expected value, which is not zero: |value / expected − 1|.
Measurement relative(std::string metric, double value, double expected, ToleranceClass tolerance);

/// Error relative to a scale of the same unit: |value − expected| / scale. For values that may be zero.
Measurement scaled(std::string metric, double value, double expected, double scale, ToleranceClass tolerance);

/// A yes or no that must be as expected: error 0 or 1.
Measurement verdict(std::string metric, bool value, bool expected);

}  // namespace holdfast::internal
