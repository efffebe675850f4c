#pragma once

#include <atomic>
#include <optional>

#include "analyses/margins/margins.hpp"
#include "core/engine/engine.hpp"
#include "core/model/layout.hpp"
#include "core/model/settings.hpp"

namespace holdfast::internal {

// Constants of margins. What half and twice of them do: over the 136 margins of 34 bundled layouts at screening, time
// of all, and how many margins change by more than 0.01 g.

/// A box that is displaced by more than this has not held, m. It tells a load that shifts from one that closes the
/// millimetres between its boxes.
/// Half: 6 % less time, 1 margin. Twice: 16 % more, 6 margins, the largest change 0.77 g.
inline constexpr double kMarginDisplacement = 0.005;

/// Largest acceleration that is tried, g: more than any norm asks for.
inline constexpr double kLargestMargin = 1.5;

/// A margin is this exact, g: at this much more the layout does not hold.
/// Half: 18 % more time, no margin. Twice: no less time, 3 margins.
inline constexpr double kMarginWidth = 0.005;

/// How long a load may take to come to rest, s: at 1 mg above its margin a sliding box takes 1 s for 5 mm.
/// Half and twice: at most 3 % of the time, and 0.001 g.
inline constexpr double kMarginPatience = 2.0;

/// Finds the margins of a layout: in each of `kMarginDirections` the largest constant acceleration, applied at once to
/// the load at rest under gravity, under which all boxes come to rest again within `kMarginPatience`, displaced by less
/// than `kMarginDisplacement`; up to `kLargestMargin`, to `kMarginWidth`.
///
/// A load that holds a small acceleration and not a large one has an acceleration between at which that changes, and it
/// is found by a secant method inside a bracket. A box that leaves under the acceleration a by the distance s within
/// the time t moves with 2 s/t² on the average, and that vanishes at the margin: a box that slides, and one that begins
/// to tip, moves with a constant share of what a is above it, the sliding box with all of it. So the next trial is at
/// a − 2 s/t², and mostly the second or third is within the width.
/// @param engine made from the settings; must rewind, see `EngineTraits`
/// @param abort  checked after every step
/// @return nothing when aborted
std::optional<LayoutMargins> find_margins(const Engine& engine, const Layout& layout, const Settings& settings,
                                          const std::atomic<bool>& abort);

}  // namespace holdfast::internal
