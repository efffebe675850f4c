#pragma once

#include <utility>

// The thread sanitizer sees synchronisation only in code that it was built into, and Debian's TBB is not. The order
// that TBB guarantees is declared to it here; in any other build these functions do nothing.
#ifdef __SANITIZE_THREAD__
#define HOLDFAST_THREAD_SANITIZER
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define HOLDFAST_THREAD_SANITIZER
#endif
#endif
#ifdef HOLDFAST_THREAD_SANITIZER
#include <sanitizer/tsan_interface.h>
#endif

namespace holdfast::internal {

/// What this thread did so far is done for whoever calls `see_from` with the same place later.
inline void leave_at([[maybe_unused]] void* place) {
#ifdef HOLDFAST_THREAD_SANITIZER
  __tsan_release(place);
#endif
}

/// What others did before they called `leave_at` with this place is done for this thread.
inline void see_from([[maybe_unused]] void* place) {
#ifdef HOLDFAST_THREAD_SANITIZER
  __tsan_acquire(place);
#endif
}

/// The two ends of a parallel run: what comes before it, and what comes after.
struct RunOrder {
  char begin = 0;
  char end = 0;
};

/// One call of a stage of a run: after the run's begin, before its end, and, where the stage is serial, after its calls
/// before.
class StageOrder {
 public:
  /// @param serial_stage any address that is the stage's own, or null
  explicit StageOrder(RunOrder& run, void* serial_stage = nullptr) : run_(run), stage_(serial_stage) {
    see_from(&run_.begin);
    if (stage_ != nullptr) see_from(stage_);
  }
  StageOrder(const StageOrder&) = delete;
  StageOrder& operator=(const StageOrder&) = delete;
  ~StageOrder() {
    if (stage_ != nullptr) leave_at(stage_);
    leave_at(&run_.end);
  }

 private:
  RunOrder& run_;
  void* stage_;
};

/// What one stage hands to the next: moved to where the next finds it, on whatever thread.
template <class T>
class Handed {
 public:
  Handed(T&& item) : item_(std::move(item)) {}  // NOLINT(google-explicit-constructor): what a stage returns
  Handed(Handed&& other) noexcept : item_((see_from(&other), std::move(other.item_))) { leave_at(this); }
  Handed& operator=(Handed&&) = delete;
  ~Handed() = default;

  T take() { return std::move(item_); }

 private:
  /// Memory that TBB takes from one thread's items and gives to another's.
  struct Place {
    Place() { see_from(this); }
    ~Place() { leave_at(this); }
  };

  [[maybe_unused]] Place place_;  // first: there before the item, gone after it
  T item_;
};

}  // namespace holdfast::internal
