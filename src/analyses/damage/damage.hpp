#pragma once

#include <cstdint>
#include <vector>

#include "core/base/result.hpp"
#include "core/model/push_direction.hpp"
#include "core/model/settings.hpp"
#include "core/model/status.hpp"
#include "io/results/results_schema.hpp"

namespace holdfast::internal {

struct Analysis;
class ResultsReader;

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

/// What impacts did to the boxes of a world. Not counted where the world was not accelerated: boxes then have
/// NaN, and there are none where it was not simulated.
struct WorldDamage {
  bool known() const { return boxes_beyond != kNotCounted; }

  std::uint32_t boxes_beyond = kNotCounted;  ///< boxes beyond the damage boundary
  std::vector<float> peak_acceleration;      ///< per box, largest mean over the window, in a frame at rest, m/s²
  std::vector<float> velocity_change;        ///< per box, largest in an impact, m/s
  std::vector<std::uint8_t> beyond;          ///< per box, 1 when both are above the damage boundary, else 0

  template <class Visit>
  static void describe(Visit&& visit) {
    visit(
        DatasetContent{
            "/damage/boxes_beyond", Axis::worlds, "1",
            "boxes beyond the damage boundary of the settings; 4294967295 in a world that was not accelerated"},
        &WorldDamage::boxes_beyond);
    visit(
        DatasetContent{
            "/damage/peak_acceleration", Axis::boxes, "m/s2",
            "largest acceleration of the centre of mass in a frame at rest, mean over DamageWindow; NaN in a world "
            "that was not accelerated; rows as in /boxes"},
        &WorldDamage::peak_acceleration);
    visit(
        DatasetContent{
            "/damage/velocity_change", Axis::boxes, "m/s",
            "largest change of its velocity in an impact; 0: no impact; NaN in a world that was not accelerated"},
        &WorldDamage::velocity_change);
    visit(DatasetContent{"/damage/beyond", Axis::boxes, "1",
                         "1 when peak_acceleration and velocity_change are both above the damage boundary, else 0"},
          &WorldDamage::beyond);
  }
};

/// The hardest impacts over the accelerations of each layout.
Result<std::string> damage_table(ResultsReader& results);

/// What impacts do to boxes: docs/guide/damage.md.
extern const Analysis kDamage;

}  // namespace holdfast::internal
