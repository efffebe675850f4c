#pragma once

#include <vector>

#include "validate/laboratory/case.hpp"

namespace holdfast::internal {

/// A part of the suite `slide`: loads of unlike boxes, with mats, materials, masses and containers of their own.
std::vector<Case> mixed_load_cases();

}  // namespace holdfast::internal
