#pragma once

#include "core/native/solver/contact_constraint.hpp"

namespace holdfast::internal::native {

/// Components of a body's velocity: three linear ones, then three angular ones.
inline constexpr int kBodyRows = 6;
/// Rows in memory, where a zero follows each three: both fill the same SIMD vectors as the lanes of a constraint.
inline constexpr int kPaddedRows = 8;
/// The row of the first angular component.
inline constexpr int kAngularRow = 4;

/// The row of a component.
template <class Index>
constexpr Index padded_row(Index component) {
  return component < 3 ? component : component - 3 + kAngularRow;
}

/// Velocity, impulse or residual of a body: three linear rows, a zero, three angular rows, a zero.
struct alignas(64) BodyVector {
  double row[kPaddedRows] = {};
};

/// A 6×6 matrix, column by column, each padded like a `BodyVector`.
struct alignas(64) BodyBlock {
  double column[kBodyRows][kPaddedRows] = {};
};

/// Wrench on a body, summed apart for each lane of the constraints; lanes are added in a fixed order.
struct alignas(64) LaneWrench {
  double row[kBodyRows][kLanes] = {};
};

}  // namespace holdfast::internal::native
