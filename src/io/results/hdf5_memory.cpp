#include <cstddef>
#include <cstdlib>
#include <exception>
#include <new>

// HDF5 1.10 crashes in its error paths when one of its many small allocations fails. When it is linked statically, its
// allocations call these functions (--wrap, see cmake/dependencies.cmake). If a small allocation fails, they end the
// program through its terminate handler, which prints the reason. Large allocations fail as HDF5 expects: a damaged
// file may claim any size.

namespace {

constexpr std::size_t kSmall = (std::size_t{1} << 20U) - 1;  // bytes; HDF5's cache of a file takes half of that

void* checked(void* memory, std::size_t size) {
  if (memory != nullptr || size == 0 || size > kSmall) return memory;
  try {
    throw std::bad_alloc();
  } catch (...) {
    std::terminate();
  }
}

}  // namespace

// NOLINTBEGIN(bugprone-reserved-identifier,readability-identifier-naming): these names are given by the linker
extern "C" {
void* __real_malloc(std::size_t size);
void* __real_calloc(std::size_t count, std::size_t size);
void* __real_realloc(void* memory, std::size_t size);
void* __wrap_malloc(std::size_t size) { return checked(__real_malloc(size), size); }
void* __wrap_calloc(std::size_t count, std::size_t size) {
  return checked(__real_calloc(count, size), size != 0 && count > kSmall / size ? kSmall + 1 : count * size);
}
void* __wrap_realloc(void* memory, std::size_t size) { return checked(__real_realloc(memory, size), size); }
}
// NOLINTEND(bugprone-reserved-identifier,readability-identifier-naming)
