#include <cstdint>

// Highway's shared library measures its benchmark timer whenever it is loaded, for 3.5 ms. Nothing here asks for that
// timer; this takes the measurement's place, for the loader asks the program first.
namespace hwy::platform {

std::uint64_t TimerResolution();  // NOLINT(readability-identifier-naming): Highway's name
std::uint64_t TimerResolution() { return 1; }

}  // namespace hwy::platform
