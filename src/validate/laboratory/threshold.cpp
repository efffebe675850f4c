#include "validate/laboratory/threshold.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace holdfast::internal {

double threshold_near(double expected, double precision, const std::function<bool(double)>& exceeds) {
  const bool border_is_below = exceeds(expected);
  double near = expected;  // always on the same side of the threshold as the expected value
  double far = expected;
  for (double share = precision;; share *= 10.0) {
    far = border_is_below ? expected * std::max(0.0, 1.0 - share) : expected * (1.0 + share);
    if (exceeds(far) != border_is_below) break;
    if (border_is_below && !(far > 0.0)) return 0.0;
    if (!border_is_below && !(far < 10.0 * expected)) return std::numeric_limits<double>::infinity();
    near = far;
  }
  double low = std::min(near, far);
  double high = std::max(near, far);
  const auto good_enough = [&] {
    const double off = std::min(std::abs(low - expected), std::abs(high - expected));
    return high - low <= std::max(precision * expected, 0.02 * std::min(off, high));
  };
  while (!good_enough()) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) break;
    (exceeds(middle) ? high : low) = middle;
  }
  return high;
}

}  // namespace holdfast::internal
