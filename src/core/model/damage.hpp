#pragma once

#include <cstdint>
#include <vector>

#include "core/model/margin.hpp"
#include "core/model/settings.hpp"
#include "core/model/status.hpp"

namespace holdfast::internal {

/// What a box withstands: it is damaged by an impact that exceeds both numbers (Newton 1968, ASTM D3332).
struct DamageBoundary {
  double acceleration = 0.0;     ///< m/s²
  double velocity_change = 0.0;  ///< m/s
};

inline DamageBoundary damage_boundary(const ScreeningSettings& screening) {
  return {screening.critical_acceleration * kStandardGravity, screening.critical_velocity_change};
}

/// An impact is a row of steps in each of which the mean acceleration of a box is larger than gravity and the container
/// together by this factor. A box that is carried, slides or falls freely stays below 1. Smaller: rounding and the turn
/// of a tipping box count as impacts. Larger: weak impacts are missed, those below (g + a) h times this.
inline constexpr double kImpactFactor = 1.5;

/// What the boxes of a world had to bear, one entry per box. Empty where it was not asked for, or the world was not
/// simulated.
struct BoxDamage {
  std::vector<float> peak_acceleration;  ///< largest mean over the window, in a frame at rest, m/s²
  std::vector<float> velocity_change;    ///< largest in an impact, m/s
  std::vector<std::uint8_t> beyond;      ///< 1 when both are above the damage boundary, else 0
};

/// The same of a whole world.
struct WorldDamage {
  std::uint32_t boxes_beyond = kNotCounted;  ///< boxes beyond the damage boundary
  BoxDamage boxes;

  bool known() const { return boxes_beyond != kNotCounted; }
};

}  // namespace holdfast::internal
