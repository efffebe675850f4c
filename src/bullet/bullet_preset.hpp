#pragma once

#include <string_view>

#include "core/model/settings.hpp"

namespace holdfast::internal {

/// Bullet's solver, every choice made.
struct BulletPreset {
  double steps_per_second = 240.0;         ///< 1/s
  int iterations = 50;                     ///< of the contact solver, a step
  int friction_directions = 2;             ///< a contact point
  bool random_order = true;                ///< constraints in a new random order each iteration
  bool split_impulse = true;               ///< positions are corrected apart from velocities
  double split_impulse_threshold = -0.04;  ///< m; where the distance is below it, as shipped: practically never
  double erp = 0.2;                        ///< share of a penetration corrected a step through the velocity
  double erp2 = 0.2;                       ///< the same by split impulse
  double warm_start = 0.85;                ///< share of last step's impulses to start from
  double linear_slop = 0.0;                ///< penetration left alone, m
  double restitution_velocity = 0.2;       ///< approach speed below which there is no rebound, m/s
  BulletSleeping sleeping = BulletSleeping::off;
};

/// The preset that an engine's name stands for, with what the settings say in its place: `bullet` and
/// `bullet-f64` are the best practical setting, `bullet-stock` is Bullet as shipped.
BulletPreset bullet_preset(std::string_view engine, const Settings& settings);

}  // namespace holdfast::internal
