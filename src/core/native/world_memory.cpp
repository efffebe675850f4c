#include "core/native/world_memory.hpp"

namespace holdfast::internal::native {

WorldMemoryPool::~WorldMemoryPool() {
  for (std::atomic<WorldMemory*>& slot : slots_) {
    const std::unique_ptr<WorldMemory> freed(slot.load());
  }
}

std::unique_ptr<WorldMemory> WorldMemoryPool::take() {
  for (std::atomic<WorldMemory*>& slot : slots_)
    if (WorldMemory* const memory = slot.exchange(nullptr); memory != nullptr)
      return std::unique_ptr<WorldMemory>(memory);
  return std::make_unique<WorldMemory>(options_);
}

void WorldMemoryPool::give_back(std::unique_ptr<WorldMemory> memory) noexcept {
  for (std::atomic<WorldMemory*>& slot : slots_) {
    WorldMemory* empty = nullptr;
    if (!slot.compare_exchange_strong(empty, memory.get())) continue;
    (void)memory.release();
    return;
  }
}

}  // namespace holdfast::internal::native
