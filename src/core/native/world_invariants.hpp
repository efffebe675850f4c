#pragma once

#include <string>
#include <vector>

#include "core/native/collision/pair_table.hpp"
#include "core/native/connectivity.hpp"
#include "core/native/scene.hpp"

namespace holdfast::internal::native {

/// What a world consists of between two steps.
struct WorldView {
  const Scene& scene;
  const PairTable& pairs;
  const Connectivity& islands;  ///< of the last step
};

/// Whether the state of every body is finite.
bool has_finite_state(const WorldView& world);

/// What does not hold of a world although it has to between two steps, a sentence each: pairs and manifolds belong to
/// each other, every number is finite, no cached normal force pulls, islands hold both ends of every
/// active contact, and boxes at rest have no velocity.
std::vector<std::string> broken_invariants(const WorldView& world);

}  // namespace holdfast::internal::native
