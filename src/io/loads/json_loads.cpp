#include "io/loads/json_loads.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "core/base/number_text.hpp"
#include "core/model/length_unit.hpp"
#include "io/input/text_lines.hpp"
#include "io/loads/json_text.hpp"
#include "io/loads/load_parts.hpp"
#include "io/loads/own_json.hpp"

namespace holdfast::internal {

namespace {

using Json = nlohmann::ordered_json;

/// A list of objects, or an object of objects, as a table.
class JsonRows final : public LoadRows {
 public:
  JsonRows(const std::string& path, std::string pointer) : path_(path), pointer_(std::move(pointer)) {}

  /// @param key_of_row its index or its name
  void add_row(const Json& object, std::string key_of_row) {
    std::vector<std::pair<std::string, std::string>> values;
    flatten(object, "", values, 0);
    std::vector<std::string>& row = rows_.emplace_back();
    row_places_.push_back(std::move(key_of_row));
    for (auto& [key, value] : values) {
      const auto [place, is_new] = places_.try_emplace(key, headers_.size());
      if (is_new) headers_.push_back(key);
      row.resize(std::max(row.size(), place->second + 1));
      row[place->second] = std::move(value);
    }
  }

  const std::vector<std::string>& headers() const override { return headers_; }
  bool next() override { return ++at_ <= rows_.size(); }
  void restart() override { at_ = 0; }
  std::string_view cell(int column) const override {
    const std::vector<std::string>& row = rows_[at_ - 1];
    return static_cast<std::size_t>(column) < row.size() ? std::string_view(row[static_cast<std::size_t>(column)]) : "";
  }
  Error at(int column, std::string what) const override {
    std::string place = pointer();
    if (column >= 0) {
      std::string key = pointer_part(headers_[static_cast<std::size_t>(column)]);
      std::replace(key.begin(), key.end(), '.', '/');
      place += key;
    }
    return {.file = path_, .what = shown(place) + ": " + std::move(what)};
  }
  long line() const override { return 0; }
  std::string pointer() const override { return pointer_ + pointer_part(row_places_[at_ - 1]); }
  bool has_exact_numbers() const override { return true; }

  std::size_t row_count() const { return rows_.size(); }
  /// A list of objects with so many different keys is none of boxes.
  bool has_too_many_keys() const { return headers_.size() > kMostCells; }

 private:
  static void flatten(const Json& json, const std::string& key,
                      std::vector<std::pair<std::string, std::string>>& values, int depth) {
    if (depth > kDeepestJson) return;
    const auto below = [&](const std::string& part) { return key.empty() ? part : key + '.' + part; };
    if (json.is_object()) {
      // A number with its unit.
      if (json.size() == 2 && json.contains("value") && json.contains("unit") && json["unit"].is_string())
        return flatten(json["value"], key + " (" + json["unit"].get<std::string>() + ')', values, depth + 1);
      for (const auto& [name, value] : json.items()) flatten(value, below(name), values, depth + 1);
    } else if (json.is_array()) {
      constexpr std::size_t kMostNumbers = 8;
      // Two corners in one list.
      constexpr std::array<const char*, 6> kCorners = {"x1", "y1", "z1", "x2", "y2", "z2"};
      const std::string word = header_word(std::string_view(key).substr(key.rfind('.') + 1)).word;
      const bool is_bounds = word == "bbox" || word == "bounds" || word == "boundingbox" || word == "aabb";
      if (is_bounds && json.size() == kCorners.size()) {
        for (std::size_t i = 0; i < kCorners.size(); ++i)
          if (json[i].is_number()) flatten(json[i], below(kCorners.at(i)), values, depth + 1);
        return;
      }
      for (std::size_t i = 0; i < std::min(json.size(), kMostNumbers); ++i)
        if (!json[i].is_structured()) flatten(json[i], below(std::to_string(i)), values, depth + 1);
    } else if (!json.is_null() && values.size() < kMostCells) {
      values.emplace_back(key, json.is_string()   ? json.get<std::string>()
                               : json.is_number() ? number_text(json.get<double>())
                                                  : json.dump());
    }
  }

  static constexpr std::size_t kMostCells = 1000;

  const std::string& path_;
  std::string pointer_;
  std::vector<std::string> headers_;
  std::map<std::string, std::size_t> places_;
  std::vector<std::vector<std::string>> rows_;
  std::vector<std::string> row_places_;
  std::size_t at_ = 0;
};

/// Values that stand above a table, outermost first.
using Above = std::vector<std::pair<std::string, std::string>>;

/// Finds the tables in JSON that is not ours, and reads their loads.
class TableFinder {
 public:
  TableFinder(const std::string& path, const std::string& name, const TableChoices& choices, const Settings& settings)
      : path_(path), name_(name), choices_(choices), settings_(settings) {}

