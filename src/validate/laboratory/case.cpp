#include "validate/laboratory/case.hpp"

namespace holdfast::internal {

std::vector<Case> all_cases() {
  std::vector<Case> all;
  for (auto* suite : {slide_cases, tip_cases, rebound_cases, manoeuvre_cases, hard_cases, oscillate_cases}) {
    const std::vector<Case> cases = suite();
    all.insert(all.end(), cases.begin(), cases.end());
  }
  return all;
}

}  // namespace holdfast::internal
