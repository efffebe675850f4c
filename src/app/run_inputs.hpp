#pragma once

#include <string>
#include <vector>

#include "app/screening.hpp"
#include "app/screening/unit_runner.hpp"
#include "io/results/run_description.hpp"

namespace holdfast {

/// What results call an input.
std::string input_name(const std::string& path);

/// Says so where inputs share a file name, by which alone results tell them apart.
void warn_of_same_names(const std::vector<std::string>& paths);

/// Reads the accelerations of a run. What is wrong with one is told, and becomes the message of its worlds.
std::vector<RunAcceleration> read_accelerations(const ScreeningJob& job);

/// What the results file is to say about the run.
RunDescription describe_run(const ScreeningJob& job, const std::vector<RunAcceleration>& accelerations,
                            std::vector<std::string> layout_hashes);

}  // namespace holdfast
