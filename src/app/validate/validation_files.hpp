#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "core/base/result.hpp"
#include "validate/laboratory/laboratory.hpp"
#include "validate/laboratory/measurement.hpp"

namespace holdfast::internal {

/// A measurement with what it was made on: a row of every table.
struct ValidationRow {
  std::string suite;
  std::string case_name;
  std::string engine;
  std::string setting;
  Measurement measurement;
  double cpu_seconds = 0.0;  ///< of the whole case
};

/// What the scenes of a suite cost on an engine and setting.
struct SuiteCost {
  std::string suite;
  std::string engine;
  std::string setting;
  RunCost cost;
};

/// What each engine and setting reaches today, by engine, setting, case and metric: an error above its bound is a
/// regression.
using Bounds = std::map<std::tuple<std::string, std::string, std::string, std::string>, double>;

/// Reads bounds from a CSV file: engine, setting, case, metric, bound; fields are separated by tabs, so that names may
/// hold commas.
Result<Bounds> read_bounds(const std::string& path);

/// Writes the errors of the rows as bounds, widened so that another processor's rounding does not miss them: twice the
/// error and 1e-9 more. Verdicts stay as they are. Settings that have no bounds (`has_bounds`) are left out.
std::optional<Error> write_bounds(const std::string& path, std::span<const ValidationRow> rows);

/// What keeps `write_bounds` from writing there, if anything.
std::optional<Error> check_bounds_file(const std::string& path);

/// The rows whose error is above its bound, or that have none, among the settings that have bounds (`has_bounds`).
std::vector<ValidationRow> missed(std::span<const ValidationRow> rows, const Bounds& bounds);

/// The rows as JSON: a list of {case, engine, setting, metric, value, expected, error, tolerance, pass, cpu_seconds};
/// what is not finite is null.
std::string validation_json(std::span<const ValidationRow> rows);

/// Writes measurements.csv, costs.csv, cases.csv and measurements.json into the folder, which is made when missing.
std::optional<Error> write_validation(const std::string& folder, std::span<const ValidationRow> rows,
                                      std::span<const SuiteCost> costs);

}  // namespace holdfast::internal
