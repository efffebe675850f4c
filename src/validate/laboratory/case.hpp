#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "validate/laboratory/laboratory.hpp"
#include "validate/laboratory/measurement.hpp"

namespace holdfast::internal {

/// A question with a known answer. To add a case, add an entry to the table of its suite.
struct Case {
  std::string suite;         ///< slide, tip, rebound, manoeuvre, hard, oscillate
  std::string name;          ///< unique, snake_case: "slide_mu_0.5_along_x"
  std::string question;      ///< what is asked, one clause: "smallest acceleration that slides a box of friction 0.5"
  std::string failure_mode;  ///< typical failure mode of engines, one clause
  bool quick = false;        ///< part of a quick run: below 0.2 s of processor time with Bullet's default
  /// Runs the scenes of the case and returns the measurements. A comment beside it derives the expected values.
  std::function<std::vector<Measurement>(Laboratory&)> measure;
};

/// The cases of each suite.
std::vector<Case> slide_cases();
std::vector<Case> tip_cases();
std::vector<Case> rebound_cases();
std::vector<Case> manoeuvre_cases();
std::vector<Case> hard_cases();
std::vector<Case> oscillate_cases();

/// All cases, suite by suite.
std::vector<Case> all_cases();

}  // namespace holdfast::internal
