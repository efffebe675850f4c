#include "io/loads/json_loads.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "core/base/closest_word.hpp"
#include "core/base/error_list.hpp"
#include "core/base/number_text.hpp"
#include "core/base/utf8.hpp"
#include "core/model/container_catalogue.hpp"
#include "core/model/container_sides.hpp"
#include "core/model/layout_check.hpp"
#include "core/model/length_unit.hpp"
#include "io/input/layout_reader.hpp"
#include "io/input/text_lines.hpp"

namespace holdfast::internal {

namespace {

using Json = nlohmann::ordered_json;

/// A part of a JSON pointer (RFC 6901).
std::string pointer_part(std::string_view key) {
  std::string part;
  for (const char letter : key) part += letter == '~' ? "~0" : letter == '/' ? "~1" : std::string(1, letter);
  return part;
}

std::string type_text(const Json& json) {
  if (json.is_object()) return "an object";
  if (json.is_array()) return "a list";
  return shown(json.dump(-1, ' ', false, Json::error_handler_t::replace));
}

/// Reads JSON of ours.
class OwnReader {
 public:
  OwnReader(const std::string& path, const std::string& name, const Settings& settings)
      : path_(path), name_(name), settings_(settings) {}

  /// The object with `holdfast`; loads of it are added.
  void read_root(const Json& root, long line) {
    line_ = line;
    errors_ = ErrorList(path_);
    constexpr std::array<std::string_view, 4> kKeys = {"holdfast", "unit", "container", "loads"};
    check_keys(root, "", kKeys);
    if (const auto version = root.find("holdfast"); version != root.end() && *version != 1)
      wrong("/holdfast", "a version that is not known", type_text(*version), "1");
    unit_ = unit_of_load_ = read_unit(root, "", 1.0);
    if (const auto container = root.find("container"); container != root.end())
      container_ = read_container(*container, "/container");
    const auto loads = root.find("loads");
    if (loads != root.end() && !loads->is_array()) wrong("/loads", "no list", type_text(*loads), "a list of loads");
    if (!errors_.empty()) {
      found_.loads.push_back({.layout = {.name = name_}, .errors = errors_.take()});
      return;
    }
    if (loads == root.end() || !loads->is_array()) return;
    for (std::size_t i = 0; i < loads->size(); ++i) read_load((*loads)[i], "/loads/" + std::to_string(i), line);
  }

  /// One load.
  void read_load(const Json& json, const std::string& at, long line) {
    line_ = line;
    errors_ = ErrorList(path_);
    ReadLoad load;
    load.layout.name = name_;
    if (json.is_object()) {
      constexpr std::array<std::string_view, 4> kKeys = {"name", "container", "unit", "boxes"};
      check_keys(json, at, kKeys);
      if (const auto name = json.find("name"); name != json.end()) {
        if (name->is_string())
          load.layout.name += '#' + kept_name(name->get_ref<const std::string&>());
        else
          wrong(at + "/name", "no text", type_text(*name), "a text");
      } else if (line_ > 0 || found_.loads.size() > 0) {
        load.layout.name += '#' + std::to_string(found_.loads.size() + 1);
      }
      unit_of_load_ = read_unit(json, at, unit_);
      load.layout.container = container_;
      if (const auto container = json.find("container"); container != json.end())
        load.layout.container = read_container(*container, at + "/container");
      read_boxes(json, at, load.layout);
    } else {
      wrong(at, "no load", type_text(json), R"({"name": ..., "boxes": [...]})");
    }
    load.errors = errors_.take();
    found_.loads.push_back(std::move(load));
  }

  LoadsOfFile take() { return std::move(found_); }

 private:
  void wrong(const std::string& at, std::string what, std::string value, std::string accepted) {
    if (errors_.full()) return errors_.count_more();
    errors_.add({.line = line_,
                 .what = shown(at) + (at.empty() ? "" : ": ") + std::move(what),
                 .value = std::move(value),
                 .accepted = std::move(accepted)});
  }

