#pragma once

#include <vector>

#include "core/model/layout.hpp"
#include "core/model/settings.hpp"

namespace holdfast::internal {

/// How a box of a load at rest is held up.
enum class Footing {
  stands,       ///< by vertical forces alone; fixed boxes too
  tips,         ///< it begins to move when nothing but vertical forces act
  unsupported,  ///< nothing is beneath it
};

/// What rests on a box, as far as statics says: docs/guide/bearing.md.
struct BearingRange {
  double least = 0.0;    ///< over all equilibria, kg; NaN where the search ends without an answer
  double largest = 0.0;  ///< the same
  Footing footing = Footing::stands;
};

/// Loads up to this above a limit are within it, kg: far more than the search is inexact by, and nothing to cargo.
inline constexpr double kBearingTolerance = 1e-3;

/// The load on every box at rest: the least and the largest total force on its top, over g, among all distributions of
/// vertical forces in its contacts that balance every box. Sides carry nothing. A box that tips counts as held upright
/// by a pure moment, and one that is unsupported as held where it is.
std::vector<BearingRange> find_bearing(const Layout& layout, const Settings& settings);

}  // namespace holdfast::internal
