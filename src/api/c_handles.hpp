#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <utility>

namespace holdfast::internal {

/// A number for a handle, of whatever kind: never 0, and never given before.
std::uintptr_t next_handle_number();

/// The objects of one kind that callers of the C interface hold. A handle is a number that no other object ever had, in
/// the shape of a pointer that nothing follows: one that was freed, or is of another kind, is found out. May be called
/// from any thread.
template <class Handle, class Object>
class Handles {
 public:
  /// Those of the process. What is left at exit is destroyed then.
  static Handles& all() {
    static Handles handles;
    return handles;
  }

  Handle* add(std::shared_ptr<Object> object) {
    const std::uintptr_t number = next_handle_number();
    const std::scoped_lock lock(mutex_);
    objects_.emplace(number, std::move(object));
    return reinterpret_cast<Handle*>(number);
  }

  /// The object, which lives as long as it is held; null when the handle is of none.
  std::shared_ptr<Object> find(const Handle* handle) {
    const std::scoped_lock lock(mutex_);
    const auto found = objects_.find(reinterpret_cast<std::uintptr_t>(handle));
    return found == objects_.end() ? nullptr : found->second;
  }

  /// The object, to which the handle no longer leads.
  std::shared_ptr<Object> remove(const Handle* handle) {
    const std::scoped_lock lock(mutex_);
    const auto found = objects_.find(reinterpret_cast<std::uintptr_t>(handle));
    if (found == objects_.end()) return nullptr;
    std::shared_ptr<Object> object = std::move(found->second);
    objects_.erase(found);
    return object;
  }

 private:
  std::mutex mutex_;
  std::unordered_map<std::uintptr_t, std::shared_ptr<Object>> objects_;
};

}  // namespace holdfast::internal
