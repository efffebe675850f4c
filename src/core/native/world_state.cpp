#include "core/native/world_state.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/native/contact_kinematics.hpp"

namespace holdfast::internal::native {

namespace {

/// Steps per second that the thinnest upright box needs, 1/s; see `kThinSteps`.
double least_steps_per_second(const Bodies& bodies, double gravity) {
  double extent = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < bodies.count(); ++i)
    if (bodies.activity[i] != Activity::fixed)
      extent = std::min(extent, 2.0 * bodies.shape[i].half_extents.head<2>().minCoeff());
  return kThinSteps * std::sqrt(0.5 * gravity / extent);
}

}  // namespace

WorldState state_of(const WorldBatch& batch, const World& world, const Settings& settings,
                    const NativeOptions& options) {
  WorldState state{.scene = scene_of(batch, world, settings),
                   .terms = {},
                   .contacts = Contacts(world.contact, options.large_island.slop),
                   .islands = {},
                   .sleeping = SleepingBodies(world.box_count, options.rest_tolerance),
                   .rest = RestDecision(world.box_count)};
  Scene& scene = state.scene;
  state.terms.longest_step =
      1.0 / std::max(options.steps_per_second, least_steps_per_second(scene.bodies, settings.gravity));
  // Room for an acceleration of 1 g: where a stronger one comes, contacts are found anew.
  state.terms.fall_margin = fall_in_step(state.terms, 2.0 * settings.gravity);
  return state;
}

void WorldState::begin() {
  find_contacts(std::vector<std::uint8_t>(scene.bodies.count(), 1));
  for (Manifold& manifold : scene.manifolds) {
    const auto& points = manifold.contact.points;
    manifold.active = supports(scene.bodies, manifold) &&
                      std::any_of(points.begin(), points.begin() + manifold.contact.count,
                                  [](const ContactPoint& p) { return p.gap <= kContactTolerance; });
  }
  find_islands();
}

}  // namespace holdfast::internal::native
