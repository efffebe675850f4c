#pragma once

#include <cstdint>
#include <vector>

namespace holdfast::internal::native {

/// Instruction sets that this machine can run, best first; for tests.
std::vector<std::int64_t> instruction_sets();

/// Restricts the kernels to one of `instruction_sets()`, or back to the best with 0; for tests, not while worlds run.
void use_instruction_set(std::int64_t set);

}  // namespace holdfast::internal::native
