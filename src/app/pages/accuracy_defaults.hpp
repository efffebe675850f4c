#pragma once

#include <string>

#include "core/model/setting_table.hpp"

namespace holdfast::internal {

/// What a key of `[Native]` stands for where it is absent, by accuracy, as a sentence for the pages about keys:
/// "Default: screening 60, standard 240, reference 1440."; "" for a key that does not depend on the accuracy.
std::string accuracy_default(const SettingKey& key);

}  // namespace holdfast::internal
