#pragma once

#include "core/engine/recorder.hpp"

namespace holdfast::internal {

/// Whether a step is one of the load's settling. A recorder that has seen one belongs to a world that was never
/// accelerated, since recorders are made anew at t = 0: what it has recorded says nothing of the acceleration.
inline bool is_of_settling(const Step& step) { return step.begin < 0.0; }

}  // namespace holdfast::internal
