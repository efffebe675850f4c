#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/model/layout.hpp"
#include "core/model/settings.hpp"

namespace holdfast::internal {

/// How far a box can be shifted from its place, m, not negative: along and across the container, each towards its
/// smaller and its larger coordinates.
struct BoxPlay {
  std::array<double, 2> back = {};
  std::array<double, 2> forth = {};
};

/// The play of every box of a layout: at most `largest`, to the walls of the container (its open sides too, so that no
/// box is loaded outside), and half of the gap to every neighbour. Boxes that are shifted within their play, each on
/// its own, do not overlap where they did not before: of each two that are apart along or across the container, the gap
/// on the axis on which it is larger stays open. Two that are above each other stay so, and are not kept apart.
/// @param largest m
/// Boxes that are fixed to the container have no play, and leave their neighbours all of the gap.
std::vector<BoxPlay> play_of(const Layout& layout, const Settings& settings, double largest);

/// The layout with every box shifted within its play, uniformly and independently: a function of its arguments alone,
/// with the same bits on every machine.
/// @param boxes  `boxes_hash` of the layout
/// @param number of the replica, from 1
Layout shifted_layout(const Layout& layout, const std::vector<BoxPlay>& play, std::uint64_t boxes,
                      std::uint32_t number);

}  // namespace holdfast::internal
