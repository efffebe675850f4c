#pragma once

#include <string>

#include "core/model/setting_table.hpp"

namespace holdfast::internal {

/// A sentence about what an absent key stands for where an engine decides; "" where the table of keys says it.
using EngineDefault = std::string (*)(const SettingKey& key);

/// The page docs/reference/config.md as Markdown, generated from the table of keys.
std::string settings_page(EngineDefault engine_default);

/// The same keys as plain text of at most 100 columns, for a terminal.
std::string settings_help(EngineDefault engine_default);

}  // namespace holdfast::internal
