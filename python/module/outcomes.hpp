#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstddef>
#include <holdfast/holdfast.hpp>
#include <span>
#include <utility>
#include <vector>

namespace holdfast::python {

/// What became of worlds, as Python gets it: a structured array of this shape (layouts, accelerations), or
/// (accelerations), with one column per number of a `WorldOutcome`.
pybind11::array table_of(std::span<const WorldOutcome> worlds, const std::vector<std::size_t>& shape);

/// The messages of the worlds that have one, by (layout, acceleration).
pybind11::dict messages_of(std::span<const WorldOutcome> worlds);

/// One structured array of shape (accelerations, boxes) per layout.
/// @param accelerations number of worlds per layout
pybind11::list boxes_of(std::span<const WorldOutcome> worlds, std::size_t accelerations);

/// The time series of a world: time (samples), displacement (samples, boxes, 3), orientation (samples, boxes, 4) and
/// angular velocity (samples, boxes, 3). Their memory is that of the series.
pybind11::tuple series_of(Series&& series, std::size_t boxes);

/// Declares the structured types to numpy. Called once, when the module is made.
void declare_row_types();

}  // namespace holdfast::python
