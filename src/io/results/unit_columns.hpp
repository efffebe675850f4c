#pragma once

#include "io/results/results_columns.hpp"
#include "io/results/results_writer.hpp"
#include "io/results/run_description.hpp"

namespace holdfast::internal {

/// Everything that the results file keeps of a unit, an entry of the columns each; the worlds' series are moved there.
/// Indices count in the run.
/// @param end entries of the run before the unit; afterwards, with it
ColumnSet columns_of(UnitRecord& unit, const RunDescription& run, AxisCounts& end);

}  // namespace holdfast::internal
