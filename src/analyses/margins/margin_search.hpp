#pragma once

#include <array>
#include <atomic>
#include <optional>

#include "analyses/margins/margins.hpp"
#include "core/engine/engine.hpp"
#include "core/model/layout.hpp"
#include "core/model/settings.hpp"

namespace holdfast::internal {

/// A box that is displaced by more than this is no longer in its place, m. It tells a load that shifts from one that
/// closes the millimetres between its boxes.
inline constexpr double kMarginDisplacement = 0.005;

/// Largest acceleration that is tried, g: more than any norm asks for.
inline constexpr double kLargestMargin = 1.5;

/// A margin is this exact, g: at this much more the layout does not hold.
inline constexpr double kMarginWidth = 0.005;

/// Shares of a margin that are tried once it is found: a load that shifts may hold it, and not a smaller one. The
/// search goes on below one that does not hold. Without them 15 of 1,024 worlds at 0.3 to 0.97 of the margins within
/// the limits of 34 layouts do not hold at `standard`, with them 5; the time is the same within 3 %.
inline constexpr std::array kMarginChecks = {0.95, 0.75};

/// How long an acceleration lasts that a load is still moving under, s.
inline constexpr double kMarginDuration = 5.0;

/// Finds the margins of a layout: in each of `kMarginDirections` the end of the interval from 0 in which every constant
/// acceleration that is tried keeps all boxes in their places, and that in which it keeps them within the limits. It is
/// applied at once to the load as it has settled, and lasts until all boxes rest, or for `kMarginDuration`; up to
/// `kLargestMargin`, to `kMarginWidth`. Displacement, drop and tilt are from the settled pose.
///
/// A load that holds a small acceleration and not a large one has an acceleration between at which that changes, and it
/// is found by a secant method inside a bracket. A box that leaves under the acceleration a by the distance s within
/// the time t moves with 2 s/t² on the average, and that vanishes at the margin: a box that slides, and one that begins
/// to tip, moves with a constant share of what a is above it, the sliding box with all of it. So the next trial is at
/// a − 2 s/t², and mostly the second or third is within the width. What is tried for the one margin counts for the
/// other.
/// @param engine made from the settings; must rewind, see `EngineTraits`
/// @param abort  checked after every step
/// @return nothing when aborted
std::optional<LayoutMargins> find_margins(const Engine& engine, const Layout& layout, const Settings& settings,
                                          const std::atomic<bool>& abort);

}  // namespace holdfast::internal
