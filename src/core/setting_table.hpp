#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/settings.hpp"

namespace holdfast {

/// One key of config.ini: everything the reader, `--help-config`, docs/config.md and the results file need.
struct SettingKey {
  std::string_view section;        ///< as in the file, without brackets; `Material N` stands for all materials
  std::string_view name;           ///< as in the file
  std::string_view unit;           ///< of the value in the file; "" when it has none
  std::string_view default_value;  ///< as one would write it in the file; "" when absent by default
  std::string_view accepted;       ///< what is accepted, a clause for messages: "a number above 0"
  std::string_view sentence;       ///< what it does, one sentence
  bool without_effect = false;     ///< accepted for the sake of old files; saying so is the reader's duty

  /// Sets the member from the file's text. False when the text is not as `accepted` says; then nothing changed.
  /// @param material id of the material for keys of `Material N`, else ignored
  bool (*set)(Settings& settings, int material, std::string_view text) = nullptr;
  /// The member as one would write it in the file; "" when absent.
  std::string (*get)(const Settings& settings, int material) = nullptr;
};

/// All keys, grouped by section in the order of the documentation.
std::span<const SettingKey> setting_table();

/// The key of that section and name (aliases included), or nullptr. Spelling and case are strict.
const SettingKey* find_setting(std::string_view section, std::string_view name);

/// What a misspelt word may have meant: the candidate with the least edit distance, when that is small enough
/// to be a slip.
std::optional<std::string_view> closest_word(std::string_view word, std::span<const std::string_view> candidates);

}  // namespace holdfast
