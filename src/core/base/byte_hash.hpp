#pragma once

#include <cstddef>
#include <cstdint>

namespace holdfast::internal {

/// 64-bit FNV-1a of bytes, in the order in which they are added: equal bytes have equal hashes on every machine.
class ByteHash {
 public:
  void add(const void* data, std::size_t size) {
    const auto* const bytes = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < size; ++i) hash_ = (hash_ ^ bytes[i]) * 0x100000001b3ULL;
  }
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325ULL;
};

}  // namespace holdfast::internal
