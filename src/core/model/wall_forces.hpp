#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "core/model/side_impulse.hpp"

namespace holdfast::internal {

/// What the boxes of a world did to the sides of the container; one entry per side, in the order of `kContainerSides`.
/// Forces are along the side's outward normal. NaN where they were not asked for, or the world was not simulated.
struct WallForces {
  std::array<double, kSideCount> peak_force = filled(kUnknown);  ///< largest mean over a step, N
  std::array<double, kSideCount> peak_time = filled(kUnknown);   ///< start of that step, s
  /// Centre of pressure in that step, m; NaN where nothing pressed the side.
  std::array<Vec3, kSideCount> peak_point = filled(Vec3(kUnknown, kUnknown, kUnknown));
  std::array<double, kSideCount> lasting_force = filled(kUnknown);  ///< largest mean over `kLastingSeconds`, N
  std::array<Vec3, kSideCount> impulse = filled(Vec3(kUnknown, kUnknown, kUnknown));  ///< from t = 0 on, N s
  std::array<double, kSideCount> limit = filled(kUnknown);  ///< of the norm; NaN where it has none, N

  bool known() const { return !std::isnan(peak_force[0]); }

  /// Lasting force over limit; NaN where there is no limit.
  double share_of_limit(std::size_t side) const { return lasting_force.at(side) / limit.at(side); }

  /// Whether the lasting force is larger than the limit.
  bool exceeds(std::size_t side) const { return share_of_limit(side) > 1.0; }

 private:
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  template <class Entry>
  static std::array<Entry, kSideCount> filled(const Entry& value) {
    return {value, value, value, value, value, value};
  }
};

/// Time over which a force has to act to count against a limit, s. A rigid box hits a rigid wall in no time, so that
/// the mean over a step of an impact grows as steps get shorter; the mean over a time that holds several steps does
/// not. EUMOS 40509 lets an acceleration build up for as long: what is over sooner is no acting force.
inline constexpr double kLastingSeconds = 0.05;

}  // namespace holdfast::internal
