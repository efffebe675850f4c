#include "core/model/given_container.hpp"

#include <algorithm>
#include <utility>

#include "core/base/number_text.hpp"
#include "core/base/utf8.hpp"
#include "core/model/container_catalogue.hpp"
#include "core/model/container_sides.hpp"
#include "core/model/load_limits.hpp"

namespace holdfast::internal {

namespace {

void add_wrong(ErrorList& errors, const char* what, std::string value, const char* accepted) {
  if (errors.full()) return errors.count_more();
  errors.add({.what = what, .value = std::move(value), .accepted = accepted});
}

/// The same, with the place of what a load says.
/// @param key beneath its container in JSON; may be empty
void add_wrong(ErrorList& errors, const GivenContainer& given, const std::string& key, const char* what,
               std::string value, const char* accepted) {
  if (errors.full()) return errors.count_more();
  errors.add({.line = given.line,
              .what = (given.pointer.empty() ? "" : given.pointer + key + ": ") + what,
              .value = std::move(value),
              .accepted = accepted});
}

}  // namespace

std::optional<ContainerShape> shape_of_type(std::string_view type, ErrorList& errors) {
  if (const ContainerType* const known = find_container(type)) return known->shape();
  add_wrong(errors, "no type of container", kept_name(type), "a name that `holdfast containers` lists, such as 40hc");
  return std::nullopt;
}

ContainerShape shape_of(const GivenContainer& given, const Settings& settings, ErrorList& errors) {
  ContainerShape shape = settings.container;
  shape.type.clear();
  if (!given.type.empty()) {
    auto known = shape_of_type(given.type, errors);
    if (known) shape = std::move(*known);
  }
  if (given.size) {
    shape.size = *given.size;
    if (!(shape.size.array() >= kLeastLength && shape.size.array() <= kMostOfLoad).all())
      add_wrong(errors, given, "/size", "the size of the container is not possible",
                rounded_text(shape.size.x()) + " x " + rounded_text(shape.size.y()) + " x " +
                    rounded_text(shape.size.z()) + " m",
                "three lengths of at least 1 mm, up to 1000000 m");
  }
  if (given.open_sides) {
    shape.open_sides = *given.open_sides;
    for (const std::string& side : shape.open_sides)
      if (!can_be_open(side)) add_wrong(errors, "an open side that is none", side, "front, rear, left, right or roof");
  }
  if (given.drop_sides) {
    shape.drop_sides = *given.drop_sides;
    for (const DropSide& drop : shape.drop_sides) {
      if (!can_be_open(drop.side) || drop.side == "roof")
        add_wrong(errors, "a drop side that is no wall", drop.side, "front, rear, left or right");
      if (!(drop.height >= kLeastLength && drop.height <= kMostOfLoad))
        add_wrong(errors, given, "/drop_sides/" + drop.side, "the height of a drop side is not possible",
                  rounded_text(drop.height) + " m", "a length of at least 1 mm, up to 1000000 m");
    }
  }
  if (given.drop_sides && !given.open_sides) close_drop_sides(shape);
  for (const DropSide& drop : shape.drop_sides)
    if (std::find(shape.open_sides.begin(), shape.open_sides.end(), drop.side) != shape.open_sides.end())
      add_wrong(errors, given, "", "a side is both open and a drop side", drop.side, "each side in one of the two");
  if (given.bed_height) {
    shape.bed_height = *given.bed_height;
    if (!(shape.bed_height >= 0.0 && shape.bed_height <= kMostOfLoad))
      add_wrong(errors, "the height of the bed is not possible", rounded_text(shape.bed_height) + " m",
                "a length from 0");
  }
  return shape;
}

}  // namespace holdfast::internal
