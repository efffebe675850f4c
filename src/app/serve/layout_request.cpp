#include "app/serve/layout_request.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>

#include "api/convert.hpp"
#include "core/base/utf8.hpp"
#include "core/model/length_unit.hpp"
#include "io/loads/json_parts.hpp"
#include "io/loads/json_text.hpp"

namespace holdfast::internal {

namespace {

constexpr std::array<const char*, 7> kNumbers = {"x1", "y1", "z1", "x2", "y2", "z2", "material"};
constexpr std::array<std::string_view, 8> kKeys = {"id",      "boxes",  "unit", "accelerations",
                                                   "per_box", "series", "name", "container"};
enum class Key : std::size_t { id, boxes, unit, accelerations, per_box, series, name, container, unknown };

constexpr const char* kBoxesShape =
    "a list of boxes, each a list of seven numbers: two corners and a material; or an object with corner_min and "
    "corner_max";

/// An iterator over the line that tells how far the parser has come.
class Cursor {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  Cursor(const char* at, const char** furthest) : at_(at), furthest_(furthest) {}
  const char& operator*() const { return *at_; }
  Cursor& operator++() {
    *furthest_ = ++at_;
    return *this;
  }
  bool operator==(const Cursor& other) const { return at_ == other.at_; }
  bool operator!=(const Cursor& other) const { return at_ != other.at_; }

 private:
  const char* at_;
  const char** furthest_;
};

/// Where the number ends that the parser has found there.
std::size_t end_of_number(std::string_view line, std::size_t at) {
  const auto is_one_of = [&](std::string_view some) {
    return at < line.size() && some.find(line[at]) != std::string_view::npos;
  };
  const auto pass_digits = [&] { at = std::min(line.find_first_not_of("0123456789", at), line.size()); };
  if (is_one_of("-")) ++at;
  if (is_one_of("0"))  // after which other digits are another number
    ++at;
  else
    pass_digits();
  if (is_one_of(".")) {
    ++at;
    pass_digits();
  }
  if (is_one_of("eE")) {
    ++at;
    if (is_one_of("+-")) ++at;
    pass_digits();
  }
  return at;
}

/// Takes the line apart as it is parsed, without a tree in memory. After a mistake it goes on for the id alone.
class RequestReader {
 public:
  RequestReader(std::string_view line, std::span<const std::string> accelerations)
      : line_(line), names_(accelerations), furthest_(line.data()) {}

  ReadRequest read() {
    const char* unused = nullptr;
    const char* const end = line_.data() + line_.size();
    const bool complete = nlohmann::json::sax_parse(Cursor(line_.data(), &furthest_), Cursor(end, &unused), this);
    // The parser takes a zero byte for the end.
    if (complete && line_.find('\0') != std::string_view::npos) wrong("the line has a zero byte", "", "text");
    if (complete && !given(Key::boxes)) wrong("boxes are missing", "", kBoxesShape);
    if (!error_) finish_layout();
    return {std::move(request_), std::move(error_)};
  }

  // What nlohmann's parser calls; `false` would end it.
  bool null() { return take(Token::null); }
  bool boolean(bool value) {
    truth_ = value;
    return take(Token::boolean);
  }
  bool number_integer(std::int64_t value) { return number(static_cast<double>(value)); }
  bool number_unsigned(std::uint64_t value) { return number(static_cast<double>(value)); }
  bool number_float(double value, const std::string& /*text*/) { return number(value); }
  bool string(std::string& value) {
    text_ = value;
    return take(Token::text);
  }
  bool binary(nlohmann::json::binary_t& /*value*/) { return take(Token::null); }  // not in text
  bool start_object(std::size_t /*count*/) { return take(Token::object_begins); }
  bool key(std::string& value) {
    text_ = value;
    return take(Token::key);
  }
  bool end_object() { return take(Token::object_ends); }
  bool start_array(std::size_t /*count*/) { return take(Token::list_begins); }
  bool end_array() { return take(Token::list_ends); }
  bool parse_error(std::size_t position, const std::string& /*token*/, const nlohmann::json::exception& exception) {
    note_syntax(position, exception.what());
    return false;
  }

 private:
  bool number(double value) {
    number_ = value;
    return take(Token::number);
  }

  bool take(Token token) {
    begin_ = begin_of_next();
    end_ = static_cast<std::size_t>(furthest_ - line_.data());
    // Of a number the parser has seen one more character, if there is one.
    if (token == Token::number) end_ = end_of_number(line_, begin_);
    if (token == Token::object_ends || token == Token::list_ends) {
      --depth_;
      end_of_group();
    } else if (token == Token::key) {
      if (depth_ == 1 && is_object_) take_key();
      if (depth_ > 1 && is_object_) take_inner_key();
    } else {
      take_value(token);
      if (token == Token::object_begins || token == Token::list_begins) ++depth_;
    }
    return true;
  }

