#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/result.hpp"
#include "core/model/settings.hpp"

namespace holdfast::internal {

/// One key of config.ini: everything the reader, `--help-config`, docs/reference/config.md and the results file need.
struct SettingKey {
  std::string_view section;        ///< as in the file, without brackets; `Material N` stands for all materials
  std::string_view name;           ///< as in the file; `A, B` stands for all pairs of [Friction]
  std::string_view unit;           ///< of the value in the file; "" when it has none
  std::string_view default_value;  ///< as one would write it in the file; "" when absent by default
  std::string_view accepted;       ///< what is accepted, a clause for messages: "a number above 0"
  std::string_view sentence;       ///< what it does, one sentence
  std::string_view alias = "";     ///< another spelling that is accepted; "" when there is none
  bool without_effect = false;     ///< accepted for compatibility with old files; the reader warns about it

  /// Sets the member from the file's text. False when the text is not as `accepted` says; then nothing changes.
  /// @param of the material for keys of `Material N`, the pair for that of [Friction]; ignored for other keys
  bool (*set)(Settings& settings, std::string_view of, std::string_view text) = nullptr;
  /// The member as one would write it in the file; "" when absent.
  std::string (*get)(const Settings& settings, std::string_view of) = nullptr;
};

/// The section of the table that represents every `Material` section of a file.
inline constexpr std::string_view kMaterialSection = "Material N";

/// The section whose keys are pairs of materials, and the name in the table that represents them all.
inline constexpr std::string_view kFrictionSection = "Friction";
inline constexpr std::string_view kPairKey = "A, B";

/// A key of a file, and what it belongs to.
struct PlacedSetting {
  const SettingKey* key = nullptr;
  std::string of;       ///< material or pair; empty for other keys
  std::string section;  ///< in its main spelling, as `name`: `Material 3` for `Material  03`
  std::string name;
};

/// The key that a section and a name of a file mean, materials and pairs included; nothing where there is none.
std::optional<PlacedSetting> place_setting(std::string_view section, std::string_view name);

/// The name of a material that a section names after `Material`; nothing where it has none.
std::optional<std::string> material_of_section(std::string_view section);

/// All keys, grouped by section in the order of the documentation.
std::span<const SettingKey> setting_table();

/// The sections of the table, each once, in the order of the table.
std::vector<std::string_view> setting_sections();

/// The key of that section and name (aliases included), or nullptr. Spelling and case are strict.
const SettingKey* find_setting(std::string_view section, std::string_view name);

/// All settings that there are, materials and pairs one by one, in the order of the table.
std::vector<PlacedSetting> placed_settings(const Settings& settings);

/// Every setting as (`Section/Key`, text as one would write it in a file), materials as `Material 3/Key`, in the order
/// of the table. A setting that is absent, so that engine or inputs decide, has an empty text.
std::vector<std::pair<std::string, std::string>> effective_settings(const Settings& settings);

/// Two keys that contradict each other; section and name are those of the key to change.
struct SettingConflict {
  std::string section;  ///< as in the file: `Material 3` for material 3
  std::string name;     ///< of the key
  Error error;          ///< without file and line
};

/// Whether a key of a section is given.
using GivenKeys = std::function<bool(std::string_view section, std::string_view key)>;

/// Lets the friction model follow from the keys that are given, where FrictionModel itself is not: `pairs` where a
/// coefficient of a pair is given.
/// @return keys of a pair that have no effect
std::vector<SettingConflict> choose_friction_model(Settings& settings, const GivenKeys& given);

/// Lets size, open sides and bed of the container follow from its type, where they are not given.
void apply_container_type(Settings& settings, const GivenKeys& given);

/// Contradictions between keys whose values are valid separately; empty when there are none.
std::vector<SettingConflict> check_settings(const Settings& settings);

}  // namespace holdfast::internal