  void check_keys(const Json& object, const std::string& at, std::span<const std::string_view> keys) {
    for (const auto& [key, value] : object.items()) {
      if (std::find(keys.begin(), keys.end(), key) != keys.end()) continue;
      const auto meant = closest_word(key, keys);
      std::string accepted = "accepted are";
      for (const std::string_view known : keys) accepted += ' ' + std::string(known);
      wrong(at + '/' + pointer_part(key), "unknown key", shown(key),
            meant ? "did you mean '" + std::string(*meant) + "'?" : accepted);
    }
  }

  double read_unit(const Json& object, const std::string& at, double otherwise) {
    const auto unit = object.find("unit");
    if (unit == object.end()) return otherwise;
    const auto factor = unit->is_string() ? length_unit(unit->get_ref<const std::string&>()) : std::nullopt;
    if (!factor) wrong(at + "/unit", "no unit of length", type_text(*unit), "m, dm, cm, mm, in or ft");
    return factor.value_or(otherwise);
  }

  std::optional<double> read_number(const Json& json, const std::string& at, double least) {
    constexpr double kMost = 1e6;
    const double number = json.is_number() ? json.get<double>() : 0.0;
    if (json.is_number() && number >= least && number <= kMost) return number;
    wrong(at, json.is_number() ? "not possible" : "no number", type_text(json),
          least == -kMost ? "a number"
          : least > 0.0   ? "a number above 0"
                          : "a number from 0");
    return std::nullopt;
  }

  /// Three lengths in a unit, as metres.
  std::optional<Vec3> read_vector(const Json& json, const std::string& at, double unit, double least) {
    if (!json.is_array() || json.size() != 3) {
      wrong(at, "not three numbers", type_text(json), "a list of three numbers");
      return std::nullopt;
    }
    Vec3 vector;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto number = read_number(json[i], at + '/' + std::to_string(i), least);
      if (!number) return std::nullopt;
      vector[static_cast<Eigen::Index>(i)] = in_metres(*number, unit);
    }
    return vector;
  }

  std::optional<ContainerShape> read_container(const Json& json, const std::string& at) {
    const auto find_type = [&](const Json& name, const std::string& where) -> const ContainerType* {
      const ContainerType* const type = name.is_string() ? find_container(name.get_ref<const std::string&>()) : nullptr;
      if (type == nullptr)
        wrong(where, "no type of container", type_text(name), "a name that `holdfast containers` lists, such as 40hc");
      return type;
    };
    if (!json.is_object()) {
      const ContainerType* const type = find_type(json, at);
      return type == nullptr ? std::nullopt : std::optional(type->shape());
    }
    constexpr std::array<std::string_view, 5> kKeys = {"type", "size", "open_sides", "drop_sides", "bed_height"};
    check_keys(json, at, kKeys);
    ContainerShape shape = settings_.container;
    shape.type.clear();
    if (const auto type = json.find("type"); type != json.end())
      if (const ContainerType* const known = find_type(*type, at + "/type")) shape = known->shape();
    if (const auto size = json.find("size"); size != json.end())
      if (const auto vector = read_vector(*size, at + "/size", unit_of_load_, 1e-3 / unit_of_load_))
        shape.size = *vector;
    if (const auto sides = json.find("open_sides"); sides != json.end()) {
      shape.open_sides.clear();
      for (const Json& side : *sides) {
        const bool is_side = side.is_string() && can_be_open(side.get_ref<const std::string&>());
        if (is_side)
          shape.open_sides.push_back(side.get<std::string>());
        else
          wrong(at + "/open_sides", "no side", type_text(side), "front, rear, left, right or roof");
      }
    }
    if (const auto sides = json.find("drop_sides"); sides != json.end()) {
      shape.drop_sides.clear();
      for (const auto& [side, height] : sides->items()) {
        if (!can_be_open(side) || side == "roof")
          wrong(at + "/drop_sides", "no wall", shown(side), "front, rear, left or right");
        else if (const auto number = read_number(height, at + "/drop_sides/" + side, 1e-3))
          shape.drop_sides.push_back({side, in_metres(*number, unit_of_load_)});
      }
    }
    for (const DropSide& drop : shape.drop_sides)
      if (std::find(shape.open_sides.begin(), shape.open_sides.end(), drop.side) != shape.open_sides.end())
        wrong(at + "/drop_sides", "a side that is open as well", drop.side, "each side in one of the two");
    if (const auto bed = json.find("bed_height"); bed != json.end())
      if (const auto number = read_number(*bed, at + "/bed_height", 0.0))
        shape.bed_height = in_metres(*number, unit_of_load_);
    return shape;
  }

