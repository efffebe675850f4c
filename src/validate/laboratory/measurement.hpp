#pragma once

#include <cmath>
#include <string>

namespace holdfast::internal {

/// How close to the known answer a case asks an engine to come; the same for all engines and settings.
enum class ToleranceClass {
  exact,    ///< 1e-12: what has no reason to be off at all, rest above all
  fine,     ///< 1e-6: closed formulas
  good,     ///< 1e-4: trajectories integrated in time
  coarse,   ///< 1e-2: order of magnitude, laws of scale
  verdict,  ///< right or wrong
};

/// The bound on the error that a class stands for; 0.5 for verdicts, whose error is 0 or 1.
double tolerance_of(ToleranceClass tolerance);
std::string to_string(ToleranceClass tolerance);

/// One number measured against a known one.
struct Measurement {
  std::string metric;  ///< what, with its unit: "displacement (m)"
  double value = 0.0;
  double expected = 0.0;
  double error = 0.0;  ///< not negative; relative unless the metric's maker says otherwise; infinite when lost
  ToleranceClass tolerance = ToleranceClass::fine;

  bool passes() const { return error <= tolerance_of(tolerance); }  // false for not-a-number
};

/// Error relative to the expected value, which is not zero: |value / expected − 1|.
Measurement relative(std::string metric, double value, double expected, ToleranceClass tolerance);

/// Error as a share of a scale of the same unit: |value − expected| / scale. For answers that may be zero.
Measurement scaled(std::string metric, double value, double expected, double scale, ToleranceClass tolerance);

/// A yes or no that must be as expected: error 0 or 1.
Measurement verdict(std::string metric, bool value, bool expected);

}  // namespace holdfast::internal
