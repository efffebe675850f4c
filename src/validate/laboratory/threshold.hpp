#pragma once

#include <functional>

namespace holdfast::internal {

/// The smallest amplitude at which `exceeds` is true, searched outwards from where it should be: an engine that is
/// right takes a handful of runs to find it to a share of `precision`, one that is far off gets its error to 2 %.
/// Assumes one border; 0 when `exceeds` is true even without load, infinity when it is false at ten times what is
/// expected.
double border_near(double expected, double precision, const std::function<bool(double)>& exceeds);

}  // namespace holdfast::internal
