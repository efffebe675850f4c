#include "core/native/collision/pair_table.hpp"

#include <cassert>

namespace holdfast::internal::native {

namespace {

constexpr std::size_t kFirstSize = 64;

/// The finaliser of splitmix64 (Steele, Lea and Flood 2014): every bit of the key changes half of the bits.
std::uint64_t mixed(std::uint64_t key) {
  key = (key ^ (key >> 30)) * 0xbf58476d1ce4e5b9ULL;
  key = (key ^ (key >> 27)) * 0x94d049bb133111ebULL;
  return key ^ (key >> 31);
}

}  // namespace

/// Where the search for a pair begins.
std::size_t PairTable::home(std::int32_t a, std::int32_t b) const {
  const std::uint64_t key = std::uint64_t{static_cast<std::uint32_t>(a)} << 32 | static_cast<std::uint32_t>(b);
  return mixed(key) & (entries_.size() - 1);
}

/// The entry of a pair, or the free one where the search for it ends.
std::size_t PairTable::locate(std::int32_t a, std::int32_t b) const {
  std::size_t i = home(a, b);
  while (entries_[i].index != kNone && (entries_[i].a != a || entries_[i].b != b)) i = (i + 1) & (entries_.size() - 1);
  return i;
}

std::int32_t PairTable::find(std::int32_t a, std::int32_t b) const {
  return entries_.empty() ? kNone : entries_[locate(a, b)].index;
}

void PairTable::set(std::int32_t a, std::int32_t b, std::int32_t index) {
  assert(index >= 0);
  // At most half of the entries are in use: searches stay short.
  if (2 * (size_ + 1) > entries_.size()) grow();
  Entry& entry = entries_[locate(a, b)];
  if (entry.index == kNone) ++size_;
  entry = {a, b, index};
}

void PairTable::erase(std::int32_t a, std::int32_t b) {
  std::size_t hole = locate(a, b);
  assert(entries_[hole].index != kNone);
  --size_;
  // What was pushed beyond the hole moves back into it, unless its search begins behind the hole.
  const std::size_t mask = entries_.size() - 1;
  for (std::size_t i = (hole + 1) & mask; entries_[i].index != kNone; i = (i + 1) & mask) {
    const std::size_t wanted = home(entries_[i].a, entries_[i].b);
    if (((i - wanted) & mask) < ((i - hole) & mask)) continue;
    entries_[hole] = entries_[i];
    hole = i;
  }
  entries_[hole] = {};
}

void PairTable::grow() {
  std::vector<Entry> old(entries_.empty() ? kFirstSize : 2 * entries_.size());
  old.swap(entries_);
  for (const Entry& entry : old)
    if (entry.index != kNone) entries_[locate(entry.a, entry.b)] = entry;
}

}  // namespace holdfast::internal::native
