#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/screening.hpp"
#include "core/engine/run_inputs.hpp"
#include "io/results/run_description.hpp"

namespace holdfast::internal {

/// What results call an input.
std::string input_name(const std::string& path);

/// Says so where inputs share a file name, by which alone results tell them apart.
void warn_of_same_names(const std::vector<std::string>& paths);

/// The warning of an acceleration under which a world takes so many steps that they take minutes, if it does.
/// @param label what messages call the acceleration
/// @param steps_per_second of the engine, 1/s
std::optional<Error> many_steps_warning(const std::string& label, const Acceleration& acceleration,
                                        const Settings& settings, double steps_per_second);

/// The accelerations of a run: those of its norm, and those of its files. What is wrong with one is reported, and
/// becomes the message of its worlds. A warning says where a world takes very many steps.
/// @param steps_per_second of the engine, 1/s
std::vector<ReadAcceleration> read_accelerations(const ScreeningJob& job, double steps_per_second);

/// What the results file says about the run.
RunDescription describe_run(const ScreeningJob& job, const LayoutFiles& layouts,
                            const std::vector<ReadAcceleration>& accelerations);

}  // namespace holdfast::internal
