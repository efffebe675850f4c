#pragma once

#include "holdfast/holdfast.hpp"

namespace holdfast::internal {

/// Ends what a screen does for good.
struct ScreenCloser {
  /// Ends the running call early, also one that has only just begun, all that follow, and all layouts in flight. May be
  /// called from any thread.
  static void close(Screen& screen) noexcept;
};

}  // namespace holdfast::internal
