#include <LinearMath/btAlignedAllocator.h>

#include <cstdlib>
#include <exception>
#include <new>

#include "bullet/bullet_engine.hpp"
#include "core/engine/engine_plugin.hpp"

using namespace holdfast::internal;

namespace {

/// Bullet does not check the result of malloc, and after an exception its lists are inconsistent: their destructors
/// would crash. Therefore a failed allocation ends the program, whose terminate handler can print the reason.
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
