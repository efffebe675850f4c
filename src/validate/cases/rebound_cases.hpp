#pragma once

#include <vector>

#include "validate/laboratory/case.hpp"

namespace holdfast::internal {

/// Parts of the suite `rebound`.
std::vector<Case> wall_cases();     ///< a box hits a wall
std::vector<Case> meeting_cases();  ///< boxes hit boxes
std::vector<Case> landing_cases();  ///< boxes fall onto the floor
std::vector<Case> rocking_cases();  ///< boxes rock, and overturn at kerbs

}  // namespace holdfast::internal
