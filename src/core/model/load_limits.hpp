#pragma once

#include <cmath>
#include <limits>

/// What a load may say in numbers, whatever it is written in.
namespace holdfast::internal {

/// Least mass of a box, kg.
inline constexpr double kLeastMass = 1e-6;

/// Largest mass, coefficient or length of a load: more is a mistake.
inline constexpr double kMostOfLoad = 1e6;

/// Shortest length of a container, and lowest drop side, m.
inline constexpr double kLeastLength = 1e-3;

/// Whether a number is that of a material.
inline bool is_material(double number) {
  return number >= 0.0 && number <= std::numeric_limits<int>::max() && number == std::floor(number);
}

}  // namespace holdfast::internal
