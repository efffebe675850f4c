#include "problems.hpp"

#include <exception>

namespace py = pybind11;

namespace holdfast::python {

namespace {

/// Where the package declares what errors are in Python.
constexpr const char* kPythonSide = "holdfast.errors";

/// An index, or None where the problem has none.
py::object index_of(std::ptrdiff_t index) { return index < 0 ? py::object(py::none()) : py::int_(index); }

/// A place in a text, from 1, or None.
py::object place_of(long place) { return place < 1 ? py::object(py::none()) : py::int_(place); }

/// Text of the library, which may hold bytes of a file that are no UTF-8.
py::object text_of(const std::string& text) {
  return py::reinterpret_steal<py::object>(
      PyUnicode_DecodeUTF8(text.data(), static_cast<py::ssize_t>(text.size()), "replace"));
}

}  // namespace

py::tuple problems_of(std::span<const Problem> problems) {
  py::tuple all(problems.size());
  if (problems.empty()) return all;
  const py::object type = py::module_::import(kPythonSide).attr("Problem");
  for (std::size_t i = 0; i < problems.size(); ++i) {
    const Problem& problem = problems[i];
    all[i] = type(text_of(problem.message), text_of(problem.what), text_of(problem.value), text_of(problem.accepted),
                  index_of(problem.layout), index_of(problem.box), index_of(problem.box_column), text_of(problem.file),
                  place_of(problem.line), place_of(problem.column));
  }
  return all;
}

void translate_errors() {
  // NOLINTNEXTLINE(performance-unnecessary-value-param): the type that pybind11 asks for
  py::register_local_exception_translator([](std::exception_ptr pointer) {
    try {
      if (pointer) std::rethrow_exception(pointer);
    } catch (const Error& error) {
      const py::object type = py::module_::import(kPythonSide).attr("Error");
      PyErr_SetObject(type.ptr(), type(problems_of(error.problems())).ptr());
    }
  });
}

}  // namespace holdfast::python
