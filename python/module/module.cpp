// The compiled part of the Python package `holdfast`. The package wraps what is here, and its stub, _core.pyi, declares
// it.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <holdfast/holdfast.hpp>

#include "bound_screen.hpp"
#include "layouts.hpp"
#include "loads.hpp"
#include "outcomes.hpp"
#include "problems.hpp"

namespace py = pybind11;

namespace {

using holdfast::python::BoundScreen;

holdfast::ScreenOptions options_of(std::string config, std::optional<std::string> norm,
                                   std::optional<std::string> engine, std::optional<std::string> accuracy,
                                   std::optional<std::string> scheduler, std::optional<int> threads, bool centimetres,
                                   bool mark, bool keep_boxes, bool keep_series, std::size_t most_in_flight) {
  return {.config = std::move(config),
          .norm = std::move(norm),
          .engine = std::move(engine),
          .accuracy = std::move(accuracy),
          .scheduler = std::move(scheduler),
          .threads = threads,
          .unit = centimetres ? holdfast::LengthUnit::centimetre : holdfast::LengthUnit::metre,
          .bad_layouts = mark ? holdfast::BadLayouts::mark : holdfast::BadLayouts::raise,
          .keep_boxes = keep_boxes,
          .keep_series = keep_series,
          .most_in_flight = most_in_flight};
}

}  // namespace

PYBIND11_MODULE(_core, module) {
  holdfast::python::declare_row_types();
  holdfast::python::translate_errors();

  module.def("version", &holdfast::version);
  holdfast::python::declare_loads(module);
  module.def("engines", [] {
    py::list all;
    for (const holdfast::EngineInfo& engine : holdfast::engines())
      all.append(py::make_tuple(engine.name, engine.sentence, engine.missing));
    return all;
  });
  module.def("analysis_numbers", [] {
    py::list all;
    for (const holdfast::AnalysisNumber& number : holdfast::analysis_numbers())
      all.append(py::make_tuple(number.name, number.sentence));
    return all;
  });
  module.def("numbers", &holdfast::python::numbers_from, py::arg("values"), py::arg("name"));
  module.def(
      "read_acceleration",
      [](const std::string& path) { return holdfast::python::parts_of(holdfast::read_acceleration(path)); },
      py::arg("path"));

  module.def(
      "norm_accelerations",
      [](const std::string& name) {
        py::list all;
        for (const holdfast::Acceleration& acceleration : holdfast::norm_accelerations(name))
          all.append(holdfast::python::parts_of(acceleration));
        return all;
      },
      py::arg("name"));

  py::class_<BoundScreen>(module, "Screen")
      .def(py::init([](std::string config, std::optional<std::string> norm, std::optional<std::string> engine,
                       std::optional<std::string> accuracy, std::optional<std::string> scheduler,
                       std::optional<int> threads, bool centimetres, bool mark, bool keep_boxes, bool keep_series,
                       std::size_t most_in_flight) {
             return std::make_unique<BoundScreen>(
                 options_of(std::move(config), std::move(norm), std::move(engine), std::move(accuracy),
                            std::move(scheduler), threads, centimetres, mark, keep_boxes, keep_series, most_in_flight));
           }),
           py::kw_only(), py::arg("config"), py::arg("norm"), py::arg("engine"), py::arg("accuracy"),
           py::arg("scheduler"), py::arg("threads"), py::arg("centimetres"), py::arg("mark"), py::arg("keep_boxes"),
           py::arg("keep_series"), py::arg("most_in_flight"))
      .def("add_acceleration", &BoundScreen::add_acceleration, py::arg("name"), py::arg("segments"), py::arg("purpose"))
      .def("accelerations", &BoundScreen::accelerations)
      .def("evaluate", &BoundScreen::evaluate, py::arg("layouts"), py::arg("offsets"), py::arg("names"),
           py::arg("on_main_thread"))
      .def("holds", &BoundScreen::holds, py::arg("layouts"), py::arg("offsets"), py::arg("names"),
           py::arg("on_main_thread"))
      .def("indicators", &BoundScreen::indicators, py::arg("layouts"), py::arg("offsets"), py::arg("names"))
      .def("margins", &BoundScreen::margins, py::arg("layouts"), py::arg("offsets"), py::arg("names"),
           py::arg("on_main_thread"))
      .def("replay", &BoundScreen::replay, py::arg("layout"), py::arg("on_main_thread"))
      .def(
          "record",
          [](BoundScreen& screen, const py::object& layouts, const py::object& offsets, std::vector<std::string> names,
             const std::string& path, bool series, bool resume, bool overwrite, std::string command_line,
             bool on_main_thread) {
            return screen.record(
                layouts, offsets, std::move(names), path,
                {.series = series, .resume = resume, .overwrite = overwrite, .command_line = std::move(command_line)},
                on_main_thread);
          },
          py::arg("layouts"), py::arg("offsets"), py::arg("names"), py::arg("path"), py::kw_only(), py::arg("series"),
          py::arg("resume"), py::arg("overwrite"), py::arg("command_line"), py::arg("on_main_thread"))
      .def("submit", &BoundScreen::submit, py::arg("layout"), py::arg("name"))
      .def("poll", &BoundScreen::poll, py::arg("ordered"), py::arg("on_main_thread"))
      .def("cancel", &BoundScreen::cancel)
      .def("in_flight", &BoundScreen::in_flight)
      .def("read_layout", &BoundScreen::read_layout, py::arg("path"));
}
