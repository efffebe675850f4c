#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "core/base/error_list.hpp"
#include "core/model/container_shape.hpp"
#include "core/model/layout.hpp"
#include "core/model/settings.hpp"
#include "holdfast/holdfast.hpp"

/// What a layout of the caller says of its boxes and its container beside corners and materials.
namespace holdfast::internal {

/// A length of the caller in metres. Divided as the readers of files do it, so that equal numbers give equal bits.
inline double metres(double length, holdfast::LengthUnit unit) {
  return unit == holdfast::LengthUnit::centimetre ? length / 100.0 : length;
}

/// Whether a box has more than corners and a number of a material.
inline bool has_parts(const holdfast::Box& box) {
  return box.mass || box.mat || box.fixed || box.order || box.bearing_limit || box.centre_of_mass ||
         !box.name.empty() || !box.material_name.empty();
}

/// Takes what a box has beside its corners and its number of a material.
/// @param index  of the box, from 0
/// @param errors get what cannot be used
void take_parts(const holdfast::Box& given, std::size_t index, holdfast::LengthUnit unit, Box& box, ErrorList& errors);

/// The same of the arrays of a view, which have entries for every box or none.
void take_parts(const holdfast::LayoutView& given, std::size_t index, Box& box, ErrorList& errors);

/// Whether a view has more than rows of seven numbers.
bool has_parts(const holdfast::LayoutView& layout);

/// Adds an error for each array of a view that does not have as many entries as there are boxes.
void check_counts(const holdfast::LayoutView& layout, std::size_t boxes, ErrorList& errors);

/// The container that the caller means; what it does not say is as its type or the settings say.
ContainerShape shape_of(const holdfast::Container& given, holdfast::LengthUnit unit, const Settings& settings,
                        ErrorList& errors);

}  // namespace holdfast::internal
