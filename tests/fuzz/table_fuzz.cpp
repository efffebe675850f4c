#include <cstddef>
#include <cstdint>

#include "fuzz/fuzz_targets.hpp"

/// libFuzzer calls this with every input it thinks of.
// NOLINTNEXTLINE(readability-identifier-naming): the name is libFuzzer's
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::read_load_file({reinterpret_cast<const char*>(data), size});
  return 0;
}
