#pragma once

#include <functional>

namespace holdfast::internal {

/// The smallest amplitude at which `exceeds` is true, searched outwards from the expected value. For an exact engine a
/// few runs find it to the relative precision `precision`; for one with a large error, that error is found to 2 %.
/// Assumes one threshold; 0 if `exceeds` is true even at amplitude zero, infinity if it is false at ten times the
/// expected value.
double threshold_near(double expected, double precision, const std::function<bool(double)>& exceeds);

}  // namespace holdfast::internal
