#include "validate/laboratory/measurement.hpp"

#include <limits>
#include <utility>

namespace holdfast::internal {

namespace {

double finite_or_lost(double error) { return std::isfinite(error) ? error : std::numeric_limits<double>::infinity(); }

}  // namespace

double tolerance_of(ToleranceClass tolerance) {
  switch (tolerance) {
    case ToleranceClass::exact:
      return 1e-12;
    case ToleranceClass::fine:
      return 1e-6;
    case ToleranceClass::good:
      return 1e-4;
    case ToleranceClass::coarse:
      return 1e-2;
    case ToleranceClass::verdict:
      return 0.5;
  }
  return 0.0;
}

std::string to_string(ToleranceClass tolerance) {
  switch (tolerance) {
    case ToleranceClass::exact:
      return "exact";
    case ToleranceClass::fine:
      return "fine";
    case ToleranceClass::good:
      return "good";
    case ToleranceClass::coarse:
      return "coarse";
    case ToleranceClass::verdict:
      return "verdict";
  }
  return "";
}

Measurement relative(std::string metric, double value, double expected, ToleranceClass tolerance) {
  return {std::move(metric), value, expected, finite_or_lost(std::abs(value / expected - 1.0)), tolerance};
}

Measurement scaled(std::string metric, double value, double expected, double scale, ToleranceClass tolerance) {
  return {std::move(metric), value, expected, finite_or_lost(std::abs(value - expected) / scale), tolerance};
}

Measurement verdict(std::string metric, bool value, bool expected) {
  return {std::move(metric), value ? 1.0 : 0.0, expected ? 1.0 : 0.0, value == expected ? 0.0 : 1.0,
          ToleranceClass::verdict};
}

}  // namespace holdfast::internal
