#include "io/loads/own_json.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "core/base/error_list.hpp"
#include "core/base/number_text.hpp"
#include "core/base/utf8.hpp"
#include "core/model/given_container.hpp"
#include "core/model/layout_check.hpp"
#include "core/model/load_limits.hpp"
#include "io/input/text_lines.hpp"
#include "io/loads/json_parts.hpp"
#include "io/loads/json_text.hpp"

namespace holdfast::internal {

namespace {

constexpr std::array<std::string_view, 4> kFileKeys = {"holdfast", "unit", "container", "loads"};
constexpr std::array<std::string_view, 4> kLoadKeys = {"name", "container", "unit", "boxes"};

constexpr const char* kBoxShape = "an object, or a list of seven numbers: two corners and a material";
constexpr const char* kSomeBoxes = "a list with at least one box";

/// Looks for the key `holdfast` of the outermost object, as nlohmann's parser calls it; `false` ends the parser.
class OwnKeySearch {
 public:
  bool is_found() const { return is_found_; }

  bool null() { return depth_ > 0; }
  bool boolean(bool /*value*/) { return depth_ > 0; }
  bool number_integer(std::int64_t /*value*/) { return depth_ > 0; }
  bool number_unsigned(std::uint64_t /*value*/) { return depth_ > 0; }
  bool number_float(double /*value*/, const std::string& /*text*/) { return depth_ > 0; }
  bool string(std::string& /*value*/) { return depth_ > 0; }
  bool binary(nlohmann::json::binary_t& /*value*/) { return false; }
  bool start_object(std::size_t /*count*/) { return ++depth_ > 0; }
  bool key(std::string& value) {
    is_found_ = depth_ == 1 && value == kFileKeys.front();
    return !is_found_;
  }
  bool end_object() { return --depth_ > 0; }
  bool start_array(std::size_t /*count*/) { return depth_++ > 0; }
  bool end_array() { return --depth_ > 0; }
  bool parse_error(std::size_t /*position*/, const std::string& /*token*/,
                   const nlohmann::json::exception& /*exception*/) {
    return false;
  }

 private:
  bool is_found_ = false;
  int depth_ = 0;
};

/// A value in a message.
std::string value_text(const JsonValue& value) {
  switch (value.token) {
    case Token::object_begins:
      return "an object";
    case Token::list_begins:
      return "a list";
    case Token::text:
      return shown('"' + std::string(value.text) + '"');
    case Token::number:
      return number_text(value.number);
    case Token::boolean:
      return value.truth ? "true" : "false";
    default:
      return "null";
  }
}

}  // namespace

bool is_own_json(std::string_view text) {
  OwnKeySearch search;
  nlohmann::json::sax_parse(text.begin(), text.end(), &search);
  return search.is_found();
}

/// Takes what nlohmann's parser reports. It passes over lists and objects that are wrong.
class OwnJson::Reader {
 public:
  Reader(const std::string& path, const std::string& name, const Settings& settings)
      : path_(path), name_(name), settings_(settings), file_errors_(path), errors_(path) {}

  std::optional<Error> read(std::string_view text, bool is_file, long line) {
    is_file_ = is_file;
    line_ = line;
    levels_.clear();
    passed_over_ = 0;
    text_ = text;
    fault_.reset();
    nlohmann::json::sax_parse(text.begin(), text.end(), this);
    if (!fault_) end_text();
    return std::exchange(fault_, std::nullopt);
  }

  LoadsOfFile take() { return std::move(found_); }

  // What nlohmann's parser calls; `false` ends it.
  bool null() { return take({.token = Token::null}); }
  bool boolean(bool value) { return take({.token = Token::boolean, .truth = value}); }
  bool number_integer(std::int64_t value) { return number(static_cast<double>(value)); }
  bool number_unsigned(std::uint64_t value) { return number(static_cast<double>(value)); }
  bool number_float(double value, const std::string& /*text*/) { return number(value); }
  bool string(std::string& value) { return take({.token = Token::text, .text = value}); }
  bool binary(nlohmann::json::binary_t& /*value*/) { return take({.token = Token::null}); }  // not in text
  bool start_object(std::size_t /*count*/) { return take({.token = Token::object_begins}); }
  bool start_array(std::size_t /*count*/) { return take({.token = Token::list_begins}); }
  bool end_object() { return end(); }
  bool end_array() { return end(); }
  bool key(std::string& value) {
    if (passed_over_ > 0) return true;
    levels_.back().key = value;
    take_key(value);
    return true;
  }
  bool parse_error(std::size_t position, const std::string& /*token*/, const nlohmann::json::exception& exception) {
    fault_ = json_fault(text_, position, exception.what(), std::max(line_, 1L), path_);
    return false;
  }

