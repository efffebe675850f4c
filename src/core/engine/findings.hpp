#pragma once

#include <any>
#include <utility>
#include <vector>

namespace holdfast::internal {

/// What analyses have found of a world, or of a layout: at most one value of each type.
class Findings {
 public:
  /// The value of that type; null when there is none.
  template <class Found>
  const Found* get() const {
    for (const std::any& value : values_)
      if (const Found* found = std::any_cast<Found>(&value)) return found;
    return nullptr;
  }

  /// The same; what nothing was found of has the value of a new `Found`.
  template <class Found>
  const Found& value() const {
    static const Found kNone{};
    const Found* found = get<Found>();
    return found != nullptr ? *found : kNone;
  }

  /// Adds a value of a type that is not there yet.
  template <class Found>
  void put(Found&& found) {
    values_.emplace_back(std::forward<Found>(found));
  }

 private:
  std::vector<std::any> values_;
};

}  // namespace holdfast::internal
