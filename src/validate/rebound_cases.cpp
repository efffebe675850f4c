#include "validate/case.hpp"

namespace holdfast {

std::vector<Case> rebound_cases() { return {}; }

}  // namespace holdfast