 private:
  enum class FileKey { version, unit, container, loads, none };  // in the order of kFileKeys
  enum class LoadKey { name, container, unit, boxes, none };

  /// What a list or an object is. `none` is passed over.
  enum class What { none, file, loads, load, boxes, box, part_of_box, row, container, part_of_container };

  /// A list or an object around the value at hand.
  struct Level {
    What what = What::none;
    bool is_list = false;
    std::size_t index = 0;  ///< of the value at hand, in a list
    std::string key = {};   ///< of the value at hand, in an object
  };

  bool number(double value) { return take({.token = Token::number, .number = value}); }

  bool take(const JsonValue& value) {
    const bool begins = value.token == Token::object_begins || value.token == Token::list_begins;
    if (passed_over_ > 0) {
      if (begins) ++passed_over_;
      return true;
    }
    const What what = take_value(value);
    if (!begins)
      value_ends();
    else if (what == What::none)
      passed_over_ = 1;
    else
      levels_.push_back({.what = what, .is_list = value.token == Token::list_begins});
    return true;
  }

  bool end() {
    if (passed_over_ > 0) {
      if (--passed_over_ == 0) value_ends();
      return true;
    }
    const What what = levels_.back().what;
    levels_.pop_back();
    end_of(what);
    value_ends();
    return true;
  }

  void value_ends() {
    if (!levels_.empty()) ++levels_.back().index;
  }

  void take_key(std::string_view key) {
    std::size_t index = 0;
    switch (levels_.back().what) {
      case What::file:
        note(file_keys_.give(key, "", index));
        file_key_ = static_cast<FileKey>(index);
        break;
      case What::load:
        note(load_keys_.give(key, "", index));
        load_key_ = static_cast<LoadKey>(index);
        break;
      case What::box:
        note(box_reader_.key(key));
        break;
      case What::container:
        note(container_reader_.key(key));
        break;
      case What::part_of_container:
        note(container_reader_.side(key));
        break;
      default:
        break;
    }
  }

  /// Takes a value, and says what begins with it where it is a list or an object.
  What take_value(const JsonValue& value) {
    if (levels_.empty()) return is_file_ ? begin_file() : begin_load(value);
    switch (levels_.back().what) {
      case What::file:
        return take_of_file(value);
      case What::loads:
        return begin_load(value);
      case What::load:
        return take_of_load(value);
      case What::boxes:
        return begin_box(value);
      case What::box:
        return note(box_reader_.value(value), &value) ? What::none : What::part_of_box;
      case What::part_of_box:
        note(box_reader_.element(value), &value);
        break;
      case What::row:
        take_of_row(value);
        break;
      case What::container:
        return note(container_reader_.value(value), &value) ? What::none : What::part_of_container;
      case What::part_of_container:
        note(container_reader_.element(value), &value);
        break;
      case What::none:
        break;
    }
    return What::none;
  }

  void end_of(What what) {
    switch (what) {
      case What::load:
        return end_load();
      case What::box:
        note(box_reader_.box_ends());
        return add_box(box_reader_.take());
      case What::part_of_box:
        note(box_reader_.list_ends());
        return;
      case What::row:
        return end_row();
      case What::container:
        (in_load_ ? growing_.container : file_container_) = container_reader_.container();
        return;
      case What::part_of_container:
        note(container_reader_.list_ends());
        return;
      default:
        return;
    }
  }

  What begin_file() {
    file_keys_.reset();
    file_unit_.reset();
    file_container_.reset();
    return What::file;
  }

