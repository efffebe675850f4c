#include "layouts.hpp"

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <utility>

#include "loads.hpp"

namespace py = pybind11;

namespace holdfast::python {

namespace {

constexpr py::ssize_t kBoxColumns = 7;
constexpr py::ssize_t kSegmentColumns = 5;
constexpr std::string_view kRealNumbers = "iuf";

Error wrong(std::string what, std::string value, std::string accepted, std::ptrdiff_t layout = -1) {
  std::string message = what + (value.empty() ? "" : ": " + value) + "; " + accepted;
  return Error({{.what = std::move(what),
                 .value = std::move(value),
                 .accepted = std::move(accepted),
                 .message = std::move(message),
                 .layout = layout}});
}

std::string shape_text(const py::array& array) { return py::str(array.attr("shape")); }

std::string type_text(const py::handle& object) {
  const std::string name = py::str(py::type::handle_of(object).attr("__name__"));
  if (!py::isinstance<py::array>(object)) return name;
  return name + " of " + std::string(py::str(object.attr("dtype")));
}

/// The array that an object is, or can be made into; none when it cannot.
/// @param kinds of numbers that are taken, as NumPy names them
template <class Array>
Array array_from(const py::handle& object, std::string_view kinds) {
  // A mask says which entries are no numbers. Texts, dates and complex numbers would be made into numbers that nobody
  // meant.
  if (!py::isinstance(object, py::module_::import("numpy").attr("ma").attr("MaskedArray"))) {
    const py::array any = py::array::ensure(object);
    if (any && (any.size() == 0 || kinds.find(any.dtype().kind()) != std::string_view::npos)) {
      if (Array array = Array::ensure(any)) return array;
    }
  }
  PyErr_Clear();
  return py::reinterpret_steal<Array>(py::handle());
}

/// Whether an array is a table with so many columns, or has nothing in it.
bool has_columns(const Numbers& array, py::ssize_t columns) {
  if (array.ndim() == 2) return array.shape(1) == columns;
  return array.ndim() < 2 && array.size() == 0;
}

/// The same, and an error for none.
Numbers required_array(const py::handle& object, const std::string& name, const char* accepted) {
  Numbers array = array_from<Numbers>(object, kRealNumbers);
  if (!array) throw wrong(name + " is no array of numbers", type_text(object), accepted);
  return array;
}

/// The array of numbers with so many columns that an object is, or can be made into.
/// @param name what messages call it
Numbers numbers_of(const py::handle& object, py::ssize_t columns, const std::string& name, const char* accepted) {
  Numbers array = required_array(object, name, accepted);
  if (!has_columns(array, columns)) throw wrong(name + " has a wrong shape", shape_text(array), accepted);
  return array;
}

/// Whether an object can be meant as a layout.
bool is_table(const py::handle& object) {
  const bool is_text = py::isinstance<py::str>(object) || py::isinstance<py::bytes>(object);
  return py::isinstance<py::array>(object) || (!is_text && py::isinstance<py::sequence>(object));
}

std::span<const double> span_of(const Numbers& array) { return {array.data(), static_cast<std::size_t>(array.size())}; }

}  // namespace

Layouts::Layouts(const py::sequence& arrays, std::vector<std::string> names) : names_(std::move(names)) {
  arrays_.reserve(arrays.size());
  views_.reserve(arrays.size());
  for (const py::object object : arrays) add(object);
  name_all();
}

void Layouts::add(const py::object& object) {
  constexpr const char* kAccepted =
      "an array of shape (boxes, 7) or a Load is needed; a single layout goes into a list";
  if (!py::isinstance<py::array>(object)) {
    py::object keeper;
    if (const Layout* const layout = layout_of_load(object, keeper)) {
      views_.push_back({.name = layout->name, .layout = layout});
      loads_.push_back(std::move(keeper));
      return;
    }
  }
  if (!is_table(object)) {
    const std::size_t i = views_.size();
    const std::string name = i < names_.size() && !names_[i].empty() ? names_[i] : "layout " + std::to_string(i);
    throw wrong(name + " is no array of numbers", type_text(object), kAccepted, static_cast<std::ptrdiff_t>(i));
  }
  Numbers array = array_from<Numbers>(object, kRealNumbers);
  if (!array) {
    problems_.push_back({.what = "no array of numbers", .value = type_text(object), .accepted = kAccepted});
  } else if (!has_columns(array, kBoxColumns)) {
    problems_.push_back({.what = "a wrong shape", .value = shape_text(array), .accepted = kAccepted});
  } else {
    views_.push_back({"", span_of(array)});
    arrays_.push_back(std::move(array));
    return;
  }
  views_.push_back({.problem = &problems_.back()});
}

Layouts::Layouts(const py::object& boxes, const py::object& offsets, std::vector<std::string> names)
    : names_(std::move(names)) {
  arrays_.push_back(numbers_of(boxes, kBoxColumns, "the array of boxes",
                               "with offsets an array of shape (boxes of all layouts, 7) is needed"));
  const auto ends = array_from<py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>>(offsets, "iu");
  if (!ends || ends.ndim() != 1 || ends.size() == 0) {
    throw wrong("the offsets have a wrong type or shape", ends ? shape_text(ends) : "",
                "whole numbers of shape (layouts + 1) are needed");
  }
  const std::int64_t* const row = ends.data();
  const auto count = static_cast<std::size_t>(ends.size() - 1);
  const py::ssize_t rows = arrays_[0].size() / kBoxColumns;
  views_.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    if (row[i] < 0 || row[i + 1] < row[i] || row[i + 1] > rows)
      throw wrong("layout " + std::to_string(i) + " has offsets that are none",
                  std::to_string(row[i]) + " to " + std::to_string(row[i + 1]),
                  "they do not fall, from 0 to the number of boxes, " + std::to_string(rows),
                  static_cast<std::ptrdiff_t>(i));
    const auto columns = static_cast<std::size_t>(kBoxColumns);
    views_.push_back({"", span_of(arrays_[0])
                              .subspan(static_cast<std::size_t>(row[i]) * columns,
                                       static_cast<std::size_t>(row[i + 1] - row[i]) * columns)});
  }
  name_all();
}

