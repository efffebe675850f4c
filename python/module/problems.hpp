#pragma once

#include <pybind11/pybind11.h>

#include <holdfast/holdfast.hpp>
#include <span>

namespace holdfast::python {

/// The problems as a tuple of `holdfast.Problem`.
pybind11::tuple problems_of(std::span<const Problem> problems);

/// From now on an `Error` of the library becomes a `holdfast.Error`.
void translate_errors();

}  // namespace holdfast::python
