#include <cstddef>
#include <cstdlib>
#include <exception>
#include <new>

// HDF5 1.10 crashes in its error paths when one of its many smaller allocations fails. Where it is linked statically,
// these come here (--wrap, see cmake/dependencies.cmake), and end the program by its terminate handler, which says why.
// Large ones fail as HDF5 expects: a damaged file may claim any size.

namespace {

constexpr std::size_t kSmall = (std::size_t{1} << 20U) - 1;  // bytes; its cache of a file takes half of that

void* checked(void* memory, std::size_t size) {
  if (memory != nullptr || size == 0 || size > kSmall) return memory;
  try {
    throw std::bad_alloc();
  } catch (...) {
    std::terminate();
  }
}

}  // namespace

// NOLINTBEGIN(bugprone-reserved-identifier,readability-identifier-naming): the linker's names
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
