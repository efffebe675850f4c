#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "validate/laboratory/laboratory.hpp"
#include "validate/laboratory/measurement.hpp"

namespace holdfast::internal {

/// A question with a known answer. Adding one is adding an entry to the table of its suite.
struct Case {
  std::string suite;     ///< slide, tip, rebound, manoeuvre, hard
  std::string name;      ///< unique, snake_case: "slide_mu_0.5_along_x"
  std::string question;  ///< what is asked, one clause: "smallest acceleration that slides a box of friction 0.5"
  std::string trap;      ///< what goes wrong typically, one clause
  bool quick = false;    ///< part of a quick run: below 0.2 s of processor time with Bullet's default
  /// Runs what it takes and returns what was measured. The expected value and where it comes from are in a comment
  /// beside it.
  std::function<std::vector<Measurement>(Laboratory&)> measure;
};

/// The cases of each suite.
std::vector<Case> slide_cases();
std::vector<Case> tip_cases();
std::vector<Case> rebound_cases();
std::vector<Case> manoeuvre_cases();
std::vector<Case> hard_cases();

/// All of them, suite after suite.
std::vector<Case> all_cases();

}  // namespace holdfast::internal
