#pragma once

#include <string>

namespace holdfast::internal {

/// Names the world that this thread works on, from its making to its end, for a terminate handler: memory may run out
/// where no exception can be caught. The texts must outlive it.
class WorkInHand {
 public:
  WorkInHand(const std::string& layout, const std::string& acceleration);
  WorkInHand(const WorkInHand&) = delete;
  WorkInHand& operator=(const WorkInHand&) = delete;
  ~WorkInHand();

  /// The layout, and the acceleration, that this thread works on; null when it works on none. Allocates nothing.
  static const char* layout();
  static const char* acceleration();
};

}  // namespace holdfast::internal
