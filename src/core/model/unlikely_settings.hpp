#pragma once

#include <string_view>
#include <vector>

#include "core/model/settings.hpp"

namespace holdfast::internal {

/// A setting that is valid, and hardly what is meant.
struct UnlikelySetting {
  std::string_view section, name;  ///< of the key
  std::string_view what;           ///< for a warning
};

/// What is unlikely about a container, and about thresholds in it; empty where nothing is.
std::vector<UnlikelySetting> unlikely_settings(const ContainerSettings& container, const ScreeningSettings& screening);

}  // namespace holdfast::internal
