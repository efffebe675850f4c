#include "core/native/solver/instruction_sets.hpp"

// Before Highway, which reads it.
#include "core/native/solver/simd_targets.hpp"

#include <hwy/targets.h>

namespace holdfast::internal::native {

std::vector<std::int64_t> instruction_sets() { return hwy::SupportedAndGeneratedTargets(); }

void use_instruction_set(std::int64_t set) { hwy::SetSupportedTargetsForTest(set); }

}  // namespace holdfast::internal::native