  Result<LoadsOfFile> find(const Json& root) {
    Above above;
    look_at(root, "", above, "", 0);
    if (tables_.empty()) {
      Error error{.file = path_, .what = "no list of boxes with places and sizes is found"};
      if (!nearest_.empty()) error.value = "the list " + shown(nearest_) + " of " + shown(keys_) + " lacks " + missing_;
      error.accepted =
          "a list of objects with keys such as x, y, z, length, width, height; or --columns \"KEY = x, ...\"; JSON of "
          "holdfast has the key 'holdfast'";
      if (mistake_) return *mistake_;
      return error;
    }
    LoadsOfFile found;
    for (const Found& table : tables_) {
      TableContext context{.path = path_, .name = name_};
      context.load = tables_.size() > 1 || table.is_named ? table.load : "";
      context.container = table.container;
      context.container_size = table.size;
      context.unit = table.unit;
      context.mass_unit = table.mass_unit;
      context.container_unit = table.container_unit;
      LoadsOfFile more = read_table(*table.rows, table.plan, context, choices_, settings_);
      for (ReadLoad& load : more.loads) found.loads.push_back(std::move(load));
      for (Error& note : more.notes)
        if (std::none_of(found.notes.begin(), found.notes.end(),
                         [&](const Error& known) { return known.message() == note.message(); }))
          found.notes.push_back(std::move(note));
      if (tables_.size() == 1) found.place_headers = std::move(more.place_headers);
      found.ignored = std::move(more.ignored);
    }
    const bool are_loads =
        std::any_of(tables_.begin(), tables_.end(), [](const Found& table) { return table.is_of_load; });
    if (tables_.size() > 1 && !are_loads) join_parts(found.loads, name_);
    return found;
  }

 private:
  struct Found {
    std::unique_ptr<JsonRows> rows;
    ColumnPlan plan;
    std::string load;
    bool is_of_load = false;  ///< in a list of trucks or the like
    bool is_named = false;    ///< by its own key, not by a word that all files have
    std::string container;
    std::array<std::optional<double>, 3> size;
    double unit = 0.0;            ///< of lengths, m; 0: none is said
    double mass_unit = 0.0;       ///< kg
    double container_unit = 0.0;  ///< m
  };

  void look_at(const Json& json, const std::string& pointer, Above& above, const std::string& key, int depth) {
    if (depth > kDeepestJson) return;
    const std::size_t known = above.size();
    look_into(json, pointer, above, key, depth);
    above.resize(known);
  }

  void look_into(const Json& json, const std::string& pointer, Above& above, const std::string& key, int depth) {
    if (json.is_object()) {
      // Boxes by their names.
      const bool has_objects =
          json.size() > 1 && std::all_of(json.begin(), json.end(), [](const Json& value) { return value.is_object(); });
      if (has_objects && take_table(json, pointer, above, key)) return;
      for (const auto& [name, value] : json.items()) note_above(value, name, above, 0);
      for (const auto& [name, value] : json.items())
        if (value.is_structured()) look_at(value, pointer + pointer_part(name), above, name, depth + 1);
      return;
    }
    if (!json.is_array()) return;
    if (take_table(json, pointer, above, key)) return;
    for (std::size_t i = 0; i < json.size(); ++i)
      if (json[i].is_structured()) look_at(json[i], pointer + '/' + std::to_string(i), above, key, depth + 1);
  }

  static void note_above(const Json& json, const std::string& key, Above& above, int depth) {
    constexpr int kDeepest = 3;
    // Of a list of three numbers: a size.
    constexpr std::array<const char*, 3> kSides = {".length", ".width", ".height"};
    if (json.is_array() && json.size() == kSides.size())
      for (std::size_t i = 0; i < kSides.size(); ++i)
        if (json[i].is_number()) note_above(json[i], key + kSides.at(i), above, depth + 1);
    // What stands above is said in a few words.
    constexpr std::size_t kMostMembers = 100;
    if (json.is_object() && depth < kDeepest && json.size() <= kMostMembers)
      for (const auto& [name, value] : json.items()) note_above(value, key + '.' + name, above, depth + 1);
    if (json.is_string()) above.emplace_back(key, json.get<std::string>());
    if (json.is_number()) above.emplace_back(key, number_text(json.get<double>()));
  }

