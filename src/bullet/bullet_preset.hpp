#pragma once

#include <string_view>

#include "core/model/settings.hpp"

namespace holdfast::internal {

/// All options of Bullet's solver.
struct BulletPreset {
  double steps_per_second = 240.0;  ///< 1/s
  int iterations = 50;              ///< of the contact solver, per step
  int friction_directions = 2;      ///< per contact point
  bool random_order = true;         ///< whether each iteration visits the constraints in a new random order
  bool split_impulse = true;        ///< whether positions are corrected separately from velocities
  double split_impulse_threshold =
      -0.04;                          ///< m; for contacts with a smaller distance. Default of Bullet: practically never
  double erp = 0.2;                   ///< fraction of a penetration corrected per step through the velocity
  double erp2 = 0.2;                  ///< the same by split impulse
  double warm_start = 0.85;           ///< fraction of the last step's impulses that the solver starts from
  double linear_slop = 0.0;           ///< penetration slop, m
  double restitution_velocity = 0.2;  ///< approach speed below which there is no rebound, m/s
  BulletSleeping sleeping = BulletSleeping::off;
};

/// The preset of an engine, overridden by the settings: `bullet` and `bullet-f64` have the best practical values,
/// `bullet-stock` has Bullet's defaults.
BulletPreset bullet_preset(std::string_view engine, const Settings& settings);

}  // namespace holdfast::internal
