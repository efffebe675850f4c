#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace holdfast {

/// Makes a zlib stream (RFC 1950) of bytes that are told as runs of equal ones. A run costs the same time whether it is
/// ten bytes long or ten thousand, which makes it fast where nearly all is fill; anything else it packs badly.
class RunDeflate {
 public:
  RunDeflate();

  /// Adds `count` times the same byte.
  void add(std::byte value, std::uint64_t count);
  /// Adds bytes as they come.
  void add(std::span<const std::byte> bytes);

  /// The whole stream; nothing may be added afterwards.
  std::vector<std::byte> finish();

 private:
  void put(std::uint32_t bits, std::uint32_t count);
  void put_code(std::uint32_t code, std::uint32_t count);
  void put_literal(std::uint32_t value);
  void put_repeats(std::uint32_t length);

  std::vector<std::byte> stream_;
  std::uint64_t waiting_ = 0;  ///< bits that do not make a byte yet, the first one lowest
  std::uint32_t waiting_count_ = 0;
  std::uint64_t sum_ = 1;  ///< of all bytes: the two halves of Adler-32
  std::uint64_t sum_of_sums_ = 0;
};

}  // namespace holdfast
