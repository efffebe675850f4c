#include "core/native/world_memory.hpp"

namespace holdfast::internal::native {

std::unique_ptr<WorldMemory> WorldMemoryPool::take() {
  const std::scoped_lock lock(mutex_);
  if (idle_.empty()) return std::make_unique<WorldMemory>(options_);
  std::unique_ptr<WorldMemory> memory = std::move(idle_.back());
  idle_.pop_back();
  return memory;
}

void WorldMemoryPool::give_back(std::unique_ptr<WorldMemory> memory) {
  const std::scoped_lock lock(mutex_);
  idle_.push_back(std::move(memory));
}

}  // namespace holdfast::internal::native