  void read_boxes(const Json& load, const std::string& at, Layout& layout) {
    const auto boxes = load.find("boxes");
    if (boxes == load.end() || !boxes->is_array() || boxes->empty()) {
      const bool is_there = boxes != load.end();
      return wrong(at + "/boxes", is_there && boxes->is_array() ? "has no boxes" : "no list of boxes",
                   is_there ? type_text(*boxes) : "", "a list with at least one box");
    }
    if (boxes->size() > kMostBoxes)
      return wrong(at + "/boxes", "too many boxes", std::to_string(boxes->size()),
                   "at most " + std::to_string(kMostBoxes));
    layout.boxes.reserve(boxes->size());
    for (std::size_t i = 0; i < boxes->size(); ++i) read_box((*boxes)[i], at + "/boxes/" + std::to_string(i), layout);
  }

  void read_box(const Json& json, const std::string& at, Layout& layout) {
    Box box;
    box.line = line_;
    if (json.is_array()) return read_row(json, at, layout);
    if (!json.is_object()) return wrong(at, "no box", type_text(json), "an object with corner_min and corner_max");
    constexpr std::array<std::string_view, 10> kKeys = {"corner_min", "corner_max",   "name",           "material",
                                                        "mass",       "mat",          "centre_of_mass", "fixed",
                                                        "order",      "bearing_limit"};
    check_keys(json, at, kKeys);
    const auto with = [&](const char* key, auto read) {
      if (const auto value = json.find(key); value != json.end()) read(*value, at + '/' + key);
    };
    constexpr double kAny = -1e6;
    int corners = 0;
    with("corner_min", [&](const Json& value, const std::string& where) {
      if (const auto corner = read_vector(value, where, unit_of_load_, kAny)) box.corner_min = *corner, ++corners;
    });
    with("corner_max", [&](const Json& value, const std::string& where) {
      if (const auto corner = read_vector(value, where, unit_of_load_, kAny)) box.corner_max = *corner, ++corners;
    });
    for (const char* const key : {"corner_min", "corner_max"})
      if (!json.contains(key)) wrong(at, std::string("has no ") + key, "", "two corners, each a list of three numbers");
    box.material = MaterialName(kUsualMaterial);
    with("name", [&](const Json& value, const std::string& where) {
      if (!value.is_string()) return wrong(where, "no text", type_text(value), "a text");
      box.name = kept_name(value.get_ref<const std::string&>());
    });
    with("material", [&](const Json& value, const std::string& where) {
      if (value.is_string())
        box.material = MaterialName(kept_name(value.get_ref<const std::string&>()));
      else if (value.is_number_integer() && value >= 0 && value <= std::numeric_limits<int>::max())
        box.material = MaterialName(value.get<int>());
      else
        wrong(where, "no material", type_text(value), "a name or a whole number from 0");
    });
    with("mass", [&](const Json& v, const std::string& where) { box.mass = read_number(v, where, 1e-6); });
    with("mat", [&](const Json& v, const std::string& where) { box.mat = read_number(v, where, 0.0); });
    with("bearing_limit",
         [&](const Json& v, const std::string& where) { box.bearing_limit = read_number(v, where, 0.0); });
    with("centre_of_mass", [&](const Json& value, const std::string& where) {
      box.centre_of_mass = read_vector(value, where, unit_of_load_, kAny);
    });
    with("fixed", [&](const Json& value, const std::string& where) {
      if (!value.is_boolean()) return wrong(where, "neither true nor false", type_text(value), "true or false");
      box.fixed = value.get<bool>();
    });
    with("order", [&](const Json& value, const std::string& where) {
      if (!value.is_number_integer()) return wrong(where, "no whole number", type_text(value), "such as 1");
      box.order = value.get<long>();
    });
    if (corners == 2) layout.boxes.push_back(std::move(box));
  }

