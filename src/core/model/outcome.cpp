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

/// Names of the bits that are set, joined by '+'.
std::string names_of(std::span<const OutcomeName> names, std::uint32_t bits) {
  std::string text;
  for (const OutcomeName& bit : names) {
    if ((bits & bit.code) == 0) continue;
    if (!text.empty()) text += '+';
    text += bit.name;
  }
  return text;
}

}  // namespace

std::string to_string(Verdict verdict) { return name_of(kVerdictNames, verdict); }
std::string to_string(StopReason reason) { return name_of(kStopReasonNames, reason); }
std::string to_string(ReplicaVerdict verdict) { return name_of(kReplicaVerdictNames, verdict); }

std::string to_string(Status status) {
  const std::string names = names_of(kStatusNames, static_cast<std::uint32_t>(status));
  return names.empty() ? "ok" : names;
}

std::string to_string(Caveat caveats) { return names_of(kCaveatNames, static_cast<std::uint32_t>(caveats)); }

}  // namespace holdfast::internal
