#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/error_list.hpp"
#include "core/base/vector.hpp"
#include "core/model/container_shape.hpp"
#include "core/model/settings.hpp"

namespace holdfast::internal {

/// What a load says of its container.
struct GivenContainer {
  std::string type;          ///< in the catalogue; empty: none
  std::optional<Vec3> size;  ///< m
  std::optional<std::vector<std::string>> open_sides;
  std::optional<std::vector<DropSide>> drop_sides;
  std::optional<double> bed_height;  ///< m
  long line = 0;                     ///< of the file that says it, from 1
  std::string pointer;               ///< of JSON that says it
};

/// The container that is meant: what is not said is as its type or the settings say.
/// @param errors get what cannot be used
ContainerShape shape_of(const GivenContainer& given, const Settings& settings, ErrorList& errors);

/// The container of that type; nothing, and an error, where there is none.
std::optional<ContainerShape> shape_of_type(std::string_view type, ErrorList& errors);

}  // namespace holdfast::internal