  /// A box as a list of seven numbers: two corners and a material.
  void read_row(const Json& json, const std::string& at, Layout& layout) {
    const bool is_row =
        json.size() == 7 && std::all_of(json.begin(), json.end(), [](const Json& n) { return n.is_number(); });
    if (!is_row || !json[6].is_number_integer() || json[6] < 0 || json[6] > std::numeric_limits<int>::max())
      return wrong(at, "no box", type_text(json), "an object, or a list of seven numbers: two corners and a material");
    Box box;
    box.line = line_;
    for (std::size_t i = 0; i < 6; ++i) {
      const auto number = read_number(json[i], at + '/' + std::to_string(i), -1e6);
      if (!number) return;
      (i < 3 ? box.corner_min : box.corner_max)[static_cast<Eigen::Index>(i % 3)] = in_metres(*number, unit_of_load_);
    }
    box.material = MaterialName(json[6].get<int>());
    layout.boxes.push_back(std::move(box));
  }

  const std::string& path_;
  const std::string& name_;
  const Settings& settings_;
  ErrorList errors_{""};
  LoadsOfFile found_;
  std::optional<ContainerShape> container_;  ///< of all loads
  double unit_ = 1.0;
  double unit_of_load_ = 1.0;
  long line_ = 0;
};

/// A list of objects as a table.
class JsonRows final : public LoadRows {
 public:
  JsonRows(const std::string& path, std::string pointer) : path_(path), pointer_(std::move(pointer)) {}

  /// What stands above all rows.
  void add_above(const std::string& key, const std::string& value) { above_.emplace_back(key, value); }
  void add_row(const Json& object, std::size_t index) {
    std::vector<std::pair<std::string, std::string>> values;
    flatten(object, "", values, 0);
    std::vector<std::string>& row = rows_.emplace_back();
    indices_.push_back(index);
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
    std::string pointer = pointer_ + '/' + std::to_string(indices_[at_ - 1]);
    if (column >= 0) {
      std::string key = '/' + pointer_part(headers_[static_cast<std::size_t>(column)]);
      std::replace(key.begin(), key.end(), '.', '/');
      pointer += key;
    }
    return {.file = path_, .what = shown(pointer) + ": " + std::move(what)};
  }
  long line() const override { return 0; }

  const std::string& pointer() const { return pointer_; }
  std::size_t row_count() const { return rows_.size(); }

