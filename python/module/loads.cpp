#include "loads.hpp"

#include <pybind11/stl.h>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "problems.hpp"

namespace py = pybind11;

namespace holdfast::python {

namespace {

using Triple = std::array<double, 3>;
using Drops = std::vector<std::pair<std::string, double>>;

/// A box as `holdfast.Box` has it: corners, name, material, mass, mat, centre of mass, fixed, order, bearing limit.
using BoxParts =
    std::tuple<Triple, Triple, std::string, std::variant<int, std::string>, std::optional<double>,
               std::optional<double>, std::optional<Triple>, bool, std::optional<std::int64_t>, std::optional<double>>;

/// A container as `holdfast.Container` has it: type, size, open sides, drop sides, height of the bed.
using ContainerParts = std::tuple<std::string, std::optional<Triple>, std::optional<std::vector<std::string>>,
                                  std::optional<Drops>, std::optional<double>>;

Box box_of(const BoxParts& parts) {
  const auto& [corner_min, corner_max, name, material, mass, mat, centre_of_mass, fixed, order, bearing_limit] = parts;
  Box box{.corner_min = corner_min,
          .corner_max = corner_max,
          .name = name,
          .mass = mass,
          .centre_of_mass = centre_of_mass,
          .mat = mat,
          .fixed = fixed,
          .order = order,
          .bearing_limit = bearing_limit};
  if (const int* const id = std::get_if<int>(&material))
    box.material = *id;
  else
    box.material_name = std::get<std::string>(material);
  return box;
}

BoxParts parts_of(const Box& box) {
  std::variant<int, std::string> material = box.material;
  if (!box.material_name.empty()) material = box.material_name;
  return {box.corner_min, box.corner_max,     box.name,  std::move(material), box.mass,
          box.mat,        box.centre_of_mass, box.fixed, box.order,           box.bearing_limit};
}

Container container_of(const ContainerParts& parts) {
  const auto& [type, size, open_sides, drop_sides, bed_height] = parts;
  Container container{.type = type, .size = size, .open_sides = open_sides, .bed_height = bed_height};
  if (drop_sides) {
    container.drop_sides.emplace();
    for (const auto& [side, height] : *drop_sides) container.drop_sides->push_back({side, height});
  }
  return container;
}

ContainerParts parts_of(const Container& container) {
  std::optional<Drops> drops;
  if (container.drop_sides) {
    drops.emplace();
    for (const DropSide& drop : *container.drop_sides) drops->emplace_back(drop.side, drop.height);
  }
  return {container.type, container.size, container.open_sides, std::move(drops), container.bed_height};
}

std::unique_ptr<Layout> made(std::string name, const std::optional<ContainerParts>& container,
                             const std::vector<BoxParts>& boxes) {
  auto layout = std::make_unique<Layout>();
  layout->name = std::move(name);
  layout->unit = LengthUnit::metre;
  if (container) layout->container = container_of(*container);
  layout->boxes.reserve(boxes.size());
  for (const BoxParts& box : boxes) layout->boxes.push_back(box_of(box));
  return layout;
}

/// Layout, name, container and boxes.
py::tuple taken_apart(Layout layout) {
  std::optional<ContainerParts> container;
  if (layout.container) container = parts_of(*layout.container);
  std::vector<BoxParts> boxes;
  boxes.reserve(layout.boxes.size());
  for (const Box& box : layout.boxes) boxes.push_back(parts_of(box));
  const std::string name = layout.name;
  return py::make_tuple(std::make_unique<Layout>(std::move(layout)), name, container, boxes);
}

/// All loads, taken apart, and what is to be known of them.
template <class Read>
py::tuple read(Read&& read_with) {
  std::vector<Problem> notes;
  std::vector<Layout> layouts;
  {
    const py::gil_scoped_release released;
    layouts = read_with(&notes);
  }
  py::list loads;
  for (Layout& layout : layouts) loads.append(taken_apart(std::move(layout)));
  return py::make_tuple(loads, problems_of(notes));
}

LoadFileOptions options_of(std::optional<std::string> unit, std::optional<std::string> axes,
                           std::optional<std::string> format, std::optional<std::string> columns,
                           std::optional<std::string> container, std::string config) {
  return {.unit = std::move(unit),
          .axes = std::move(axes),
          .format = std::move(format),
          .columns = std::move(columns),
          .container = std::move(container),
          .config = std::move(config)};
}

}  // namespace

void declare_loads(py::module_& module) {
  py::class_<Layout>(module, "Load").def(py::init(&made), py::arg("name"), py::arg("container"), py::arg("boxes"));
  module.def(
      "read_loads",
      [](const std::string& path, std::optional<std::string> unit, std::optional<std::string> axes,
         std::optional<std::string> format, std::optional<std::string> columns, std::optional<std::string> container,
         std::string config) {
        const LoadFileOptions options = options_of(std::move(unit), std::move(axes), std::move(format),
                                                   std::move(columns), std::move(container), std::move(config));
        return read([&](std::vector<Problem>* notes) { return read_loads(path, options, notes); });
      },
      py::arg("path"), py::kw_only(), py::arg("unit"), py::arg("axes"), py::arg("format"), py::arg("columns"),
      py::arg("container"), py::arg("config"));
  module.def(
      "parse_loads",
      [](const std::string& text, const std::string& name, std::optional<std::string> unit,
         std::optional<std::string> axes, std::optional<std::string> format, std::optional<std::string> columns,
         std::optional<std::string> container, std::string config) {
        const LoadFileOptions options = options_of(std::move(unit), std::move(axes), std::move(format),
                                                   std::move(columns), std::move(container), std::move(config));
        return read([&](std::vector<Problem>* notes) { return parse_loads(text, name, options, notes); });
      },
      py::arg("text"), py::arg("name"), py::kw_only(), py::arg("unit"), py::arg("axes"), py::arg("format"),
      py::arg("columns"), py::arg("container"), py::arg("config"));
  module.def("container_types", [] {
    py::list all;
    for (const ContainerType& type : container_types())
      all.append(py::make_tuple(type.name, type.sentence, py::tuple(py::cast(type.size)), type.payload,
                                py::tuple(py::cast(type.open_sides)), type.bed_height));
    return all;
  });
}

const Layout* layout_of_load(const py::handle& object, py::object& keeper) {
  constexpr const char* kKept = "_as_core";
  if (!py::hasattr(object, kKept)) return nullptr;
  keeper = object.attr(kKept)();
  return keeper.cast<const Layout*>();
}

}  // namespace holdfast::python