  bool take_table(const Json& list, const std::string& pointer, const Above& above, const std::string& key) {
    auto rows = std::make_unique<JsonRows>(path_, pointer);
    for (const auto& [place, value] : list.items())  // those of a list are its indices
      if (value.is_object()) {
        rows->add_row(value, place);
        if (rows->has_too_many_keys()) return false;
      }
    if (rows->row_count() == 0) return false;
    Result<ColumnPlan> plan = plan_columns(rows->headers(), choices_.columns);
    if (!plan) {
      Error error = plan.error();
      error.file = path_;
      if (!mistake_) mistake_ = error;
      return false;
    }
    if (!plan->has_boxes()) {
      constexpr std::size_t kFewestKeys = 4;  // of what may be boxes
      const bool says_some = plan->has_place() || plan->has_size();
      if ((!says_some && rows->headers().size() < kFewestKeys) ||
          (!nearest_.empty() && (nearest_says_some_ || !says_some)))
        return false;
      nearest_says_some_ = says_some;
      nearest_ = pointer;
      missing_ = missing_columns(*plan);
      keys_.clear();
      for (const std::string& header : rows->headers()) keys_ += (keys_.empty() ? "" : ", ") + header;
      return false;
    }
    Found found{.rows = std::move(rows), .plan = std::move(*plan)};
    read_above(above, found);
    found.is_of_load = is_in_loads(pointer);
    constexpr std::array<std::string_view, 10> kCommon = {"items",  "boxes",  "packages", "placements", "cargo",
                                                          "result", "placed", "packed",   "fitted",     "loads"};
    const bool is_common = std::find(kCommon.begin(), kCommon.end(), key) != kCommon.end() || key.empty() ||
                           key.find("items") != std::string::npos || key.find("boxes") != std::string::npos;
    if (found.load.empty() && !is_common) found.load = key, found.is_named = true;
    if (found.load.empty()) found.load = std::to_string(tables_.size() + 1);
    tables_.push_back(std::move(found));
    return true;
  }

  /// Whether a place is below a list of containers or loads: `/trucks/0/boxes`.
  static bool is_in_loads(const std::string& pointer) {
    const auto is_below = [&](std::string_view word) {
      return pointer.find('/' + std::string(word) + "s/") != std::string::npos;
    };
    return is_below("load") || std::any_of(kContainerWords.begin(), kContainerWords.end(),
                                           [&](std::string_view word) { return word != "pallet" && is_below(word); });
  }

  /// Name and container of a load, from what stands above it; what is nearer comes last and holds.
  static void read_above(const Above& above, Found& found) {
    // `container.size.length`, or `length` alone.
    const auto is_of_container = [](const HeaderWord& word, std::string_view what, bool alone) {
      if (alone && word.word == what) return true;
      constexpr std::array<std::string_view, 7> kBetween = {"",      "size",   "dimensions", "dims",
                                                            "inner", "inside", "internal"};
      for (const std::string_view known : kContainerWords)
        for (const std::string_view between : kBetween)
          if (word.word == std::string(known) + std::string(between) + std::string(what)) return true;
      return false;
    };
    // `length`, `width` and `height`, or `width`, `height` and `depth`, which is the length: all of them, or none.
    std::array<std::optional<double>, 3> size;
    std::optional<double> depth;
    for (const auto& [key, value] : above) {
      const HeaderWord word = header_word(key);
      constexpr std::array<std::string_view, 3> kSizes = {"length", "width", "height"};
      constexpr std::array<std::string_view, 3> kShort = {"l", "w", "h"};
      for (std::size_t axis = 0; axis < 3; ++axis)
        if (is_of_container(word, kSizes.at(axis), true) || is_of_container(word, kShort.at(axis), false)) {
          size.at(axis) = parse_number(value);
          if (word.length_unit > 0.0) found.container_unit = word.length_unit;
        }
      if (is_of_container(word, "depth", true)) depth = parse_number(value);
      if (is_of_container(word, "unit", false))
        if (const auto unit = length_unit(header_word(value).word)) found.container_unit = *unit;
      constexpr std::array<std::string_view, 5> kUnits = {"unit", "units", "lengthunit", "dimensionunit",
                                                          "unitslength"};
      if (std::find(kUnits.begin(), kUnits.end(), word.word) != kUnits.end())
        if (const auto unit = length_unit(header_word(value).word)) found.unit = *unit;
      if (word.word == "weightunit" || word.word == "massunit")
        if (const auto unit = mass_unit(header_word(value).word)) found.mass_unit = *unit;
      // A pallet stands in a container, where there is one.
      const bool is_pallet = word.word.starts_with("pallet") && !found.container.empty();
      if (is_of_container(word, "type", true) && !is_pallet) found.container = value;
      const bool may_name_type = is_of_container(word, "", false) || is_of_container(word, "name", false) ||
                                 is_of_container(word, "id", false);
      if (may_name_type && found.container.empty() && is_container_name(value)) found.container = value;
      if (word.word == "name" || word.word == "id" || is_of_container(word, "name", false) ||
          is_of_container(word, "id", false))
        found.load = value;
    }
    if (!size[0]) size[0] = depth;
    if (size[0] && size[1] && size[2]) found.size = size;
  }