  What take_of_file(const JsonValue& value) {
    switch (file_key_) {
      case FileKey::version:
        if (value.token != Token::number || value.number != 1.0)
          note(Error{.what = "a version that is not known", .accepted = "1"}, &value);
        break;
      case FileKey::unit:
        note(read_unit(value, file_unit_), &value);
        break;
      case FileKey::container:
        return take_container(value, file_container_);
      case FileKey::loads:
        if (value.token == Token::list_begins) return What::loads;
        note(Error{.what = "no list", .accepted = "a list of loads"}, &value);
        break;
      case FileKey::none:
        break;
    }
    return What::none;
  }

  What begin_load(const JsonValue& value) {
    growing_ = {};
    growing_.load.layout.name = name_;
    growing_.load.layout.boxes.reserve(boxes_before_);  // loads of a file are about as large
    load_keys_.reset();
    in_load_ = true;
    if (value.token == Token::object_begins) return What::load;
    note(Error{.what = "no load", .accepted = R"({"name": ..., "boxes": [...]})"}, &value);
    end_load();
    return What::none;
  }

  What take_of_load(const JsonValue& value) {
    switch (load_key_) {
      case LoadKey::name:
        if (value.token == Token::text)
          growing_.load.layout.name = name_ + '#' + kept_name(value.text);
        else
          note(Error{.what = "no text", .accepted = "a text"}, &value);
        break;
      case LoadKey::container:
        return take_container(value, growing_.container);
      case LoadKey::unit:
        note(read_unit(value, growing_.unit), &value);
        break;
      case LoadKey::boxes:
        if (value.token == Token::list_begins) {
          growing_.load.list_pointer = pointer();
          return What::boxes;
        }
        note(Error{.what = "no list of boxes", .accepted = kSomeBoxes}, &value);
        break;
      case LoadKey::none:
        break;
    }
    return What::none;
  }

  void end_load() {
    const std::size_t number = found_.loads.size() + pending_.size() + 1;
    const bool has_name = load_keys_.has(static_cast<std::size_t>(LoadKey::name));
    if (!has_name && (line_ > 0 || number > 1)) growing_.load.layout.name += '#' + std::to_string(number);
    if (errors_.empty() && growing_.load.layout.boxes.empty())
      note(Error{.what = load_keys_.has(static_cast<std::size_t>(LoadKey::boxes)) ? "has no boxes" : "no list of boxes",
                 .accepted = kSomeBoxes});
    growing_.load.errors = errors_.take();
    boxes_before_ = growing_.load.layout.boxes.size();
    in_load_ = false;
    pending_.push_back(std::move(growing_));
  }

  What take_container(const JsonValue& value, std::optional<GivenContainer>& container) {
    container_reader_.begin(line_, pointer());
    if (note(container_reader_.whole(value), &value)) return What::none;
    container = container_reader_.container();
    return What::container;
  }

  What begin_box(const JsonValue& value) {
    mistakes_before_box_ = mistakes_;
    if (levels_.back().index >= kMostBoxes) {
      if (levels_.back().index == kMostBoxes)
        note(Error{.what = "too many boxes", .accepted = "at most " + std::to_string(kMostBoxes)});
      return What::none;
    }
    if (value.token == Token::object_begins) {
      box_reader_.begin("");
      return What::box;
    }
    row_.clear();
    if (value.token == Token::list_begins) return What::row;
    note(Error{.what = "no box", .accepted = kBoxShape}, &value);
    return What::none;
  }

  void take_of_row(const JsonValue& value) {
    const bool is_number = value.token == Token::number;
    const bool is_material = row_.size() == 6;
    if (!is_number || (!is_material && std::abs(value.number) > kMostOfLoad))
      note(Error{.what = is_number ? "not possible" : "no number", .accepted = kBoxShape}, &value);
    if (row_.size() < 8) row_.push_back(value.number);
  }

  void end_row() {
    constexpr std::size_t kNumbers = 7;
    Box box;
    if (row_.size() != kNumbers)
      note(Error{.what = "does not have seven numbers", .accepted = kBoxShape});
    else
      note(box_of_row(row_, 0, box));
    add_box(std::move(box));
  }

