#pragma once

#include <cstdint>
#include <limits>
#include <string>

namespace holdfast::internal {

/// What went wrong with a world, one bit per cause; 0: nothing. A world whose input could not be used, or that is too
/// large, is not simulated and has no boxes.
enum class Status : std::uint32_t {
  ok = 0,
  bad_layout = 1U << 0U,        ///< the layout could not be used. Cure: see status_text
  bad_acceleration = 1U << 1U,  ///< the acceleration could not be used. Cure: see status_text
  non_finite = 1U << 2U,        ///< a state became infinite or NaN; the samples end before that. Cure: a smaller step
  not_converged = 1U << 3U,     ///< the solver's residual stayed above its limit. Cure: more iterations or accuracy
  capacity = 1U << 4U,          ///< a device had too little memory for all contacts, or failed. Cure: another engine
  too_large = 1U << 5U,         ///< the series would take too much memory; not simulated. Cure: see status_text
  not_needed = 1U << 6U,        ///< by FirstFailure: the layout failed another acceleration; not simulated, no problem
};

constexpr Status operator|(Status a, Status b) {
  return static_cast<Status>(static_cast<std::uint32_t>(a) | static_cast<std::uint32_t>(b));
}
constexpr bool has(Status status, Status bit) {
  return (static_cast<std::uint32_t>(status) & static_cast<std::uint32_t>(bit)) != 0;
}

/// Why a world ended.
enum class StopReason : std::uint8_t {
  not_run = 0,   ///< an input could not be used
  timeout = 1,   ///< the end of the simulated time
  sleeping = 2,  ///< all boxes had come to rest
  failed = 3,    ///< the status says why
  decided = 4,   ///< a box was beyond a threshold that StopWhen watches
};

/// Number of boxes where they were not counted but a number is needed; too large to be mistaken for a count.
inline constexpr std::uint32_t kNotCounted = std::numeric_limits<std::uint32_t>::max();

/// Names of the set bits, joined by '+': "ok", "bad_layout", "non_finite+not_converged".
std::string to_string(Status status);

/// Name of the reason as above; "unknown" for any other number, which a damaged file may contain.
std::string to_string(StopReason reason);

}  // namespace holdfast::internal
