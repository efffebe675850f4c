#include "core/engine/engine_support.hpp"

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

}  // namespace holdfast::internal
