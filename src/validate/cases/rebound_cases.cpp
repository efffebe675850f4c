#include "validate/cases/rebound_cases.hpp"

namespace holdfast::internal {

std::vector<Case> rebound_cases() {
  std::vector<Case> all;
  for (auto* part : {wall_cases, meeting_cases, landing_cases, rocking_cases}) {
    const std::vector<Case> cases = part();
    all.insert(all.end(), cases.begin(), cases.end());
  }
  return all;
}

}  // namespace holdfast::internal
