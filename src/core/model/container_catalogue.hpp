#pragma once

#include <span>
#include <string>
#include <string_view>

#include "core/model/container_shape.hpp"

namespace holdfast::internal {

/// A type of container, vehicle body or pallet. Public tables of the same type differ by a centimetre or two.
struct ContainerType {
  std::string_view name;     ///< as `--container` takes it, such as `40hc`
  std::string_view aliases;  ///< other names that files have, in lower case, without anything but letters and digits
  std::string_view what;     ///< in words
  double length = 0.0;       ///< inner, m, as are width and height
  double width = 0.0;
  double height = 0.0;
  double payload = 0.0;         ///< kg
  std::string_view open_sides;  ///< as the key OpenSides takes them
  double bed_height = 1.2;      ///< of the floor above the ground, m; matters where a side is open
  std::string_view source;      ///< of the numbers

  ContainerShape shape() const;
};

/// All types, in the order in which people are shown them.
std::span<const ContainerType> container_catalogue();

/// The type of that name or alias, whatever its case, blanks and signs: `40' HC` is `40hc`; null where there is none.
const ContainerType* find_container(std::string_view name);

}  // namespace holdfast::internal