void Layouts::name_all() {
  if (names_.empty()) return;
  if (names_.size() != views_.size())
    throw wrong(
        "there are " + std::to_string(names_.size()) + " names and " + std::to_string(views_.size()) + " layouts", "",
        "one name per layout is needed, or none");
  for (std::size_t i = 0; i < views_.size(); ++i) views_[i].name = names_[i];
}

Numbers numbers_from(const py::object& values, const std::string& name) {
  return required_array(values, name, "whole or decimal numbers without a mask are needed");
}

Acceleration acceleration_of(std::string name, const py::object& segments, std::string purpose) {
  const Numbers array =
      numbers_of(segments, kSegmentColumns, "acceleration " + name,
                 "an array of shape (segments, 5) is needed: start, duration, acceleration along x, y, z");
  Acceleration acceleration{std::move(name), {}, std::move(purpose)};
  const std::span<const double> numbers = span_of(array);
  for (std::size_t i = 0; i < numbers.size(); i += static_cast<std::size_t>(kSegmentColumns))
    acceleration.segments.push_back({numbers[i], numbers[i + 1], {numbers[i + 2], numbers[i + 3], numbers[i + 4]}});
  return acceleration;
}

py::tuple parts_of(const Acceleration& acceleration) {
  Numbers segments({static_cast<py::ssize_t>(acceleration.segments.size()), kSegmentColumns});
  double* next = segments.mutable_data();
  for (const Segment& segment : acceleration.segments) {
    *next++ = segment.start;
    *next++ = segment.duration;
    next = std::copy(segment.acceleration.begin(), segment.acceleration.end(), next);
  }
  return py::make_tuple(acceleration.name, segments, acceleration.purpose);
}

Numbers array_of(const Layout& layout) {
  Numbers array({static_cast<py::ssize_t>(layout.boxes.size()), kBoxColumns});
  double* next = array.mutable_data();
  for (const Box& box : layout.boxes) {
    next = std::copy(box.corner_min.begin(), box.corner_min.end(), next);
    next = std::copy(box.corner_max.begin(), box.corner_max.end(), next);
    *next++ = box.material;
  }
  return array;
}

}  // namespace holdfast::python
