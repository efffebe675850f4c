#pragma once

namespace holdfast::internal {

/// Wakes a thread that waits in the system's `poll`, from any thread. Throws `std::system_error` when the system has
/// none.
class WakeUp {
 public:
  WakeUp();
  WakeUp(const WakeUp&) = delete;
  WakeUp& operator=(const WakeUp&) = delete;
  ~WakeUp();

  /// Makes `descriptor` readable.
  void wake() const noexcept;
  /// Makes it unreadable again.
  void clear() const noexcept;
  int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

}  // namespace holdfast::internal
