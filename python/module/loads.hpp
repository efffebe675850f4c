#pragma once

#include <pybind11/pybind11.h>

#include <holdfast/holdfast.hpp>
#include <string>

namespace holdfast::python {

/// Declares `_core.Load`, a layout of the library that a `holdfast.Load` keeps, and the functions that read files of
/// loads and list containers.
void declare_loads(pybind11::module_& module);

/// The layout behind a `holdfast.Load`; null where the object is none.
/// @param keeper owns the layout
const Layout* layout_of_load(const pybind11::handle& object, pybind11::object& keeper);

}  // namespace holdfast::python
