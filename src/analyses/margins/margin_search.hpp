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
/// by up to +0.64 g: there a load shifts by 5 to 10 mm and finds its hold. Margins within the limits do not change.
inline constexpr double kMarginDisplacement = 0.005;

/// Largest acceleration that is tried, g: more than any norm asks for. It is where the search begins, too, and where a
/// load shifts that decides which edge is found: of the same 140 margins of each kind, where they are smaller, half of
/// it changes none by more than 0.02 g, and twice of it one, by +0.115 g.
inline constexpr double kLargestMargin = 1.5;

/// Margins are whole numbers of 1/200 g, and one unit above the layout does not hold. So what norms ask for is tried
/// itself, and a load that just holds 0.5 g has that margin. Units half as large take 1.16 of the time and change one
/// of the same 140 margins in place by more than 0.02 g, by +0.023 g, and none within the limits. Twice as large ones
/// take 0.86 of the time and change 1 and 2, by up to 0.1 g.
inline constexpr double kMarginUnits = 200.0;

/// Shares of a margin that are tried once it is found: a load that shifts may hold it, and not a smaller one. The
/// search goes on below one that does not hold. Without them 5 of 1,024 worlds at 0.3 to 0.97 of the margins within
/// the limits of 32 layouts do not hold at `standard`, with them 1; they take 8 % of the time (bench/margin_check.py).
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
/// to tip, moves with a constant share of what a is above it, the sliding box with all of it. The first trial that does
/// not hold is taken for that of a sliding box, and two give the share. The next trial is where their line vanishes,
/// rounded down to a whole unit. Above one that holds, which mostly takes next to no time, the distances double until
/// one does not hold. What is tried for the one margin counts for the other.
/// @param engine made from the settings; must rewind, see `EngineTraits`
/// @param abort  checked after every step
/// @return nothing when aborted
std::optional<LayoutMargins> find_margins(const Engine& engine, const Layout& layout, const Settings& settings,
                                          const std::atomic<bool>& abort);

/// The margins of one direction; the others are not known, unless the load is unstable.
std::optional<LayoutMargins> find_margin(std::size_t direction, const Engine& engine, const Layout& layout,
                                         const Settings& settings, const std::atomic<bool>& abort);

}  // namespace holdfast::internal
