#pragma once

#include <cstddef>
#include <string>

#include "core/base/result.hpp"
#include "io/results/results_reader.hpp"

namespace holdfast::internal {

/// What rests on each box of the layouts of a results file that have bearing limits, as `check` finds it of their
/// files: an object of JSON with a list of pairs for each layout by its number from 0, the least and the largest load
/// of each box in kg. It is of the layouts that do not hold, and of the first ones that do while there are fewer than
/// `most` together.
Result<std::string> bearing_json(ResultsReader& results, std::size_t most);

}  // namespace holdfast::internal
