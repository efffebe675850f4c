#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "core/native/bodies.hpp"
#include "core/native/collision/manifold.hpp"
#include "core/native/constants.hpp"
#include "core/native/known_balances.hpp"
#include "core/native/side_forces.hpp"
#include "core/native/sinking.hpp"

namespace holdfast::internal::native {

/// Everything that islands of a world share.
struct Scene {
  Bodies bodies;
  std::vector<Side> sides;
  std::vector<Manifold> manifolds;
  /// Manifolds as they were before an event within the step updated them, to take the step again.
  std::vector<std::pair<std::uint32_t, Manifold>> undo;
  Sinking sinking;  ///< since contacts were found, at the end of the last step
  KnownBalances balances;
  SideForces side_forces;
};

/// The boxes of a world at the state of the batch, and the sides of its container. Has no contacts.
Scene scene_of(const WorldBatch& batch, const World& world, const Settings& settings);

/// The floor of the container; null where it has none.
const Side* floor_of(const Scene& scene);

/// Bodies that are solved together, with the manifolds inside: those whose ends are among the bodies or fixed.
struct IslandView {
  std::span<const std::uint32_t> bodies;
  std::span<const std::uint32_t> manifolds;
};

/// What holds for all islands in a step.
struct StepTerms {
  double step = 0.0;                      ///< s
  double longest_step = 0.0;              ///< that any step may have, s: contacts are found for it
  Vec3 effective_gravity = Vec3::Zero();  ///< gravity minus the container's acceleration, g − a, m/s²
  Vec3 gravity_change = Vec3::Zero();     ///< by which g − a has changed last, m/s²
  double velocity_unit = 0.0;             ///< |g − a| · step: what tolerances are measured in, m/s
  double changed = -std::numeric_limits<double>::infinity();  ///< time of the last change of g − a, s
  bool changes_on = false;                                    ///< the change before it was within `kToAndFro` of it
  bool to_and_fro = false;                                    ///< g − a has changed within `kToAndFro`
  bool reset_warm_start = false;  ///< of an island: g − a has just changed, and its last step is no guess
  bool implicit = false;          ///< of an island: its step is one of implicit Euler, since a solve of it has failed
  bool refuted = false;           ///< of an island: its proof of rest has failed in this step
  double fall_margin = 0.0;  ///< what the strongest g − a that contacts are found for moves a body by in a step, m

  void set_step(double length) {
    step = length;
    velocity_unit = effective_gravity.norm() * length;
  }

  /// Whether g − a has changed, and before that too, within `kToAndFro` each.
  bool oscillates() const { return to_and_fro && changes_on; }

  /// Slip that friction does not end within a part of the step, m/s. Where g − a oscillates, slips that turn cut steps:
  /// a part counts alone.
  /// @param length of the part, s
  double lasting_slip(double length) const {
    return kLarge * effective_gravity.norm() * (oscillates() ? length : step);
  }
};

}  // namespace holdfast::internal::native
