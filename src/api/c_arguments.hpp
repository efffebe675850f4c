#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "holdfast/holdfast.h"
#include "holdfast/holdfast.hpp"

/// Arguments of the C interface, checked and turned into those of the library.
namespace holdfast::internal {

/// A mistake of the calling program.
struct BadArgument {
  std::string what;
};

/// The argument, which must be there.
template <class T>
T* required(T* argument, const char* name) {
  if (argument == nullptr) throw BadArgument{std::string(name) + " is NULL"};
  return argument;
}

/// Room for so many entries in an array of the caller.
void require_room(std::size_t capacity, std::size_t needed, const char* name);

/// Throws when that is not the size of a structure, since the caller has not set it.
void require_size(std::size_t given, const char* name);

/// Copies a structure that begins with its size. Throws when the caller has set what the library does not know.
/// @param to   of `size` bytes, all zero
/// @param from of `given` bytes
void copy_sized(void* to, std::size_t size, const void* from, std::size_t given, const char* name);

/// The options of the caller, who may know an earlier or later version of them than the library: zeros are defaults.
/// @param given null for all defaults
template <class Options>
Options options_of(const Options* given, const char* name) {
  Options options = {};
  if (given == nullptr) return options;
  copy_sized(&options, sizeof options, given, given->size, name);
  return options;
}

/// Entries of the caller that the library fills. They begin with their size, which the first one says for all: that of
/// an earlier or later version of the structure than the library knows.
template <class Entry>
class FilledEntries {
 public:
  FilledEntries(Entry* entries, const char* name)
      : bytes_(reinterpret_cast<std::byte*>(required(entries, name))), size_(entries->size) {
    require_size(size_, name);
  }

  void put(std::size_t i, Entry entry) const {
    entry.size = size_;
    std::byte* const to = bytes_ + i * size_;
    const std::size_t known = std::min(size_, sizeof entry);
    std::memcpy(to, &entry, known);
    std::fill(to + known, to + size_, std::byte{0});
  }

 private:
  std::byte* bytes_;
  std::size_t size_;
};

/// A number of the caller that says yes or no.
bool flag(int value, const char* name);

/// The unit that the caller means.
holdfast::LengthUnit unit_of(int unit);

/// Numbers of a segment in a row of an acceleration: start, duration, and the acceleration along three axes.
inline constexpr std::size_t kNumbersPerSegment = 5;

/// The acceleration of the caller's rows.
holdfast::Acceleration acceleration_of(std::string_view name, const double* segments, std::size_t count);

/// The caller's rows of boxes.
holdfast::LayoutView layout_of(std::string_view name, const double* boxes, std::size_t count);

/// The caller's layouts, in the caller's memory.
std::vector<holdfast::LayoutView> layouts_of(const holdfast_layouts* given);

/// The same of an argument that is to have exactly one.
/// @param name of the layout where the caller gives none
holdfast::LayoutView only_layout_of(const holdfast_layouts* given, std::string_view name);

}  // namespace holdfast::internal
