#pragma once

#include "core/native/connectivity.hpp"
#include "core/native/contacts.hpp"
#include "core/native/native_options.hpp"
#include "core/native/rest_decision.hpp"
#include "core/native/scene.hpp"
#include "core/native/sleeping_bodies.hpp"

namespace holdfast::internal::native {

/// Everything that the steps of a world from a time on depend on.
struct WorldState {
  Scene scene;
  StepTerms terms;
  Contacts contacts;
  Connectivity islands;  ///< of the last step
  SleepingBodies sleeping;
  RestDecision rest;

  /// Finds all contacts and islands; what stands on something is in contact with it.
  void begin();

  /// Finds the contacts of bodies that have moved.
  /// @param moved a body: not 0 where it has moved
  void find_contacts(const std::vector<std::uint8_t>& moved) { contacts.find(scene, terms, islands, moved); }
  void find_islands() { islands.find(scene.bodies, scene.manifolds); }
};

/// A world as the batch has it, before `begin`.
WorldState state_of(const WorldBatch& batch, const World& world, const Settings& settings,
                    const NativeOptions& options);

/// What an acceleration in the worst direction moves a body by in a step, m.
/// @param acceleration m/s²
inline double fall_in_step(const StepTerms& terms, double acceleration) {
  return terms.longest_step * terms.longest_step * acceleration;
}

}  // namespace holdfast::internal::native
