#include "io/run_deflate.hpp"

#include <algorithm>
#include <bit>

namespace holdfast {

namespace {

constexpr std::uint32_t kEndOfBlock = 256;
constexpr std::uint32_t kShortestRepeat = 3;
constexpr std::uint32_t kLongestRepeat = 258;

}  // namespace

RunDeflate::RunDeflate() : stream_{std::byte{0x78}, std::byte{0x01}} {  // a window of 32 KiB, the fastest level
  // All is one block, the last, in the fixed codes of RFC 1951, 3.2.6.
  put(0b011, 3);
}

void RunDeflate::add(std::byte value, std::uint64_t count) {
  // RFC 1950, 8.2, for all bytes of the run at once.
  constexpr std::uint64_t kModulus = 65521;
  const auto number = std::to_integer<std::uint32_t>(value);
  sum_of_sums_ = (sum_of_sums_ + count * sum_ + number * (count * (count + 1) / 2)) % kModulus;
  sum_ = (sum_ + number * count) % kModulus;

  for (std::uint64_t left = count; left > 0;) {
    const bool repeats = left < count && left >= kShortestRepeat;
    const auto length = repeats ? static_cast<std::uint32_t>(std::min<std::uint64_t>(left, kLongestRepeat)) : 1;
    if (repeats) {
      put_repeats(length);
    } else {
      put_literal(number);
    }
    left -= length;
  }
}

void RunDeflate::add(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const auto end = std::find_if(bytes.begin(), bytes.end(), [&](std::byte byte) { return byte != bytes.front(); });
    const auto count = static_cast<std::size_t>(end - bytes.begin());
    add(bytes.front(), count);
    bytes = bytes.subspan(count);
  }
}

std::vector<std::byte> RunDeflate::finish() {
  put_literal(kEndOfBlock);
  put(0, (8 - waiting_count_) % 8);
  const std::uint64_t check = sum_of_sums_ << 16U | sum_;
  for (const unsigned shift : {24U, 16U, 8U, 0U}) stream_.push_back(static_cast<std::byte>(check >> shift));
  return std::move(stream_);
}

/// Bits of a number, the lowest first.
void RunDeflate::put(std::uint32_t bits, std::uint32_t count) {
  waiting_ |= std::uint64_t{bits} << waiting_count_;
  for (waiting_count_ += count; waiting_count_ >= 8; waiting_count_ -= 8) {
    stream_.push_back(static_cast<std::byte>(waiting_));
    waiting_ >>= 8U;
  }
}

/// Bits of a code, the highest first.
void RunDeflate::put_code(std::uint32_t code, std::uint32_t count) {
  std::uint32_t turned = 0;
  for (std::uint32_t i = 0; i < count; ++i) turned |= (code >> i & 1U) << (count - 1 - i);
  put(turned, count);
}

/// A byte, or what stands behind the bytes in the same alphabet: the end, and lengths.
void RunDeflate::put_literal(std::uint32_t value) {
  if (value < 144) {
    put_code(0x30 + value, 8);
  } else if (value < 256) {
    put_code(0x190 + value - 144, 9);
  } else if (value < 280) {
    put_code(value - 256, 7);
  } else {
    put_code(0xC0 + value - 280, 8);
  }
}

/// The byte before, again and again: a length after RFC 1951, 3.2.5, and the distance 1.
void RunDeflate::put_repeats(std::uint32_t length) {
  const std::uint32_t more = length - kShortestRepeat;
  if (length == kLongestRepeat) {
    put_literal(285);
  } else if (more < 8) {
    put_literal(257 + more);
  } else {
    // Four lengths share a number of extra bits, then there is one more.
    const auto extra = static_cast<std::uint32_t>(std::bit_width(more)) - 3;
    put_literal(257 + 4 * extra + (more >> extra));
    put(more & ((1U << extra) - 1), extra);
  }
  put_code(0, 5);
}

}  // namespace holdfast
