#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "api/c_call.hpp"
#include "holdfast/holdfast.h"
#include "holdfast/holdfast.hpp"

namespace holdfast::internal {

// Copies a member of a structure of holdfast.hpp, `from`, into that of holdfast.h, `copy`.
#define HOLDFAST_C_COPY(scope, type, name, dataset, label, since, unit, sentence) \
  HOLDFAST_IF_C_##scope(copy_member(from.name, copy.name);)
template <class From, class To>
void copy_member(const From& from, To& to) {
  to = static_cast<To>(from);
}
inline void copy_member(const std::array<float, 3>& from, float (&to)[3]) { std::copy(from.begin(), from.end(), to); }

/// A screen of the C interface.
struct CScreen : CObject {
  std::optional<holdfast::Screen> screen;  ///< nothing when it could not be made
  std::vector<holdfast::WorldOutcome> evaluated;
  holdfast::FinishedLayout polled;
  const std::vector<holdfast::WorldOutcome>* last = &evaluated;  ///< what the last call gave

  holdfast::Screen& made() {
    if (!screen) throw BadArgument{"the screen could not be made"};
    return *screen;
  }

  /// Number of accelerations; an error when there are none.
  std::size_t accelerations();
};

/// Writes what became of worlds to an array of the caller, which has room.
void copy_outcomes(std::span<const holdfast::WorldOutcome> worlds, holdfast_outcome* outcomes);

}  // namespace holdfast::internal