  void take_key() {
    std::size_t index = 0;
    note_if(given_.give(text_, "", index));
    key_ = static_cast<Key>(index);
  }

  /// A key of an object within the line's.
  void take_inner_key() {
    if (error_) return;
    if (key_ == Key::boxes && depth_ == 3 && box_is_object_) note_in_box(0, box_reader_.key(text_));
    if (key_ == Key::container && depth_ == 2) note_if(container_reader_.key(text_));
    if (key_ == Key::container && depth_ == 3) note_if(container_reader_.side(text_));
  }

  void take_value(Token token) {
    if (depth_ == 0) {
      is_object_ = token == Token::object_begins;
      if (!is_object_) wrong("the line is not an object", shown(), R"({"id": ..., "boxes": [[...], ...]})");
      return;
    }
    if (!is_object_) return;
    switch (key_) {
      case Key::id:
        return take_id(token);
      case Key::boxes:
        return take_boxes(token);
      case Key::unit:
        return take_unit(token);
      case Key::accelerations:
        return take_acceleration(token);
      case Key::per_box:
        return take_flag(token, request_.options.per_box);
      case Key::series:
        return take_flag(token, request_.options.series);
      case Key::name:
        return take_name(token);
      case Key::container:
        return take_container(token);
      case Key::unknown:
        return;
    }
  }

  void take_id(Token token) {
    if (depth_ > 1) return;
    id_begin_ = begin_;
    if (token != Token::object_begins && token != Token::list_begins) end_of_id();
  }

  void end_of_id() {
    request_.id = line_.substr(id_begin_, end_ - id_begin_);
    // Between values JSON may have a carriage return, which some readers of the answer take for the end of a line.
    std::replace(request_.id.begin(), request_.id.end(), '\r', ' ');
  }

  void take_boxes(Token token) {
    if (depth_ == 1) {
      if (token != Token::list_begins) wrong("boxes are not a list", shown(), kBoxesShape);
    } else if (depth_ == 2) {
      begin_box(token);
    } else if (depth_ == 3 && !box_is_object_) {
      take_box_number(token);
    } else if (error_) {
      return;
    } else if (depth_ == 3) {
      note_in_box(0, box_reader_.value(value_of(token)));
    } else if (depth_ == 4 && box_is_object_) {
      note_in_box(0, box_reader_.element(value_of(token)));
    }
  }

  void begin_box(Token token) {
    request_.places.push_back(begin_);
    box_is_object_ = token == Token::object_begins;
    if (box_is_object_)
      box_reader_.begin(box_name());
    else if (token != Token::list_begins)
      wrong_in_box(0, box_name() + " is neither a list nor an object", shown());
    // From the first object on, boxes are boxes of a layout.
    if (box_is_object_ && !boxes_) take_rows();
    numbers_before_ = request_.numbers.size();
  }

  void take_box_number(Token token) {
    const std::size_t index = request_.numbers.size() - numbers_before_;
    if (token != Token::number) {
      const std::string name = index < kNumbers.size() ? kNumbers.at(index) : "a number";
      wrong_in_box(static_cast<long>(index) + 1, name + " of " + box_name() + " is not a number", shown());
    }
    request_.numbers.push_back(number_);
  }

  void end_of_box() {
    if (box_is_object_) {
      if (error_) return;
      begin_ = request_.places.back();
      note_in_box(0, box_reader_.box_ends());
      request_.number_places.emplace(request_.places.size() - 1, box_reader_.places());
      boxes_->push_back(box_reader_.take());
      return;
    }
    const std::size_t count = request_.numbers.size() - numbers_before_;
    if (count != kNumbers.size()) {
      begin_ = request_.places.back();
      return wrong_in_box(0, box_name() + " does not have seven numbers", fmt::format("{} numbers", count));
    }
    if (boxes_) take_rows();
  }

