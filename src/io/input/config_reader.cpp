#include "io/input/config_reader.hpp"

#include <ini.h>

#include <cstring>
#include <map>
#include <optional>

#include "core/base/closest_word.hpp"
#include "core/base/error_list.hpp"
#include "core/model/setting_table.hpp"
#include "core/model/unlikely_settings.hpp"
#include "io/input/text_lines.hpp"

namespace holdfast::internal {

namespace {

std::string in_brackets(std::string_view section) { return '[' + std::string(section) + ']'; }

/// `did you mean X?`, or the list of all candidates.
std::string suggestion(std::string_view word, std::span<const std::string_view> candidates, bool brackets) {
  const auto text = [&](std::string_view candidate) {
    return brackets ? in_brackets(candidate) : std::string(candidate);
  };
  if (const auto closest = closest_word(word, candidates)) return "did you mean " + text(*closest) + '?';
  std::string all;
  for (const std::string_view candidate : candidates) all += (all.empty() ? "one of " : ", ") + text(candidate);
  return all;
}

/// A section of the file.
struct Section {
  std::string name;        ///< for messages; `Material 3` for any white space and leading zeros in the file
  std::string_view table;  ///< as in the table of keys; "" if the table has no such section
};

/// Reads one file. inih separates keys from values and removes comments. It reports neither line numbers nor what it
/// has ignored; therefore it gets the lines one by one, and its result is checked for each.
class ConfigReader {
 public:
  explicit ConfigReader(const TextFile& file) : lines_(file.text), errors_(file.path), path_(file.path) {
    config_.path = file.path;
    config_.text = file.text;
    config_.sha256 = file.sha256;
  }

  Result<Config> read(std::vector<Error>& warnings) {
    const int rest = ini_parse_stream(give_line, this, take_key, this);
    if (rest == -2) errors_.add({.what = "cannot be read: out of memory"});
    if (errors_.empty()) add_conflicts();
    if (!errors_.empty()) return errors_.take();
    add_warnings();
    warnings.insert(warnings.end(), warnings_.begin(), warnings_.end());
    for (const auto& [key, place] : given_) config_.given.insert(key);
    return std::move(config_);
  }

 private:
  struct Place {
    long line = 0;
    long column = 0;
  };

  /// inih's reader: works like fgets. Lines that are not for inih are passed as empty lines.
  static char* give_line(char* buffer, int size, void* self) {
    auto& reader = *static_cast<ConfigReader*>(self);
    reader.expect_key_taken();
    if (!reader.lines_.next()) return nullptr;
    // inih would treat an indented line as a continuation of the previous value.
    const std::string_view line = reader.screen(trimmed(reader.lines_.line()), static_cast<std::size_t>(size) - 2);
    line.copy(buffer, line.size());
    std::memcpy(buffer + line.size(), "\n", 2);
    return buffer;
  }

  /// inih's handler. The section is already known from the lines.
  static int take_key(void* self, const char* /*section*/, const char* name, const char* value) {
    auto& reader = *static_cast<ConfigReader*>(self);
    reader.key_expected_ = false;
    reader.set_key(name, value);
    return 1;
  }

  /// The part of a trimmed line that is passed to inih: only lines with a key.
  std::string_view screen(std::string_view line, std::size_t longest) {
    if (line.empty() || line[0] == ';' || line[0] == '#') return {};
    if (line[0] == '[') {
      open_section(line);
      return {};
    }
    if (line.size() > longest) {
      add_error(column_of(line), "the line is too long", std::to_string(line.size()) + " bytes",
                "at most " + std::to_string(longest));
      return {};
    }
    if (line.find('\0') != std::string_view::npos) {
      add_error(column_of(line), "the line has a zero byte", shown(line), "text");
      return {};
    }
    key_expected_ = true;
    return line;
  }

  void expect_key_taken() {
    if (!key_expected_) return;
    key_expected_ = false;
    const std::string_view line = trimmed(lines_.line());
    add_error(column_of(line), "neither a section nor a key with a value", shown(line), "[section] or key = value");
  }

  void open_section(std::string_view line) {
    section_ = Section{};
    const std::size_t end = line.find(']');
    const std::string_view rest = end == std::string_view::npos ? "" : trimmed(line.substr(end + 1));
    if (end == std::string_view::npos || (!rest.empty() && rest[0] != ';' && rest[0] != '#')) {
      add_error(column_of(line), "not a section", shown(line), "a name in brackets, alone in its line");
      return;
    }
    const std::string_view name = trimmed(line.substr(1, end - 1));
    if (name == "Material" || name.starts_with("Material ") || name.starts_with("Material\t")) {
      const std::optional<std::string> material = material_of_section(name);
      if (material)
        section_ = {"Material " + *material, kMaterialSection};
      else
        add_error(column_of(line), "a material section without the name of a material", shown(line),
                  "[Material N], where N is a whole number from 0, or a name that is not any, floor or wall and has no "
                  "comma");
      return;
    }
    const std::vector<std::string_view> sections = setting_sections();
    for (const std::string_view known : sections)
      if (known == name) section_ = {std::string(name), known};
    if (section_->table.empty() && !counted_only())
      add_error(column_of(line), "unknown section", shown(in_brackets(name)), suggestion(name, sections, true));
  }

