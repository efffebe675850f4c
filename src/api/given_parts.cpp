#include "api/given_parts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "core/base/number_text.hpp"
#include "core/base/utf8.hpp"
#include "core/model/container_catalogue.hpp"
#include "core/model/container_sides.hpp"

namespace holdfast::internal {

namespace {

/// Shortest length of a container, m.
constexpr double kLeastLength = 1e-3;

Vec3 lengths_of(const std::array<double, 3>& numbers, holdfast::LengthUnit unit) {
  return {metres(numbers[0], unit), metres(numbers[1], unit), metres(numbers[2], unit)};
}

/// The number, which must be within the limits.
/// @param what it is, with its box
std::optional<double> within(std::optional<double> number, double least, const char* what, std::size_t index,
                             const Box& box, ErrorList& errors) {
  if (!number || (*number >= least && *number <= kMostOfBox)) return number;
  if (errors.full()) {
    errors.count_more();
    return std::nullopt;
  }
  const std::string name = box.name.empty() ? "" : " (" + box.name + ')';
  errors.add({.what = std::string(what) + " of box " + std::to_string(index + 1) + name + " is not possible",
              .value = number_text(*number),
              .accepted = std::string(least > 0.0 ? "a number above 0" : "a number from 0") + ", up to 1000000",
              .box = static_cast<long>(index) + 1});
  return std::nullopt;
}

/// Entry of an array that may be empty; nothing for what is not a number.
std::optional<double> entry(std::span<const double> numbers, std::size_t index) {
  if (numbers.empty() || std::isnan(numbers[index])) return std::nullopt;
  return numbers[index];
}

void add(ErrorList& errors, const char* what, std::string value, const char* accepted) {
  if (errors.full()) return errors.count_more();
  errors.add({.what = what, .value = std::move(value), .accepted = accepted});
}

}  // namespace

void take_parts(const holdfast::Box& given, std::size_t index, holdfast::LengthUnit unit, Box& box, ErrorList& errors) {
  if (!given.material_name.empty()) box.material = MaterialName(kept_name(given.material_name));
  if (!given.name.empty()) box.name = kept_name(given.name);
  box.mass = within(given.mass, kLeastMass, "the mass", index, box, errors);
  box.mat = within(given.mat, 0.0, "the friction of the mat", index, box, errors);
  box.bearing_limit = within(given.bearing_limit, 0.0, "the bearing limit", index, box, errors);
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
  box.mass = within(entry(given.masses, index), kLeastMass, "the mass", index, box, errors);
  box.mat = within(entry(given.mats, index), 0.0, "the friction of the mat", index, box, errors);
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

std::optional<ContainerShape> shape_of_type(std::string_view type, ErrorList& errors) {
  if (const ContainerType* const known = find_container(type)) return known->shape();
  add(errors, "no type of container", kept_name(type), "a name that `holdfast containers` lists, such as 40hc");
  return std::nullopt;
}

ContainerShape shape_of(const holdfast::Container& given, holdfast::LengthUnit unit, const Settings& settings,
                        ErrorList& errors) {
  ContainerShape shape = settings.container;
  shape.type.clear();
  if (!given.type.empty()) {
    auto known = shape_of_type(given.type, errors);
    if (known) shape = std::move(*known);
  }
  if (given.size) {
    shape.size = lengths_of(*given.size, unit);
    if (!(shape.size.array() >= kLeastLength && shape.size.array() <= kMostOfBox).all())
      add(errors, "the size of the container is not possible",
          rounded_text(shape.size.x()) + " x " + rounded_text(shape.size.y()) + " x " + rounded_text(shape.size.z()) +
              " m",
          "three lengths above 0");
  }
  if (given.open_sides) {
    shape.open_sides = *given.open_sides;
    for (const std::string& side : shape.open_sides)
      if (!can_be_open(side)) add(errors, "an open side that is none", side, "front, rear, left, right or roof");
  }
  if (given.drop_sides) {
    shape.drop_sides.clear();
    for (const holdfast::DropSide& drop : *given.drop_sides) {
      shape.drop_sides.push_back({drop.side, metres(drop.height, unit)});
      if (!can_be_open(drop.side) || drop.side == "roof")
        add(errors, "a drop side that is no wall", drop.side, "front, rear, left or right");
      if (!(shape.drop_sides.back().height >= kLeastLength && shape.drop_sides.back().height <= kMostOfBox))
        add(errors, "the height of a drop side is not possible", rounded_text(shape.drop_sides.back().height) + " m",
            "a length above 0");
    }
  }
  for (const DropSide& drop : shape.drop_sides)
    if (std::find(shape.open_sides.begin(), shape.open_sides.end(), drop.side) != shape.open_sides.end())
      add(errors, "a side is both open and a drop side", drop.side, "each side in one of the two");
  if (given.bed_height) {
    shape.bed_height = metres(*given.bed_height, unit);
    if (!(shape.bed_height >= 0.0 && shape.bed_height <= kMostOfBox))
      add(errors, "the height of the bed is not possible", rounded_text(shape.bed_height) + " m", "a length from 0");
  }
  return shape;
}

}  // namespace holdfast::internal
