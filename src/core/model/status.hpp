#pragma once

#include <cstdint>
#include <limits>

#include "holdfast/outcome_fields.h"

namespace holdfast::internal {

/// What went wrong with a world, one bit per cause; 0: nothing. A world whose input could not be used, or that is too
/// large, is not simulated and has no boxes. The bits are those of HOLDFAST_STATUS_BITS.
#define HOLDFAST_STATUS_BIT(name, c_name, code, sentence) name = (code),
enum class Status : std::uint32_t { ok = 0, HOLDFAST_STATUS_BITS(HOLDFAST_STATUS_BIT) };
#undef HOLDFAST_STATUS_BIT

/// What a reader has to know beside the verdict, one bit each; 0: nothing. The bits are those of HOLDFAST_CAVEAT_BITS.
#define HOLDFAST_CAVEAT_BIT(name, c_name, code, sentence) name = (code),
enum class Caveat : std::uint32_t { none = 0, HOLDFAST_CAVEAT_BITS(HOLDFAST_CAVEAT_BIT) };
#undef HOLDFAST_CAVEAT_BIT

constexpr Caveat operator|(Caveat a, Caveat b) {
  return static_cast<Caveat>(static_cast<std::uint32_t>(a) | static_cast<std::uint32_t>(b));
}
constexpr bool has(Caveat caveats, Caveat bit) {
  return (static_cast<std::uint32_t>(caveats) & static_cast<std::uint32_t>(bit)) != 0;
}

constexpr Status operator|(Status a, Status b) {
  return static_cast<Status>(static_cast<std::uint32_t>(a) | static_cast<std::uint32_t>(b));
}
constexpr bool has(Status status, Status bit) {
  return (static_cast<std::uint32_t>(status) & static_cast<std::uint32_t>(bit)) != 0;
}

/// Number of boxes where they were not counted but a number is needed; too large to be mistaken for a count.
inline constexpr std::uint32_t kNotCounted = std::numeric_limits<std::uint32_t>::max();

}  // namespace holdfast::internal
