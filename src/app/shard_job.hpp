#pragma once

#include <vector>

#include "app/screening.hpp"
#include "core/base/result.hpp"
#include "core/engine/run_inputs.hpp"

namespace holdfast::internal {

/// The job of the shard that `whole.part` chooses: its layouts, and its results file, whose folder is made.
Result<ScreeningJob> shard_job(const ScreeningJob& whole, const std::vector<ReadAcceleration>& accelerations);

}  // namespace holdfast::internal
