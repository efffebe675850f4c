#pragma once

#include <cstdint>
#include <random>

#include "core/base/vector.hpp"

namespace holdfast::internal {

/// Random numbers for tests, the same on every machine: the distributions of the standard library are not.
class Random {
 public:
  explicit Random(std::uint32_t seed) : generator_(seed) {}

  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(generator_()) / 4294967296.0;
  }
  Vec3 vector(double low, double high) {
    // One after the other: the order in which arguments are evaluated is open.
    const double x = between(low, high);
    const double y = between(low, high);
    return {x, y, between(low, high)};
  }
  Rotation rotation() {
    const Vec3 imaginary = vector(-1, 1);
    return Rotation(between(-1, 1), imaginary.x(), imaginary.y(), imaginary.z()).normalized();
  }
  std::uint32_t below(std::uint32_t count) { return static_cast<std::uint32_t>(generator_()) % count; }

 private:
  std::mt19937 generator_;
};

}  // namespace holdfast::internal
