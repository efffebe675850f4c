#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace holdfast::internal::native {

/// Sets of small numbers, one per row, as bits.
class BitRows {
 public:
  static constexpr std::size_t kNone = ~std::size_t{0};

  /// Makes all rows empty.
  /// @param numbers that a row can hold: 0 to this, exclusive
  void assign(std::size_t rows, std::size_t numbers) {
    words_ = (numbers + kBits - 1) / kBits;
    bits_.assign(rows * words_, 0);
  }

  void set(std::size_t row, std::size_t number) { word(row, number / kBits) |= bit(number); }
  void clear(std::size_t row, std::size_t number) { word(row, number / kBits) &= ~bit(number); }

  /// The least number of a row, or `kNone`.
  std::size_t first_in(std::size_t row) const {
    for (std::size_t w = 0; w < words_; ++w)
      if (const std::uint64_t bits = bits_[row * words_ + w]; bits != 0) return w * kBits + lowest(bits);
    return kNone;
  }

  /// Calls `visit(number)` for all numbers of a row, in increasing order.
  template <class Visit>
  void for_each_in(std::size_t row, Visit visit) const {
    for (std::size_t w = 0; w < words_; ++w)
      for (std::uint64_t bits = bits_[row * words_ + w]; bits != 0; bits &= bits - 1) visit(w * kBits + lowest(bits));
  }

  /// Adds the numbers of another row to a row. Returns how many of them are new to it.
  std::uint32_t add_row(std::size_t row, std::size_t other) {
    std::uint32_t added = 0;
    for (std::size_t w = 0; w < words_; ++w) {
      // Few are new, and without its instruction a count is a call.
      std::uint64_t bits = word(other, w) & ~word(row, w);
      word(row, w) |= bits;
      for (; bits != 0; bits &= bits - 1) ++added;
    }
    return added;
  }

 private:
  static constexpr std::size_t kBits = 64;

  static std::uint64_t bit(std::size_t number) { return std::uint64_t{1} << (number % kBits); }
  static std::size_t lowest(std::uint64_t bits) { return static_cast<std::size_t>(std::countr_zero(bits)); }
  std::uint64_t& word(std::size_t row, std::size_t index) { return bits_[row * words_ + index]; }

  std::size_t words_ = 0;  ///< of a row
  std::vector<std::uint64_t> bits_;
};

}  // namespace holdfast::internal::native
