#include "api/c_arguments.hpp"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <limits>

#include "api/c_handles.hpp"
#include "api/convert.hpp"
#include "holdfast/holdfast.h"

namespace holdfast::internal {

namespace {

/// Largest size that a structure can have, bytes: a larger one was not set.
constexpr std::size_t kLargestStructure = 4096;

/// Most rows of an array whose numbers a pointer can count.
constexpr std::size_t kMostRows = std::numeric_limits<std::ptrdiff_t>::max() / (8 * sizeof(double));

const double* rows_of(const double* rows, std::size_t count, const char* name) {
  if (count == 0) return nullptr;
  if (count > kMostRows) throw BadArgument{"there cannot be " + std::to_string(count) + " " + name};
  return required(rows, name);
}

}  // namespace

std::uintptr_t next_handle_number() {
  // Multiples of what memory is aligned to, so that nobody takes the handle for a pointer into an object.
  static std::atomic<std::uintptr_t> last = 0;
  return last += alignof(std::max_align_t);
}

void require_room(std::size_t capacity, std::size_t needed, const char* name) {
  if (capacity >= needed) return;
  throw BadArgument{std::string(name) + " has room for " + std::to_string(capacity) + " entries, and " +
                    std::to_string(needed) + " are needed"};
}

void require_size(std::size_t given, const char* name) {
  if (given < sizeof(std::size_t) || given > kLargestStructure)
    throw BadArgument{std::string(name) + ".size is " + std::to_string(given) + ", not the size of the structure"};
}

void copy_sized(void* to, std::size_t size, const void* from, std::size_t given, const char* name) {
  require_size(given, name);
  const auto* const bytes = static_cast<const unsigned char*>(from);
  const auto is_set = [](unsigned char byte) { return byte != 0; };
  if (given > size && std::any_of(bytes + size, bytes + given, is_set))
    throw BadArgument{std::string(name) + " has members that this version of the library does not know"};
  std::memcpy(to, from, std::min(size, given));
}

bool flag(int value, const char* name) {
  if (value != 0 && value != 1) throw BadArgument{std::string(name) + " is " + std::to_string(value) + ", not 0 or 1"};
  return value == 1;
}

holdfast::LengthUnit unit_of(int unit) {
  if (unit == HOLDFAST_METRE) return holdfast::LengthUnit::metre;
  if (unit == HOLDFAST_CENTIMETRE) return holdfast::LengthUnit::centimetre;
  throw BadArgument{"unit is " + std::to_string(unit) + ", not HOLDFAST_METRE or HOLDFAST_CENTIMETRE"};
}

holdfast::Acceleration acceleration_of(std::string_view name, const double* segments, std::size_t count) {
  const double* row = rows_of(segments, count, "segments");
  holdfast::Acceleration acceleration{std::string(name), {}};
  for (std::size_t i = 0; i < count; ++i, row += kNumbersPerSegment)
    acceleration.segments.push_back({row[0], row[1], {row[2], row[3], row[4]}});
  return acceleration;
}

holdfast::LayoutView layout_of(std::string_view name, const double* boxes, std::size_t count) {
  return {name, {rows_of(boxes, count, "boxes"), count * kNumbersPerBox}};
}

std::vector<holdfast::LayoutView> layouts_of(const holdfast_layouts* given) {
  const auto layouts = options_of(required(given, "layouts"), "layouts");
  std::vector<holdfast::LayoutView> views;
  if (layouts.layout_count == 0) return views;
  const std::size_t* const offsets = required(layouts.offsets, "layouts.offsets");
  const holdfast::LayoutView all = layout_of("", layouts.boxes, layouts.box_count);
  for (std::size_t i = 0; i < layouts.layout_count; ++i) {
    const std::size_t first = offsets[i];
    if (first > offsets[i + 1] || offsets[i + 1] > layouts.box_count)
      throw BadArgument{"layout " + std::to_string(i) + " has the boxes " + std::to_string(first) + " to " +
                        std::to_string(offsets[i + 1]) + " of " + std::to_string(layouts.box_count)};
    const std::size_t count = offsets[i + 1] - first;
    holdfast::LayoutView& view = views.emplace_back();
    view.numbers = all.numbers.subspan(first * kNumbersPerBox, count * kNumbersPerBox);
    if (layouts.names != nullptr && layouts.names[i] != nullptr) view.name = layouts.names[i];
    if (layouts.masses != nullptr) view.masses = {layouts.masses + first, count};
    if (layouts.mats != nullptr) view.mats = {layouts.mats + first, count};
    if (layouts.box_names != nullptr) view.box_names = {layouts.box_names + first, count};
    if (layouts.containers != nullptr && layouts.containers[i] != nullptr) view.container = layouts.containers[i];
  }
  return views;
}

holdfast::LayoutView only_layout_of(const holdfast_layouts* given, std::string_view name) {
  const std::vector<holdfast::LayoutView> views = layouts_of(given);
  if (views.size() != 1)
    throw BadArgument{"layout has " + std::to_string(views.size()) + " layouts, and one is needed"};
  holdfast::LayoutView view = views.front();
  if (view.name.empty()) view.name = name;
  return view;
}

}  // namespace holdfast::internal
