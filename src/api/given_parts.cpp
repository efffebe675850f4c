#include "api/given_parts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "core/base/number_text.hpp"
#include "core/base/utf8.hpp"
#include "core/model/friction_pairs.hpp"
#include "core/model/given_container.hpp"
#include "core/model/load_limits.hpp"

namespace holdfast::internal {

namespace {

Vec3 lengths_of(const std::array<double, 3>& numbers, holdfast::LengthUnit unit) {
  return {metres(numbers[0], unit), metres(numbers[1], unit), metres(numbers[2], unit)};
}

/// The number, which must be within the limits.
/// @param what it is, with its box
std::optional<double> within(std::optional<double> number, double least, double most, const char* what,
                             std::size_t index, const Box& box, ErrorList& errors) {
  if (!number || (*number >= least && *number <= most)) return number;
  if (errors.full()) {
    errors.count_more();
    return std::nullopt;
  }
  const std::string name = box.name.empty() ? "" : " (" + box.name + ')';
  errors.add(
      {.what = std::string(what) + " of box " + std::to_string(index + 1) + name + " is not possible",
       .value = number_text(*number),
       .accepted = std::string(least > 0.0 ? "a number above 0" : "a number from 0") + ", up to " + rounded_text(most),
       .box = static_cast<long>(index) + 1});
  return std::nullopt;
}

/// Entry of an array that may be empty; nothing for what is not a number.
std::optional<double> entry(std::span<const double> numbers, std::size_t index) {
  if (numbers.empty() || std::isnan(numbers[index])) return std::nullopt;
  return numbers[index];
}

}  // namespace

void take_parts(const holdfast::Box& given, std::size_t index, holdfast::LengthUnit unit, Box& box, ErrorList& errors) {
  if (!given.material_name.empty()) box.material = MaterialName(kept_name(given.material_name));
  if (!given.name.empty()) box.name = kept_name(given.name);
  box.mass = within(given.mass, kLeastMass, kMostOfLoad, "the mass", index, box, errors);
  box.mat = within(given.mat, 0.0, kLargestFriction, "the friction of the mat", index, box, errors);
  box.bearing_limit = within(given.bearing_limit, 0.0, kMostOfLoad, "the bearing limit", index, box, errors);
  box.fixed = given.fixed;
  if (given.order) box.order = static_cast<long>(*given.order);
  if (!given.centre_of_mass) return;
  box.centre_of_mass = lengths_of(*given.centre_of_mass, unit);
  if (box.centre_of_mass->allFinite() || errors.full()) return;
  errors.add({.what = "the centre of mass of box " + std::to_string(index + 1) + " is not finite",
              .accepted = "three numbers",
              .box = static_cast<long>(index) + 1});
}

void take_parts(const holdfast::LayoutView& given, std::size_t index, Box& box, ErrorList& errors) {
  if (!given.box_names.empty() && given.box_names[index] != nullptr) box.name = kept_name(given.box_names[index]);
  box.mass = within(entry(given.masses, index), kLeastMass, kMostOfLoad, "the mass", index, box, errors);
  box.mat = within(entry(given.mats, index), 0.0, kLargestFriction, "the friction of the mat", index, box, errors);
}

bool has_parts(const holdfast::LayoutView& layout) {
  return !layout.masses.empty() || !layout.mats.empty() || !layout.box_names.empty();
}

void check_counts(const holdfast::LayoutView& layout, std::size_t boxes, ErrorList& errors) {
  const auto check = [&](std::size_t count, const char* what) {
    if (count != 0 && count != boxes)
      errors.add({.what = std::string("there are not as many ") + what + " as boxes",
                  .value = std::to_string(count),
                  .accepted = std::to_string(boxes) + ", or none"});
  };
  check(layout.masses.size(), "masses");
  check(layout.mats.size(), "mats");
  check(layout.box_names.size(), "names of boxes");
}

ContainerShape shape_of(const holdfast::Container& given, holdfast::LengthUnit unit, const Settings& settings,
                        ErrorList& errors) {
  GivenContainer container{.type = given.type, .open_sides = given.open_sides};
  if (given.size) container.size = lengths_of(*given.size, unit);
  if (given.bed_height) container.bed_height = metres(*given.bed_height, unit);
  if (given.drop_sides) {
    container.drop_sides.emplace();
    for (const holdfast::DropSide& drop : *given.drop_sides)
      container.drop_sides->push_back({drop.side, metres(drop.height, unit)});
  }
  return shape_of(container, settings, errors);
}

}  // namespace holdfast::internal
