#include "core/model/status.hpp"

#include <array>
#include <utility>

namespace holdfast::internal {

std::string to_string(Status status) {
  constexpr std::array<std::pair<Status, const char*>, 7> kNames = {{{Status::bad_layout, "bad_layout"},
                                                                     {Status::bad_acceleration, "bad_acceleration"},
                                                                     {Status::non_finite, "non_finite"},
                                                                     {Status::not_converged, "not_converged"},
                                                                     {Status::capacity, "capacity"},
                                                                     {Status::too_large, "too_large"},
                                                                     {Status::not_needed, "not_needed"}}};
  std::string text;
  for (const auto& [bit, name] : kNames) {
    if (!has(status, bit)) continue;
    if (!text.empty()) text += '+';
    text += name;
  }
  return text.empty() ? "ok" : text;
}

std::string to_string(StopReason reason) {
  constexpr std::array<const char*, 5> kNames = {"not_run", "timeout", "sleeping", "failed", "decided"};
  const auto number = static_cast<std::size_t>(reason);
  return number < kNames.size() ? kNames[number] : "unknown";
}

}  // namespace holdfast::internal
