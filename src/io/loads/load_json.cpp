#include "io/loads/load_json.hpp"

#include <nlohmann/json.hpp>

namespace holdfast::internal {

namespace {

using Json = nlohmann::ordered_json;

Json vector_json(const Vec3& v) { return Json::array({v.x(), v.y(), v.z()}); }

Json material_json(const MaterialName& material) {
  return material.is_number() ? Json(material.id()) : Json(material.text());
}

Json box_json(const Box& box) {
  Json json;
  json["corner_min"] = vector_json(box.corner_min);
  json["corner_max"] = vector_json(box.corner_max);
  if (!box.name.empty()) json["name"] = box.name;
  json["material"] = material_json(box.material);
  if (box.mass) json["mass"] = *box.mass;
  if (box.centre_of_mass) json["centre_of_mass"] = vector_json(*box.centre_of_mass);
  if (box.mat) json["mat"] = *box.mat;
  if (box.fixed) json["fixed"] = true;
  if (box.order) json["order"] = *box.order;
  if (box.bearing_limit) json["bearing_limit"] = *box.bearing_limit;
  return json;
}

Json container_json(const ContainerShape& shape) {
  Json json;
  if (!shape.type.empty()) json["type"] = shape.type;
  json["size"] = vector_json(shape.size);
  json["open_sides"] = shape.open_sides;
  Json drops = Json::object();
  for (const DropSide& drop : shape.drop_sides) drops[drop.side] = drop.height;
  if (!drops.empty()) json["drop_sides"] = drops;
  json["bed_height"] = shape.bed_height;
  return json;
}

Json load_json(const Layout& load, bool with_name) {
  Json json;
  if (with_name) json["name"] = load.name;
  if (load.container) json["container"] = container_json(*load.container);
  Json boxes = Json::array();
  for (const Box& box : load.boxes) boxes.push_back(box_json(box));
  json["boxes"] = std::move(boxes);
  return json;
}

std::string text_of(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

}  // namespace

std::string canonical_json(const Layout& load) { return text_of(load_json(load, false)); }

std::string load_line(const Layout& load) { return text_of(load_json(load, true)); }

}  // namespace holdfast::internal
