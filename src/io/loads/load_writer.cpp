#include "io/loads/load_writer.hpp"

#include <algorithm>
#include <set>

#include "core/base/number_text.hpp"
#include "core/base/utf8.hpp"
#include "core/model/container_catalogue.hpp"
#include "core/model/setting_kinds.hpp"
#include "io/export/csv_field.hpp"
#include "io/loads/load_json.hpp"

namespace holdfast::internal {

namespace {

/// The load's own name: what follows `#`, else that of the file.
std::string own_name(const Layout& load) {
  const std::size_t place = load.name.find('#');
  return place == std::string::npos ? load.name : load.name.substr(place + 1);
}

std::string json_text(const std::vector<Layout>& loads) {
  std::string text = "{\"holdfast\": 1}\n";
  for (Layout load : loads) {
    load.name = kept_name(own_name(load));
    text += load_line(load) + '\n';
  }
  return text;
}

std::string optional_text(const std::optional<double>& number) { return number ? number_text(*number) : ""; }

/// Whether the sides are those of the container's type, or closed where it has none, which is what a table tells. The
/// height of the floor matters where a box can get out.
bool has_sides_of_type(const ContainerShape& container) {
  const ContainerType* const type = find_container(container.type);
  const ContainerShape usual = type != nullptr ? type->shape() : ContainerShape{};
  const bool is_closed = container.open_sides.empty() && container.drop_sides.empty();
  return container.open_sides == usual.open_sides && container.drop_sides == usual.drop_sides &&
         (is_closed || container.bed_height == usual.bed_height);
}

Result<std::string> csv_text(const std::vector<Layout>& loads, const std::string& path) {
  std::string text =
      "load,name,x1 (m),y1 (m),z1 (m),x2 (m),y2 (m),z2 (m),material,mass (kg),mat,fixed,order,bearing limit (kg),"
      "container type,container length (m),container width (m),container height (m)\n";
  std::set<std::string> names;
  for (const Layout& load : loads) {
    if (!names.insert(own_name(load)).second)
      return Error{.file = path,
                   .what = "two loads have one name, by which a table tells them apart",
                   .value = own_name(load),
                   .accepted = "another name, or one of the file that ends with .json"};
    if (load.container && !has_sides_of_type(*load.container))
      return Error{.file = path,
                   .what =
                       "a table has no place for open sides, drop sides and a bed height that are not those of the "
                       "container's type",
                   .value = load.name,
                   .accepted = "a name that ends with .json"};
    for (const Box& box : load.boxes) {
      if (box.centre_of_mass)
        return Error{.file = path,
                     .what = "a table has no place for centres of mass",
                     .value = load.name,
                     .accepted = "a name that ends with .json"};
      text += csv_field(own_name(load)) + ',' + csv_field(box.name);
      for (const Vec3& corner : {box.corner_min, box.corner_max})
        for (const double number : corner) text += ',' + number_text(number);
      text += ',' + csv_field(box.material.text()) + ',' + optional_text(box.mass) + ',' + optional_text(box.mat) +
              ',' + (box.fixed ? "yes" : "") + ',' + (box.order ? std::to_string(*box.order) : "") + ',' +
              optional_text(box.bearing_limit) + ',';
      if (!load.container) {
        text += ",,,\n";
        continue;
      }
      text += load.container->type;
      for (const double number : load.container->size) text += ',' + number_text(number);
      text += '\n';
    }
  }
  return text;
}

Result<std::string> stable_cargo_text(const std::vector<Layout>& loads, const std::string& path) {
  const auto refuse = [&](const char* what) {
    return Error{.file = path, .what = what, .accepted = "a name that ends with .json or .csv"};
  };
  if (loads.size() != 1) return refuse("StableCargo's text has one load");
  const Layout& load = loads.front();
  if (load.container) return refuse("StableCargo's text has no container");
  std::string text = std::to_string(load.boxes.size()) + " boxes\n";
  for (const Box& box : load.boxes) {
    const bool has_more = box.mass || box.mat || box.fixed || box.order || box.bearing_limit || box.centre_of_mass ||
                          !box.name.empty() || !box.material.is_number();
    if (has_more) return refuse("StableCargo's text has corners and a number for the material, and nothing else");
    for (const Vec3& corner : {box.corner_min, box.corner_max})
      for (const double number : corner) text += setting_kinds::centimetre_text(number) + ' ';
    text += box.material.text() + '\n';
  }
  return text;
}

}  // namespace

Result<std::string> loads_text(const std::vector<Layout>& loads, const std::string& path) {
  if (path.ends_with(".json") || path.ends_with(".jsonl")) return json_text(loads);
  if (path.ends_with(".csv")) return csv_text(loads, path);
  if (path.ends_with(".txt")) return stable_cargo_text(loads, path);
  return Error{
      .file = path, .what = "the name does not say what to write", .accepted = "an end of .json, .csv or .txt"};
}

}  // namespace holdfast::internal