  /// Makes boxes of the layout of the rows that have been read. After a mistake only the id matters.
  void take_rows() {
    if (!boxes_) boxes_.emplace();
    std::vector<Box>& boxes = *boxes_;
    const std::vector<double> numbers = std::exchange(request_.numbers, {});
    for (std::size_t i = 0; !error_ && i + kNumbers.size() <= numbers.size(); i += kNumbers.size()) {
      const std::size_t box = boxes.size();
      Mistake wrong = box_of_row(std::span(numbers).subspan(i, kNumbers.size()), box + 1, boxes.emplace_back());
      if (!wrong) continue;
      wrong->box = static_cast<long>(box) + 1;
      wrong->box_number = static_cast<long>(kNumbers.size());
      note(std::move(*wrong));
      error_->column = column_of(line_, request_, static_cast<std::ptrdiff_t>(box), kNumbers.size() - 1);
    }
  }

  void take_name(Token token) {
    if (token != Token::text) wrong("the name is not a text", shown(), "a text");
  }

  void take_container(Token token) {
    if (error_) return;
    if (depth_ == 1) note_if(container_reader_.whole(value_of(token)));
    if (depth_ == 2) note_if(container_reader_.value(value_of(token)));
    if (depth_ == 3) note_if(container_reader_.element(value_of(token)));
  }

  /// What needs the whole line: the container, and units that a screen does not have.
  void finish_layout() {
    if (given(Key::container) && !boxes_) take_rows();
    if (error_) return;
    const bool is_own_unit = unit_factor_ == 1.0 || unit_factor_ == 0.01;
    if (unit_factor_ == 0.01) request_.options.unit = holdfast::LengthUnit::centimetre;
    for (std::size_t i = 0; !is_own_unit && i < request_.numbers.size(); ++i)
      if (i % kNumbers.size() != kNumbers.size() - 1)
        request_.numbers[i] = in_metres(request_.numbers[i], unit_factor_);
    if (!boxes_) return;
    request_.layout.emplace();
    for (Box& box : *boxes_) {
      if (!is_own_unit) turn_to_metres(box, unit_factor_);
      request_.layout->boxes.push_back(public_box(box));
    }
    if (!given(Key::container)) return;
    GivenContainer container = container_reader_.container();
    if (!is_own_unit) turn_to_metres(container, unit_factor_);
    request_.layout->container = public_container(container);
  }

  void take_unit(Token token) {
    std::optional<double> factor;
    note_if(read_unit(value_of(token), factor));
    unit_factor_ = factor.value_or(unit_factor_);
  }

  void take_acceleration(Token token) {
    const std::string accepted = "a list of some of " + fmt::format("{}", fmt::join(names_, ", "));
    if (depth_ == 1) {
      if (token != Token::list_begins) wrong("accelerations are not a list", shown(), accepted);
      return;
    }
    const auto found = token == Token::text ? std::find(names_.begin(), names_.end(), text_) : names_.end();
    if (found == names_.end()) return wrong("unknown acceleration", shown(), accepted);
    std::vector<std::size_t>& chosen = request_.options.accelerations;
    const auto index = static_cast<std::size_t>(found - names_.begin());
    if (std::find(chosen.begin(), chosen.end(), index) != chosen.end())
      return wrong("an acceleration that is named twice", shown(), "each once");
    chosen.push_back(index);
  }

  void take_flag(Token token, bool& flag) {
    if (token != Token::boolean)
      return wrong(fmt::format("{} is neither true nor false", kKeys.at(static_cast<std::size_t>(key_))), shown(),
                   "true or false");
    flag = truth_;
  }

  /// The list or object that has just ended was that deep.
  void end_of_group() {
    if (!is_object_) return;
    if (depth_ == 1 && key_ == Key::id) end_of_id();
    if (depth_ == 2 && key_ == Key::boxes) end_of_box();
    if (error_) return;
    if (depth_ == 3 && key_ == Key::boxes && box_is_object_) note_in_box(0, box_reader_.list_ends());
    if (depth_ == 2 && key_ == Key::container) note_if(container_reader_.list_ends());
    if (depth_ == 1 && key_ == Key::accelerations && request_.options.accelerations.empty())
      wrong("no acceleration", "", "at least one, or leave the key out");
  }

  /// @param position of the character at which the parser gives up, from 1
  void note_syntax(std::size_t position, std::string_view reason) {
    begin_ = std::min({begin_of_next(), position - 1, line_.size()});
    end_ = std::min(line_.find_first_of(" \t\r,:[]{}", begin_ + 1), line_.size());
    const bool in_box = is_object_ && key_ == Key::boxes && depth_ == 3 && !box_is_object_;
    Error error = {.box = in_box ? static_cast<long>(request_.places.size()) : 0,
                   .box_number = in_box ? static_cast<long>(request_.numbers.size() - numbers_before_) + 1 : 0};
    constexpr std::array<std::string_view, 5> kNotFinite = {"NaN", "nan", "Infinity", "-Infinity", "inf"};
    if (position > line_.size()) {
      error.what = "the line ends within its JSON";
      error.accepted = expected_in(reason);
    } else if (is_too_large(reason)) {
      error.what = "a number that is too large";
      error.value = shown();
      error.accepted = "numbers up to 1.8e308";
    } else {
      error.what = "the line is not JSON";
      error.value = shown();
      const bool is_not_finite = std::find(kNotFinite.begin(), kNotFinite.end(), error.value) != kNotFinite.end();
      error.accepted = is_not_finite ? "finite numbers" : expected_in(reason);
    }
    note(std::move(error));
  }