  /// Adds a box in which there is no mistake. Its numbers are in the unit of its load.
  void add_box(Box&& box) {
    if (mistakes_ > mistakes_before_box_) return;
    box.line = line_;
    growing_.load.layout.boxes.push_back(std::move(box));
  }

  /// What a file says of all its loads may come after them.
  void end_text() {
    if (!file_errors_.empty()) {
      found_.loads.push_back({.layout = {.name = name_}, .errors = file_errors_.take()});
      pending_.clear();
    }
    for (Growing& growing : pending_) {
      const double unit = growing.unit ? *growing.unit : file_unit_.value_or(1.0);
      if (unit != 1.0)
        for (Box& box : growing.load.layout.boxes) turn_to_metres(box, unit);
      const double unit_of_container = growing.container ? unit : file_unit_.value_or(1.0);
      std::optional<GivenContainer> container = growing.container ? std::move(growing.container) : file_container_;
      if (container && growing.load.errors.empty()) {
        turn_to_metres(*container, unit_of_container);
        growing.load.layout.container = shape_of(*container, settings_, errors_);
        growing.load.errors = errors_.take();
      }
      found_.loads.push_back(std::move(growing.load));
    }
    pending_.clear();
  }

  /// Of the value at hand.
  std::string pointer() const {
    std::string joined;
    for (const Level& level : levels_) joined += pointer_part(level.is_list ? std::to_string(level.index) : level.key);
    return joined;
  }

  /// Adds a mistake, if there is one, with the place of the value at hand. Whether there is one.
  /// @param value at hand, which the message shows
  bool note(Mistake mistake, const JsonValue* value = nullptr) {
    if (!mistake) return false;
    ++mistakes_;
    ErrorList& errors = in_load_ ? errors_ : file_errors_;
    if (errors.full()) {
      errors.count_more();
      return true;
    }
    const std::string place = shown(pointer());
    mistake->line = line_;
    mistake->what = place + (place.empty() ? "" : ": ") + mistake->what;
    mistake->value = value != nullptr ? value_text(*value) : shown(mistake->value);
    errors.add(std::move(*mistake));
    return true;
  }

  /// A load as it comes, in its own unit.
  struct Growing {
    ReadLoad load;
    std::optional<double> unit;  ///< m
    std::optional<GivenContainer> container;
  };

  const std::string& path_;
  const std::string& name_;
  const Settings& settings_;
  LoadsOfFile found_;
  std::vector<Growing> pending_;  ///< loads of the text at hand

  bool is_file_ = false;
  long line_ = 0;
  std::string_view text_;
  std::optional<Error> fault_;
  std::vector<Level> levels_;
  std::size_t passed_over_ = 0;  ///< lists and objects around the value at hand that are passed over

  ErrorList file_errors_;
  KeySet<kFileKeys.size()> file_keys_{kFileKeys};
  FileKey file_key_ = FileKey::none;
  std::optional<double> file_unit_;
  std::optional<GivenContainer> file_container_;

  bool in_load_ = false;
  ErrorList errors_;  ///< of the load
  Growing growing_;
  std::size_t boxes_before_ = 0;  ///< in the load before
  KeySet<kLoadKeys.size()> load_keys_{kLoadKeys};
  LoadKey load_key_ = LoadKey::none;

  std::size_t mistakes_ = 0;  ///< of all that was read
  std::size_t mistakes_before_box_ = 0;
  BoxReader box_reader_;
  ContainerReader container_reader_;
  std::vector<double> row_;  ///< of a box that is a list
};

OwnJson::OwnJson(const std::string& path, const std::string& name, const Settings& settings)
    : reader_(std::make_unique<Reader>(path, name, settings)) {}

OwnJson::~OwnJson() = default;

std::optional<Error> OwnJson::read_file(std::string_view text, long line) { return reader_->read(text, true, line); }

std::optional<Error> OwnJson::read_load(std::string_view text, long line) { return reader_->read(text, false, line); }

LoadsOfFile OwnJson::take() { return reader_->take(); }

}  // namespace holdfast::internal