 private:
  static void flatten(const Json& json, const std::string& key,
                      std::vector<std::pair<std::string, std::string>>& values, int depth) {
    if (depth > kDeepestJson) return;
    const auto below = [&](const std::string& part) { return key.empty() ? part : key + '.' + part; };
    if (json.is_object()) {
      for (const auto& [name, value] : json.items()) flatten(value, below(name), values, depth + 1);
    } else if (json.is_array()) {
      constexpr std::size_t kMostNumbers = 8;
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
  std::vector<std::size_t> indices_;
  std::vector<std::pair<std::string, std::string>> above_;
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
    look_at(root, "", {}, "", 0);
    if (tables_.empty()) {
      Error error{.file = path_, .what = "no list of boxes with places and sizes is found"};
      if (!nearest_.empty()) error.value = "the list " + shown(nearest_) + " lacks " + missing_;
      error.accepted = "a list of objects with keys such as x, y, z, length, width, height; or --columns";
      if (mistake_) return *mistake_;
      return error;
    }
    LoadsOfFile found;
    for (const Found& table : tables_) {
      TableContext context{.path = path_, .name = name_};
      context.load = tables_.size() > 1 || table.is_named ? table.load : "";
      context.container = table.container;
      context.container_size = table.size;
      LoadsOfFile more = read_table(*table.rows, table.plan, context, choices_, settings_);
      for (ReadLoad& load : more.loads) found.loads.push_back(std::move(load));
      for (Error& note : more.notes)
        if (std::none_of(found.notes.begin(), found.notes.end(),
                         [&](const Error& known) { return known.message() == note.message(); }))
          found.notes.push_back(std::move(note));
    }
    return found;
  }

 private:
  struct Found {
    std::unique_ptr<JsonRows> rows;
    ColumnPlan plan;
    std::string load;
    bool is_named = false;  ///< by its own key, not by a word that all files have
    std::string container;
    std::array<std::optional<double>, 3> size;
  };

  void look_at(const Json& json, const std::string& pointer, Above above, const std::string& key, int depth) {
    if (depth > kDeepestJson) return;
    if (json.is_object()) {
      for (const auto& [name, value] : json.items())
        if (!value.is_array()) note_above(value, name, above, 0);
      for (const auto& [name, value] : json.items())
        if (value.is_structured()) look_at(value, pointer + '/' + pointer_part(name), above, name, depth + 1);
      return;
    }
    if (!json.is_array()) return;
    if (take_table(json, pointer, above, key)) return;
    for (std::size_t i = 0; i < json.size(); ++i)
      if (json[i].is_structured()) look_at(json[i], pointer + '/' + std::to_string(i), above, key, depth + 1);
  }

  static void note_above(const Json& json, const std::string& key, Above& above, int depth) {
    constexpr int kDeepest = 3;
    if (json.is_object() && depth < kDeepest)
      for (const auto& [name, value] : json.items()) note_above(value, key + '.' + name, above, depth + 1);
    if (json.is_string()) above.emplace_back(key, json.get<std::string>());
    if (json.is_number()) above.emplace_back(key, number_text(json.get<double>()));
  }

  bool take_table(const Json& list, const std::string& pointer, const Above& above, const std::string& key) {
    auto rows = std::make_unique<JsonRows>(path_, pointer);
    for (std::size_t i = 0; i < list.size(); ++i)
      if (list[i].is_object()) rows->add_row(list[i], i);
    if (rows->row_count() == 0) return false;
    Result<ColumnPlan> plan = plan_columns(rows->headers(), choices_.columns);
    if (!plan) {
      Error error = plan.error();
      error.file = path_;
      if (!mistake_) mistake_ = error;
      return false;
    }
    if (!plan->has_boxes()) {
      if (nearest_.empty() && (plan->has_place() || plan->has_size())) {
        nearest_ = pointer;
        missing_ = missing_columns(*plan);
      }
      return false;
    }
    Found found{.rows = std::move(rows), .plan = std::move(*plan)};
    read_above(above, found);
    constexpr std::array<std::string_view, 10> kCommon = {"items",  "boxes",  "packages", "placements", "cargo",
                                                          "result", "placed", "packed",   "fitted",     "loads"};
    const bool is_common = std::find(kCommon.begin(), kCommon.end(), key) != kCommon.end() || key.empty() ||
                           key.find("items") != std::string::npos || key.find("boxes") != std::string::npos;
    if (found.load.empty() && !is_common) found.load = key, found.is_named = true;
    if (found.load.empty()) found.load = std::to_string(tables_.size() + 1);
    tables_.push_back(std::move(found));
    return true;
  }

  /// Name and container of a load, from what stands above it; what is nearer comes last and holds.
  static void read_above(const Above& above, Found& found) {
    const auto is_of_container = [](const HeaderWord& word, std::string_view what) {
      return word.word == what ||
             std::any_of(kContainerWords.begin(), kContainerWords.end(), [&](std::string_view known) {
               return word.word == std::string(known) + std::string(what) ||
                      word.word == std::string(known) + "size" + std::string(what) ||
                      word.word == std::string(known) + "dimensions" + std::string(what);
             });
    };
    for (const auto& [key, value] : above) {
      const HeaderWord word = header_word(key);
      constexpr std::array<std::string_view, 3> kSizes = {"length", "width", "height"};
      for (std::size_t axis = 0; axis < 3; ++axis)
        if (is_of_container(word, kSizes.at(axis))) found.size.at(axis) = parse_number(value);
      if (is_of_container(word, "type")) found.container = value;
      if (word.word == "name" || word.word == "id" || is_of_container(word, "name") || is_of_container(word, "id"))
        found.load = value;
    }
  }

  const std::string& path_;
  const std::string& name_;
  const TableChoices& choices_;
  const Settings& settings_;
  std::vector<Found> tables_;
  std::optional<Error> mistake_;
  std::string nearest_, missing_;
};

/// Where a byte is, as an error.
Error at_byte(std::string_view text, std::size_t byte, long line_before, const std::string& path, std::string what) {
  byte = std::min(byte, text.size());
  const std::string_view before = text.substr(0, byte);
  const long line = line_before + static_cast<long>(std::count(before.begin(), before.end(), '\n'));
  const std::size_t begin = before.rfind('\n') == std::string_view::npos ? 0 : before.rfind('\n') + 1;
  return {.file = path, .line = line, .column = static_cast<long>(byte - begin) + 1, .what = std::move(what)};
}

/// A whole text, or what is wrong with it.
Result<Json> parsed(std::string_view text, long line, const std::string& path) {
  try {
    return Json::parse(text.begin(), text.end());
  } catch (const nlohmann::json::parse_error& error) {
    Error wrong = at_byte(text, error.byte > 0 ? error.byte - 1 : 0, line, path, "the text is not JSON");
    constexpr std::string_view kExpected = "; expected ";
    const std::string reason = error.what();
    if (const std::size_t place = reason.find(kExpected); place != std::string::npos)
      wrong.accepted = printable(reason.substr(place + kExpected.size()));
    return wrong;
  } catch (const nlohmann::json::exception&) {
    return Error{.file = path, .what = "a number that is too large"};
  }
}

std::string_view first_line_of(std::string_view text) { return trimmed(text.substr(0, text.find('\n'))); }

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
  if (has_more && first.ends_with('}') && Json::accept(first.begin(), first.end())) {
    const Result<Json> head = parsed(first, 1, path);
    const bool is_own = head && head->is_object() && head->contains("holdfast");
    OwnReader own(path, name, settings);
    Json rows = Json::array();
    LineReader lines(text);
    while (lines.next()) {
      const std::string_view line = trimmed(lines.line());
      if (line.empty()) continue;
      Result<Json> json = parsed(line, lines.number(), path);
      if (!json) return json.errors();
      if (!is_own)
        rows.push_back(std::move(*json));
      else if (json->is_object() && json->contains("holdfast"))
        own.read_root(*json, lines.number());
      else
        own.read_load(*json, "", lines.number());
    }
    if (is_own) return own.take();
    return TableFinder(path, name, choices, settings).find(rows);
  }
  const Result<Json> root = parsed(text, 1, path);
  if (!root) return root.errors();
  if (root->is_object() && root->contains("holdfast")) {
    OwnReader own(path, name, settings);
    own.read_root(*root, 0);
    LoadsOfFile loads = own.take();
    if (loads.loads.empty())
      return Error{.file = path, .what = "has no loads", .accepted = R"({"holdfast": 1, "loads": [{"boxes": [...]}]})"};
    return loads;
  }
  return TableFinder(path, name, choices, settings).find(*root);
}

}  // namespace holdfast::internal
