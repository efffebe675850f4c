#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace holdfast::internal::native {

/// Finds the manifold of a pair of bodies: a hash table with linear probing, whose memory grows with the pairs that
/// are near each other. It is looked up and never walked through, so that no result depends on its order.
class PairTable {
 public:
  static constexpr std::int32_t kNone = -1;

  /// Index of the manifold of the pair, or `kNone`. Both members are at least -2³¹ + 1.
  std::int32_t find(std::int32_t a, std::int32_t b) const;

  /// Sets the index, which is at least 0, of a pair that is there or new.
  void set(std::int32_t a, std::int32_t b, std::int32_t index);

  /// Removes a pair that is there.
  void erase(std::int32_t a, std::int32_t b);

  std::size_t size() const { return size_; }

 private:
  struct Entry {
    std::int32_t a = 0, b = 0;
    std::int32_t index = kNone;
  };

  std::size_t home(std::int32_t a, std::int32_t b) const;
  std::size_t locate(std::int32_t a, std::int32_t b) const;
  void grow();

  std::vector<Entry> entries_;  ///< a power of two of them, or none
  std::size_t size_ = 0;
};

}  // namespace holdfast::internal::native
