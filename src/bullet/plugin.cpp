#include <LinearMath/btAlignedAllocator.h>

#include <cstdlib>
#include <exception>
#include <new>

#include "bullet/bullet_engine.hpp"
#include "core/engine/engine_plugin.hpp"

using namespace holdfast::internal;

namespace {

/// Bullet writes to what malloc returns without a look at it, and its lists are no longer whole after an exception:
/// their destructors would crash. So a failure ends the program, which may say why in its terminate handler.
void* allocate_or_end(std::size_t size) {
  void* memory = std::malloc(size);
  if (memory != nullptr) return memory;
  try {
    throw std::bad_alloc();
  } catch (...) {
    std::terminate();
  }
}

void free_memory(void* memory) { std::free(memory); }

}  // namespace

extern "C" __attribute__((visibility("default"))) void holdfast_make_engine(const std::string& name,
                                                                            const Settings& settings,
                                                                            Result<std::unique_ptr<Engine>>& engine) {
  btAlignedAllocSetCustom(allocate_or_end, free_memory);
  std::vector<Error> errors = unsupported_by_bullet(settings);
  if (errors.empty()) {
    engine = std::unique_ptr<Engine>(std::make_unique<BulletEngine>(name, settings));
  } else {
    engine = std::move(errors);
  }
}
