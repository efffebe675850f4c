#pragma once

#include <cstring>
#include <vector>

#include "core/model/world.hpp"

namespace holdfast::internal {

/// Whether two columns are the same to the bit: 0 and -0 differ, a NaN is itself.
template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

/// The same of all columns of two states.
inline bool same_bits(const StateColumns& a, const StateColumns& b) {
  bool same = true;
  for_each_state_column([&](const char*, const auto& x, const auto& y) { same = same && same_bits(x, y); }, a, b);
  return same;
}

}  // namespace holdfast::internal
