#include "core/model/outcome.hpp"

#include <algorithm>
#include <span>

namespace holdfast::internal {

namespace {

template <class Enum>
std::string name_of(std::span<const OutcomeName> names, Enum value) {
  const auto found = std::find_if(names.begin(), names.end(), [&](const OutcomeName& name) {
    return name.code == static_cast<std::uint32_t>(value);
  });
  return found == names.end() ? "unknown" : std::string(found->name);
}

}  // namespace

std::string to_string(Verdict verdict) { return name_of(kVerdictNames, verdict); }
std::string to_string(StopReason reason) { return name_of(kStopReasonNames, reason); }
std::string to_string(ReplicaVerdict verdict) { return name_of(kReplicaVerdictNames, verdict); }

std::string to_string(Status status) {
  std::string text;
  for (const OutcomeName& bit : kStatusNames) {
    if (!has(status, static_cast<Status>(bit.code))) continue;
    if (!text.empty()) text += '+';
    text += bit.name;
  }
  return text.empty() ? "ok" : text;
}

}  // namespace holdfast::internal
