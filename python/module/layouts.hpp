#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <deque>
#include <holdfast/holdfast.hpp>
#include <span>
#include <string>
#include <vector>

namespace holdfast::python {

/// An array of float64, row after row. One of another kind, and what can be made one, is copied.
using Numbers = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;

/// Layouts of a call, in the memory of numpy where that is float64 row after row.
class Layouts {
 public:
  /// One array of shape (boxes, 7), or one `holdfast.Load`, per layout. An array of any other shape is a view with a
  /// problem. Throws `Error` for what is neither an array nor a sequence of rows, nor a load.
  /// @param names one per layout, or none
  Layouts(const pybind11::sequence& arrays, std::vector<std::string> names);

  /// One array of shape (boxes of all layouts, 7), of which layout i has the rows offsets[i], ..., offsets[i + 1] - 1.
  Layouts(const pybind11::object& boxes, const pybind11::object& offsets, std::vector<std::string> names);

  std::span<const LayoutView> views() const { return views_; }

 private:
  void add(const pybind11::object& array);
  void name_all();

  std::vector<Numbers> arrays_;
  std::vector<pybind11::object> loads_;  ///< that views are of
  std::deque<Problem> problems_;         ///< of views
  std::vector<std::string> names_;
  std::vector<LayoutView> views_;
};

/// The array of float64 that an object is, or can be made into. Throws `Error` for masked arrays and for what is no
/// array of whole or decimal numbers.
/// @param name what messages call it
Numbers numbers_from(const pybind11::object& values, const std::string& name);

/// An acceleration whose segments are an array of shape (segments, 5). Throws `Error` for any other shape.
Acceleration acceleration_of(std::string name, const pybind11::object& segments, std::string purpose);

/// Name, segments and purpose: what `acceleration_of` takes.
pybind11::tuple parts_of(const Acceleration& acceleration);

/// An array of shape (boxes, 7).
Numbers array_of(const Layout& layout);

}  // namespace holdfast::python
