#pragma once

#include "core/native/solver/contact_constraint.hpp"

namespace holdfast::internal::native {

/// Rows that a body's six are padded to, so that a column of a block is a whole SIMD vector.
inline constexpr int kPaddedRows = 8;
inline constexpr int kBodyRows = 6;

/// Velocity, impulse or residual of a body: three linear rows, three angular ones, two zeros.
struct alignas(64) BodyVector {
  double row[kPaddedRows] = {};
};

/// A 6×6 matrix, column by column, each padded by zeros.
struct alignas(64) BodyBlock {
  double column[kBodyRows][kPaddedRows] = {};
};

/// Wrench on a body, summed apart for each lane of the constraints; lanes are added in a fixed order.
struct alignas(64) LaneWrench {
  double row[kBodyRows][kLanes] = {};
};

}  // namespace holdfast::internal::native
