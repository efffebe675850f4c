#pragma once

#include <utility>
#include <vector>

#include "core/native/island/island_stepper.hpp"
#include "core/native/world_state.hpp"
#include "scenes.hpp"

/// What the tests of the rooms of the native engine share: the parts of a world, without the world.
namespace holdfast::internal::native_scenes {

struct SmallWorld {
  Settings settings;
  Layout layout;
  Acceleration acceleration = scenes::constant(10.0, 1.0);
  const Acceleration* pointer = &acceleration;
  WorldBatch batch;
  native::NativeOptions options;
  native::WorldState state;
  native::IslandStepper stepper;

  SmallWorld(const Settings& given, Layout boxes)
      : settings(given),
        layout(std::move(boxes)),
        batch(scenes::batch_of(std::span(&layout, 1), std::span(&pointer, 1), settings)),
        options(native::native_options(settings)),
        state(native::state_of(batch, batch.worlds.front(), settings, options)),
        stepper(options) {
    state.begin();
    act(Vec3::Zero(), state.terms.longest_step);
  }
  SmallWorld(const SmallWorld&) = delete;
  SmallWorld& operator=(const SmallWorld&) = delete;

  native::Bodies& bodies() { return state.scene.bodies; }

  /// Sets the acceleration of the container in the steps to come, m/s², and their length, s.
  native::Change act(const Vec3& motion, double step) {
    const Vec3 effective_gravity = Vec3(0, 0, -settings.gravity) - motion;
    const native::Change change = state.rest.note(bodies(), state.terms, effective_gravity, false);
    state.terms.effective_gravity = effective_gravity;
    state.terms.set_step(step);
    return change;
  }

  /// Moves a body, and finds the contacts anew.
  void put(std::size_t body, const Vec3& shift) {
    bodies().state.position[body] += shift;
    bodies().update_shape(body);
    std::vector<std::uint8_t> moved(bodies().count(), 0);
    moved[body] = 1;
    state.find_contacts(moved);
  }

  /// The contact of a body with another or, with a negative number, with side −1 − a; null where there is none.
  native::Manifold* contact(std::int32_t a, std::int32_t b) {
    const std::int32_t index = state.contacts.pairs().find(a, b);
    return index < 0 ? nullptr : &state.scene.manifolds[static_cast<std::size_t>(index)];
  }

  /// The same with the floor.
  native::Manifold* on_floor(std::int32_t b) {
    const native::Side* const floor = native::floor_of(state.scene);
    return contact(static_cast<std::int32_t>(state.scene.sides.data() - floor) - 1, b);
  }
};

}  // namespace holdfast::internal::native_scenes