  void set_key(const std::string& name, const std::string& value) {
    const std::string_view line = lines_.line();
    const long name_column = column_of(trimmed(line));
    if (!section_) return add_error(name_column, "a key before any section", shown(name), "a line [section] before it");
    if (section_->table.empty()) return;  // an error has already been reported for the section
    if (name.empty()) return add_error(name_column, "a value without a key", shown(value), "key = value");
    const std::optional<PlacedSetting> placed = place_setting(section_->name, name);
    if (!placed) return add_unknown_key(name_column, name);
    const SettingKey* const key = placed->key;

    const auto [first, is_new] =
        given_.try_emplace({placed->section, placed->name}, Place{lines_.number(), name_column});
    if (!is_new)
      return add_error(name_column, "the key is given twice", shown(name),
                       "its first value is on line " + std::to_string(first->second.line));
    const std::size_t equals = line.find_first_of("=:");
    const std::size_t begin = line.find_first_not_of(" \t", equals + 1);
    const long value_column = static_cast<long>(begin == std::string_view::npos ? equals + 1 : begin) + 1;
    if (!key->set(config_.settings, placed->of, value)) {
      std::string accepted(key->accepted);
      if (!key->unit.empty()) accepted += " (" + std::string(key->unit) + ')';
      add_error(value_column, name + (value.empty() ? " has no value" : " has a wrong value"), shown(value), accepted);
    } else if (key->without_effect) {
      add_warning({lines_.number(), name_column}, name + " has no effect yet", shown(value));
    }
  }

  void add_unknown_key(long column, const std::string& name) {
    if (counted_only()) return;
    std::vector<std::string_view> names;
    std::string accepted;
    for (const SettingKey& key : setting_table()) {
      if (key.section == section_->table) names.push_back(key.name);
      if (key.name == name || key.alias == name) accepted = "it belongs to " + in_brackets(key.section);
    }
    if (accepted.empty() && section_->table == kFrictionSection)
      accepted = "two names with a comma between them: materials, or `any`, and at most one of `floor` and `wall`";
    if (accepted.empty()) accepted = suggestion(name, names, false);
    add_error(column, "unknown key in " + in_brackets(section_->name), shown(name), accepted);
  }

  void add_conflicts() {
    const auto is_given = [&](std::string_view section, std::string_view key) {
      return given_.contains({std::string(section), std::string(key)});
    };
    apply_container_type(config_.settings, is_given);
    std::vector<SettingConflict> conflicts = choose_friction_model(config_.settings, is_given);
    for (SettingConflict& conflict : check_settings(config_.settings)) conflicts.push_back(std::move(conflict));
    for (SettingConflict& conflict : conflicts) {
      const Place place = given_[{conflict.section, conflict.name}];
      conflict.error.line = place.line;
      conflict.error.column = place.column;
      errors_.add(std::move(conflict.error));
    }
  }

  /// Keys that the chosen friction model does not read, and settings that are hardly meant.
  void add_warnings() {
    const bool pairs = config_.settings.contact.friction_model == FrictionModel::pairs;
    for (const char* key : {"ContainerFriction", "BoxFriction"})
      if (const auto found = given_.find({"Simulation Settings", key}); pairs && found != given_.end())
        add_warning(found->second, std::string(key) + " has no effect while FrictionModel is pairs", "");
    for (const UnlikelySetting& unlikely : unlikely_settings(config_.settings.container, config_.settings.screening)) {
      auto found = given_.find({std::string(unlikely.section), std::string(unlikely.name)});
      if (found == given_.end() && unlikely.name == "BedHeight")
        found = given_.find({"Simulation Settings", "DropThreshold"});
      add_warning(found == given_.end() ? Place{} : found->second, std::string(unlikely.what), "");
    }
    if (given_.empty()) add_warning({}, "sets no key, so that all keys have their defaults", "");
  }

  /// Whether an error is only counted because there are so many; then no suggestion is needed.
  bool counted_only() {
    if (errors_.full()) errors_.count_more();
    return errors_.full();
  }

  /// Column of a part of the current line.
  long column_of(std::string_view part) const { return static_cast<long>(part.data() - lines_.line().data()) + 1; }

  void add_error(long column, std::string what, std::string value, std::string accepted) {
    errors_.add({.line = lines_.number(),
                 .column = column,
                 .what = std::move(what),
                 .value = std::move(value),
                 .accepted = std::move(accepted)});
  }

  void add_warning(Place place, std::string what, std::string value) {
    warnings_.push_back({.file = path_,
                         .line = place.line,
                         .column = place.column,
                         .what = std::move(what),
                         .value = std::move(value)});
  }

  LineReader lines_;
  ErrorList errors_;
  std::string path_;
  std::vector<Error> warnings_;
  Config config_;
  std::optional<Section> section_;
  std::map<std::pair<std::string, std::string>, Place> given_;
  bool key_expected_ = false;  ///< the current line has been passed to inih, which has not returned a key for it yet
};

}  // namespace

Result<Config> parse_config(const TextFile& file, std::vector<Error>& warnings) {
  return ConfigReader(file).read(warnings);
}

}  // namespace holdfast::internal