  std::size_t begin_of_next() const { return std::min(line_.find_first_not_of(" \t\r,:", end_), line_.size()); }

  std::string box_name() const { return "box " + std::to_string(request_.places.size()); }

  /// The beginning of what is at hand, for a message.
  std::string shown() const {
    constexpr std::size_t kMost = 60;
    return std::string(line_.substr(begin_, std::min(kMost, end_ - begin_)));
  }

  void wrong_in_box(long number, std::string what, std::string value) {
    const long box = static_cast<long>(request_.places.size());
    note({.what = std::move(what),
          .value = std::move(value),
          .accepted = kBoxesShape,
          .box = box,
          .box_number = number});
  }

  JsonValue value_of(Token token) const {
    constexpr std::size_t kMost = 60;
    return {.token = token,
            .truth = truth_,
            .number = number_,
            .text = text_,
            .written = line_.substr(begin_, std::min(kMost, end_ - begin_)),
            .place = begin_};
  }

  void note_if(Mistake mistake) {
    if (mistake) note(std::move(*mistake));
  }

  void note_in_box(long number, Mistake mistake) {
    if (!mistake) return;
    mistake->box = static_cast<long>(request_.places.size());
    mistake->box_number = number;
    note(std::move(*mistake));
  }

  void wrong(std::string what, std::string value, std::string accepted) {
    note({.what = std::move(what), .value = std::move(value), .accepted = std::move(accepted)});
  }

  void note(Error error) {
    if (error_) return;
    error_ = std::move(error);
    error_->column = static_cast<long>(begin_) + 1;
  }

  bool given(Key key) const { return given_.has(static_cast<std::size_t>(key)); }

  std::string_view line_;
  std::span<const std::string> names_;
  LayoutRequest request_;
  std::optional<Error> error_;

  const char* furthest_;    // the parser has seen the line up to there
  std::size_t begin_ = 0;   // of the token at hand
  std::size_t end_ = 0;     // and its end
  std::size_t depth_ = 0;   // of lists and objects around the token
  bool is_object_ = false;  // the line
  Key key_ = Key::unknown;
  KeySet<kKeys.size()> given_{kKeys};
  std::size_t id_begin_ = 0;
  std::size_t numbers_before_ = 0;  // those of the boxes before the one at hand
  bool box_is_object_ = false;
  std::optional<std::vector<Box>> boxes_;  // in place of numbers, where a box is an object or there is a container
  BoxReader box_reader_;
  ContainerReader container_reader_;
  double unit_factor_ = 1.0;  // m
  bool truth_ = false;
  double number_ = 0.0;
  std::string text_;
};

}  // namespace

ReadRequest read_request(std::string_view line, std::span<const std::string> accelerations) {
  return RequestReader(line, accelerations).read();
}

std::vector<std::string> LayoutRequest::box_names() const {
  std::vector<std::string> names;
  if (!layout) return names;
  for (const holdfast::Box& box : layout->boxes) names.push_back(kept_name(box.name));
  if (std::all_of(names.begin(), names.end(), [](const std::string& name) { return name.empty(); })) names.clear();
  return names;
}

long column_of(std::string_view line, const LayoutRequest& request, std::ptrdiff_t box, int number) {
  if (box < 0 || static_cast<std::size_t>(box) >= request.places.size()) return 0;
  if (const auto found = request.number_places.find(static_cast<std::size_t>(box));
      found != request.number_places.end()) {
    const std::size_t place = number < 0 ? 0 : found->second.at(static_cast<std::size_t>(number));
    return static_cast<long>(place > 0 ? place : request.places[static_cast<std::size_t>(box)]) + 1;
  }
  std::size_t place = request.places[static_cast<std::size_t>(box)];
  for (int i = 0; i < number && place < line.size(); ++i) place = line.find(',', place + 1);
  if (number >= 0) place = line.find_first_not_of(" \t\r[,", place);
  return static_cast<long>(std::min(place, line.size())) + 1;
}

}  // namespace holdfast::internal
