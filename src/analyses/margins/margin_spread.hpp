#pragma once

#include <atomic>
#include <optional>

#include "analyses/margins/margins.hpp"
#include "core/engine/engine.hpp"
#include "core/model/layout.hpp"
#include "core/model/settings.hpp"

namespace holdfast::internal {

/// Shares of the replicas whose margins are below what `MarginSpread` tells.
inline constexpr double kLowShare = 0.05;
inline constexpr double kHighShare = 0.95;

/// Finds the margins of every replica of a layout, see `find_margins`: the friction and the places of boxes are those
/// of the replica. Each direction is taken for itself. Between two replicas the quantile is interpolated (definition 7
/// of Hyndman and Fan 1996, which numpy and R use too).
/// @param settings `screening.replicas` of them
/// @return nothing when aborted
std::optional<MarginSpread> find_margin_spread(const Engine& engine, const Layout& layout, const Settings& settings,
                                               const std::atomic<bool>& abort);

}  // namespace holdfast::internal
