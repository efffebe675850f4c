#pragma once

#include <span>

#include "core/model/settings.hpp"
#include "holdfast/holdfast.hpp"
#include "io/input/config_reader.hpp"

namespace holdfast::internal {

/// Sets a key as a config.ini does. Throws `holdfast::Error`, and then changes nothing.
void apply_setting(Settings& settings, const holdfast::Setting& given);

/// Sets the keys in their order, after those of a configuration. Throws `holdfast::Error` for the first that cannot be
/// set, and where keys contradict each other afterwards.
void apply_settings(Config& config, std::span<const holdfast::Setting> given);

/// The setting by its main spelling, with the value as a config.ini has it. Throws `holdfast::Error` when it cannot be
/// set.
holdfast::Setting main_spelling(const holdfast::Setting& given);

}  // namespace holdfast::internal
