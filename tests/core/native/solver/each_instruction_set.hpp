#pragma once

#include <cstdint>
#include <vector>

#include "core/native/solver/instruction_sets.hpp"

namespace holdfast::internal::native {

/// Calls `test(set)` with the kernels restricted to each instruction set of this machine in turn.
template <class Test>
void for_each_instruction_set(Test test) {
  struct Release {
    Release() = default;
    Release(const Release&) = delete;
    Release& operator=(const Release&) = delete;
    ~Release() { use_instruction_set(0); }
  };
  const std::vector<std::int64_t> sets = instruction_sets();
  const Release release;
  for (const std::int64_t set : sets) {
    use_instruction_set(set);
    test(set);
  }
}

}  // namespace holdfast::internal::native
