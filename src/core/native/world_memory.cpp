#include "core/native/world_memory.hpp"

#include <new>

namespace holdfast::internal::native {

std::unique_ptr<WorldMemory> WorldMemoryPool::take() {
  {
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (lock.owns_lock() && !idle_.empty()) {
      std::unique_ptr<WorldMemory> memory = std::move(idle_.back());
      idle_.pop_back();
      return memory;
    }
  }
  return std::make_unique<WorldMemory>(options_);
}

void WorldMemoryPool::give_back(std::unique_ptr<WorldMemory> memory) noexcept {
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock.owns_lock()) return;
  try {
    idle_.push_back(std::move(memory));
  } catch (const std::bad_alloc&) {
    // Without room for it in the pool the memory is freed.
    return;
  }
}

}  // namespace holdfast::internal::native
