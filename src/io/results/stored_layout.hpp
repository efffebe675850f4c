#pragma once

#include <cstdint>

#include "core/base/result.hpp"
#include "core/model/layout.hpp"
#include "core/model/settings.hpp"
#include "io/results/results_reader.hpp"

namespace holdfast::internal {

/// The boxes of a layout as its results file keeps them. Files of earlier versions do not have all that boxes may have.
/// @param layout its index in the file
Result<Layout> stored_layout(ResultsReader& results, std::uint64_t layout);

/// What the settings of a run say of the boxes of materials: masses, centres of mass and which are fixed. All else is
/// as by default.
Result<Settings> stored_materials(ResultsReader& results);

}  // namespace holdfast::internal