  const std::string& path_;
  const std::string& name_;
  const TableChoices& choices_;
  const Settings& settings_;
  std::vector<Found> tables_;
  std::optional<Error> mistake_;
  std::string nearest_, missing_, keys_;
  bool nearest_says_some_ = false;
};

/// A whole text, or what is wrong with it.
Result<Json> parsed(std::string_view text, long line, const std::string& path) {
  try {
    return Json::parse(text.begin(), text.end());
  } catch (const nlohmann::json::parse_error& error) {
    return json_fault(text, error.byte, error.what(), line, path);
  } catch (const nlohmann::json::exception& error) {
    return json_fault(text, 0, error.what(), line, path);
  }
}

std::string_view first_line_of(std::string_view text) { return trimmed(text.substr(0, text.find('\n'))); }

/// Calls a function with every line that is not blank and its number, until it returns an error.
template <class Take>
std::optional<Error> for_each_line(std::string_view text, Take take) {
  LineReader lines(text);
  while (lines.next()) {
    const std::string_view line = trimmed(lines.line());
    if (line.empty()) continue;
    if (auto error = take(line, lines.number())) return error;
  }
  return std::nullopt;
}

/// The loads of JSON of ours.
/// @param has_lines it has one object per line
Result<LoadsOfFile> own_loads(std::string_view text, const std::string& path, const std::string& name, bool has_lines,
                              const Settings& settings) {
  OwnJson own(path, name, settings);
  const auto take_line = [&](std::string_view line, long number) {
    // The search is for few lines: most have no such key, nor a text like it.
    const bool is_file = line.find("\"holdfast\"") != std::string_view::npos && is_own_json(line);
    return is_file ? own.read_file(line, number) : own.read_load(line, number);
  };
  if (const auto error = has_lines ? for_each_line(text, take_line) : own.read_file(text, 0)) return *error;
  LoadsOfFile loads = own.take();
  loads.form = has_lines ? "JSON, one load per line" : "JSON";
  if (loads.loads.empty())
    return Error{.file = path, .what = "has no loads", .accepted = R"({"holdfast": 1, "loads": [{"boxes": [...]}]})"};
  return loads;
}

/// The loads of any other JSON.
Result<LoadsOfFile> other_loads(std::string_view text, const std::string& path, const std::string& name, bool has_lines,
                                const TableChoices& choices, const Settings& settings) {
  Json root = Json::array();
  const auto take_line = [&](std::string_view line, long number) -> std::optional<Error> {
    Result<Json> json = parsed(line, number, path);
    if (!json) return json.error();
    root.push_back(std::move(*json));
    return std::nullopt;
  };
  if (has_lines) {
    if (const auto error = for_each_line(text, take_line)) return *error;
  } else {
    Result<Json> whole = parsed(text, 1, path);
    if (!whole) return whole.errors();
    root = std::move(*whole);
  }
  Result<LoadsOfFile> loads = TableFinder(path, name, choices, settings).find(root);
  if (loads) loads->form = has_lines ? "JSON of another program, one object per line" : "JSON of another program";
  return loads;
}

}  // namespace

bool looks_like_json(std::string_view text) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  constexpr std::string_view kWhite = " \t\r\n";
  const std::size_t begin = text.find_first_not_of(kWhite);
  if (begin == std::string_view::npos) return false;
  if (text[begin] == '{') return true;
  if (text[begin] != '[') return false;
  const std::size_t second = text.find_first_not_of(kWhite, begin + 1);
  return second != std::string_view::npos && (text[second] == '{' || text[second] == '[');
}

Result<LoadsOfFile> read_json_loads(std::string_view text, const std::string& path, const std::string& name,
                                    const TableChoices& choices, const Settings& settings) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  text = text.substr(std::min(text.find_first_not_of(" \t\r\n"), text.size()));

  // One object per line, where the first line is one and more follow.
  const std::string_view first = first_line_of(text);
  const bool has_more = text.find('\n') != std::string_view::npos && !trimmed(text.substr(text.find('\n'))).empty();
  const bool has_lines = has_more && first.ends_with('}') && Json::accept(first.begin(), first.end());
  if (is_own_json(has_lines ? first : text)) return own_loads(text, path, name, has_lines, settings);
  return other_loads(text, path, name, has_lines, choices, settings);
}

}  // namespace holdfast::internal
