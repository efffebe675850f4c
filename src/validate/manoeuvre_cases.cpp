#include "validate/case.hpp"

namespace holdfast {

std::vector<Case> manoeuvre_cases() { return {}; }

}  // namespace holdfast
