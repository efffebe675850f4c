#pragma once

#include <cstdint>

namespace holdfast::internal {

/// A step of the generator splitmix64 (Steele, Lea and Flood 2014): a well mixed number from any other, with the same
/// bits on every machine.
inline std::uint64_t mixed_bits(std::uint64_t number) {
  number += 0x9e3779b97f4a7c15ULL;
  number = (number ^ (number >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  number = (number ^ (number >> 27U)) * 0x94d049bb133111ebULL;
  return number ^ (number >> 31U);
}

/// The upper bits of a mixed number as a number from 0 to below 1, exactly.
inline double unit_number(std::uint64_t bits) { return static_cast<double>(bits >> 11U) * 0x1p-53; }

}  // namespace holdfast::internal
