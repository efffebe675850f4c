#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/screening.hpp"
#include "core/base/result.hpp"
#include "io/loads/load_choices.hpp"

namespace holdfast::internal {

/// Options that `screen` and `run` share; what is given stands in for the key of the same name.
struct RunOptions {
  LoadChoices loads;
  std::optional<std::string> norm;
  std::optional<std::string> engine;
  std::optional<std::string> accuracy;
  std::optional<int> threads;
  std::optional<std::string> scheduler;
  std::optional<std::string> stop_when;
  std::optional<std::string> text_folder;
  std::optional<std::string> costs_path;
  std::optional<std::string> replicas;
  std::optional<std::string> part;
  std::vector<std::string_view> analyses;  ///< keys of [Screening] that ask for them
  std::optional<std::string> walls;
  bool first_failure = false;
  bool no_series = false;
  bool resume = false;
  bool overwrite = false;
  bool json = false;
  bool quiet = false;

  /// Puts what was given into the job, or says what is wrong with it.
  /// @param config that the job's settings are from
  std::optional<Error> apply_to(ScreeningJob& job, const Config& config) const;

 private:
  std::optional<Error> apply_accuracy(Settings& settings) const;
};

}  // namespace holdfast::internal
