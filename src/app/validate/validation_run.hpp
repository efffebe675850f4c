#pragma once

#include <atomic>
#include <cstdio>
#include <span>
#include <string>
#include <vector>

#include "app/validate/validation_files.hpp"
#include "validate/laboratory/case.hpp"
#include "validate/laboratory/load_suite.hpp"

namespace holdfast::internal {

/// What to validate.
struct ValidationPlan {
  std::vector<EngineSetting> settings;
  std::vector<Case> cases;
  std::vector<LoadWorld> loads;  ///< empty: without the load suite
  int threads = 1;
  bool quiet = false;  ///< no progress
};

/// What came out: measurements setting by setting, case by case; costs by suite.
struct ValidationResult {
  std::vector<ValidationRow> rows;
  std::vector<SuiteCost> costs;
  bool complete = false;  ///< false when it was stopped
};

/// Measures every case and load with every setting, spread over threads; the order of the result does not depend on
/// them. Processor time is the measuring thread's own. Loads are measured with both references first.
ValidationResult run_validation(const ValidationPlan& plan, const std::atomic<bool>& stop);

}  // namespace holdfast::internal
