#include "core/engine/engine_support.hpp"

#include <algorithm>

namespace holdfast::internal {

namespace {

std::optional<Error> why_one_friction(const Engine& engine) {
  if (engine.traits().has_kinetic_friction) return std::nullopt;
  return Error{.what = "this engine has one friction coefficient for what sticks and what slides",
               .value = engine.traits().name,
               .accepted = "KineticFriction = 1 in [Contact], or the engine native"};
}

std::optional<Error> why_no_wall_forces(const Engine& engine) {
  if (engine.traits().measures_walls) return std::nullopt;
  return Error{.what = "wall forces are not measured by this engine, or not with this motion of the container",
               .value = engine.traits().name,
               .accepted = "leave wall forces out, or take native, bullet or bullet-f64 with Motion = prescribed"};
}

}  // namespace

std::optional<Error> why_unsupported(const Engine& engine, const Settings& settings) {
  if (settings.contact.kinetic_friction != 1.0)
    if (auto error = why_one_friction(engine)) return error;
  if (settings.screening.measures_walls())
    if (auto error = why_no_wall_forces(engine)) return error;
  return std::nullopt;
}

std::optional<Error> refuse_unsupported(ReadLayout& layout, const Engine& engine, const std::string& label) {
  std::vector<Box>& boxes = layout.layout.boxes;
  const auto on_mat = std::find_if(boxes.begin(), boxes.end(), [](const Box& box) { return box.mat.has_value(); });
  if (engine.traits().has_mats || on_mat == boxes.end()) return std::nullopt;
  Error error{.file = label,
              .line = on_mat->line,
              .what = "a box stands on an anti-slip mat, which this engine cannot model",
              .value = engine.traits().name,
              .accepted = "boxes without mats, or another engine, such as native",
              .box = on_mat - boxes.begin() + 1};
  boxes.clear();
  layout.error = error.message();
  return error;
}

}  // namespace holdfast::internal
