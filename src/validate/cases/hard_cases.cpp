#include "validate/cases/hard_cases.hpp"

namespace holdfast::internal {

std::vector<Case> hard_cases() {
  std::vector<Case> all;
  for (auto* part : {hard_stack_cases, hard_balance_cases, hard_geometry_cases, hard_roof_cases, hard_twin_cases}) {
    const std::vector<Case> cases = part();
    all.insert(all.end(), cases.begin(), cases.end());
  }
  return all;
}

}  // namespace holdfast::internal
