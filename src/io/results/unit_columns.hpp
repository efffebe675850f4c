#pragma once

#include "io/results/results_columns.hpp"
#include "io/results/results_writer.hpp"
#include "io/results/run_description.hpp"

namespace holdfast::internal {

/// The entries of a unit in all columns of the results file; the series are moved out of the worlds. Indices are those
/// of the whole run.
/// @param end entries of the run before the unit; afterwards, including the unit
ColumnSet columns_of(UnitRecord& unit, const RunDescription& run, AxisCounts& end);

}  // namespace holdfast::internal
