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
/// closes the millimetres between its boxes. Half of it changes none of the 140 margins in place of the 35 layouts of
/// configs/layouts, bench/layouts and bench/layouts_unstable by more than 0.02 g at `screening`. Twice of it changes 4,
/// by up to +0.43 g: there a load shifts by 5 to 10 mm and finds its hold. Margins within the limits change by 0.011 g
/// at most.
inline constexpr double kMarginDisplacement = 0.005;

/// Largest acceleration that is tried, g: more than any norm asks for. It is where the search begins, too, and where a
/// load shifts that decides which edge is found: half and twice of it change one of the same 140 margins within the
/// limits by more than 0.02 g, by +0.03 and +0.11 g, and in place none and one, by −0.06 g.
inline constexpr double kLargestMargin = 1.5;

/// Margins are whole numbers of 1/200 g, and one unit above the layout does not hold. So what norms ask for is tried
/// itself, and a load that just holds 0.5 g has that margin. Units half as large take 1.10 of the time and change one
/// of the same 140 margins in place by more than 0.02 g, by −0.02 g, and 3 within the limits, by up to +0.045 g. Twice
/// as large ones take 0.81 of the time and change 2 and 4, by up to 0.03 g.
inline constexpr double kMarginUnits = 200.0;

/// Shares of a margin that are tried once it is found: a load that shifts may hold it, and not a smaller one. The
/// search goes on below one that does not hold. Without them 15 of 1,024 worlds at 0.3 to 0.97 of the margins within
/// the limits of 34 layouts do not hold at `standard`, with them 5; the time is the same within 3 %.
inline constexpr std::array kMarginChecks = {0.95, 0.75};

/// How long an acceleration lasts that a load is still moving under, s. Half and twice of it change none of the same
/// margins by more than 0.005 g: a load that goes beyond a limit has done so by then.
inline constexpr double kMarginDuration = 5.0;

/// Finds the margins of a layout: in each of `kMarginDirections` the end of the interval from 0 in which every constant
/// acceleration that is tried keeps all boxes in their places, and that in which it keeps them within the limits. It is
/// applied at once to the load as it has settled, and lasts until all boxes rest, or for `kMarginDuration`; up to
/// `kLargestMargin`, in units of 1 / `kMarginUnits`. Displacement, drop and tilt are from the settled pose.
///
/// A load that holds a small acceleration and not a large one has an acceleration between at which that changes, and it
/// is found by a secant method inside a bracket. A box that leaves under the acceleration a by the distance s within
/// the time t moves with 2 s/t² on the average, and that vanishes at the margin: a box that slides, and one that begins
/// to tip, moves with a constant share of what a is above it, the sliding box with all of it. So the next trial is at
/// a − 2 s/t², rounded down to a whole unit, and mostly the second or third ends the search. What is tried for the one
/// margin counts for the other.
/// @param engine made from the settings; must rewind, see `EngineTraits`
/// @param abort  checked after every step
/// @return nothing when aborted
std::optional<LayoutMargins> find_margins(const Engine& engine, const Layout& layout, const Settings& settings,
                                          const std::atomic<bool>& abort);

}  // namespace holdfast::internal
