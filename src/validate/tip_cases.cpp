#include "validate/case.hpp"

namespace holdfast {

std::vector<Case> tip_cases() { return {}; }

}  // namespace holdfast
