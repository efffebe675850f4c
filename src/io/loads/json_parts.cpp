#include "io/loads/json_parts.hpp"

#include <cmath>

#include "core/base/closest_word.hpp"
#include "core/base/number_text.hpp"
#include "core/base/utf8.hpp"
#include "core/model/container_catalogue.hpp"
#include "core/model/container_sides.hpp"
#include "core/model/friction_pairs.hpp"
#include "core/model/length_unit.hpp"
#include "core/model/load_limits.hpp"
#include "io/loads/read_load.hpp"

namespace holdfast::internal {

namespace {

constexpr std::array<std::string_view, 10> kBoxKeys = {
    "corner_min", "corner_max", "name", "material", "mass", "mat", "centre_of_mass", "fixed", "order", "bearing_limit"};
constexpr std::array<std::string_view, 5> kContainerKeys = {"type", "size", "open_sides", "drop_sides", "bed_height"};

constexpr const char* kThreeNumbers = "a list of three numbers";
constexpr const char* kTypes = "a name that `holdfast containers` lists, such as 40hc";

Error mistake(std::string what, std::string_view value, std::string accepted) {
  return {.what = std::move(what), .value = std::string(value), .accepted = std::move(accepted)};
}

std::string with_owner(std::string_view what, std::string_view of) {
  return std::string(what) + (of.empty() ? "" : " of " + std::string(of));
}

bool is_number(const JsonValue& value, double least, double most) {
  return value.token == Token::number && value.number >= least && value.number <= most;
}

bool is_whole(const JsonValue& value, double least, double most) {
  return is_number(value, least, most) && value.number == std::floor(value.number);
}

void turn(Vec3& lengths, double unit) {
  for (double& length : lengths) length = in_metres(length, unit);
}

std::string counted_numbers(std::size_t count) { return std::to_string(count) + " numbers"; }

}  // namespace

Mistake unknown_key(std::string_view key, std::string_view of, std::span<const std::string_view> keys) {
  if (const auto meant = closest_word(key, keys))
    return mistake(with_owner("unknown key", of), key, "did you mean '" + std::string(*meant) + "'?");
  std::string accepted = "accepted are";
  for (const std::string_view known : keys) accepted += (known == keys.front() ? " " : ", ") + std::string(known);
  return mistake(with_owner("unknown key", of), key, std::move(accepted));
}

Mistake given_twice(std::string_view key, std::string_view of) {
  return mistake(of.empty() ? "a key that is given twice" : "a key of " + std::string(of) + " that is given twice", key,
                 "each key once");
}

Mistake read_unit(const JsonValue& value, std::optional<double>& factor) {
  if (value.token == Token::text) factor = length_unit(value.text);
  if (value.token == Token::text && factor) return std::nullopt;
  return mistake("unknown unit", value.written, R"("m", "dm", "cm", "mm", "in" or "ft")");
}

Mistake box_of_row(std::span<const double> row, std::size_t number, Box& box) {
  if (!is_material(row[6]))
    return mistake(with_owner("the material", number > 0 ? "box " + std::to_string(number) : "") + " is not an id",
                   rounded_text(row[6]), "a whole number from 0");
  box.corner_min = Vec3(row[0], row[1], row[2]);
  box.corner_max = Vec3(row[3], row[4], row[5]);
  box.material = MaterialName(static_cast<int>(row[6]));
  return std::nullopt;
}

void turn_to_metres(Box& box, double unit) {
  turn(box.corner_min, unit);
  turn(box.corner_max, unit);
  if (box.centre_of_mass) turn(*box.centre_of_mass, unit);
}

void turn_to_metres(GivenContainer& container, double unit) {
  if (container.size) turn(*container.size, unit);
  if (container.bed_height) container.bed_height = in_metres(*container.bed_height, unit);
  if (container.drop_sides)
    for (DropSide& drop : *container.drop_sides) drop.height = in_metres(drop.height, unit);
}

BoxReader::BoxReader() : given_(kBoxKeys) {}

void BoxReader::begin(std::string name) {
  name_ = std::move(name);
  box_ = {.corner_min = Vec3::Zero(), .corner_max = Vec3::Zero(), .material = MaterialName(kUsualMaterial)};
  key_ = Key::none;
  given_.reset();
  places_ = {};
}

std::string BoxReader::of_box(std::string_view what) const { return with_owner(what, name_); }

std::string BoxReader::of_key(std::string_view what) const {
  return of_box(kBoxKeys.at(static_cast<std::size_t>(key_))) + std::string(what);
}

Mistake BoxReader::key(std::string_view key) {
  std::size_t index = 0;
  Mistake wrong = given_.give(key, name_, index);
  key_ = static_cast<Key>(index);
  elements_ = 0;
  return wrong;
}

Mistake BoxReader::read_number(const JsonValue& value, double least, double most, std::optional<double>& number) const {
  if (is_number(value, least, most)) {
    number = value.number;
    return std::nullopt;
  }
  return mistake(of_key(value.token == Token::number ? " is not possible" : " is not a number"), value.written,
                 std::string(least > 0.0 ? "a number above 0" : "a number from 0") + ", up to " + rounded_text(most));
}

Mistake BoxReader::read_material(const JsonValue& value) {
  places_[6] = value.place;
  if (value.token == Token::text && !value.text.empty())
    box_.material = MaterialName(kept_name(value.text));
  else if (value.token == Token::number && is_material(value.number))
    box_.material = MaterialName(static_cast<int>(value.number));
  else
    return mistake(of_box("the material") + " is neither a name nor an id", value.written,
                   "a name or a whole number from 0");
  return std::nullopt;
}

Mistake BoxReader::read(const JsonValue& value) {
  if (is_list() && value.token != Token::list_begins)
    return mistake(of_key(" is not a list"), value.written, kThreeNumbers);
  constexpr double kMostOrder = 1e15;  // a whole number that a double has exactly
  switch (key_) {
    case Key::name:
      if (value.token != Token::text) return mistake(of_box("the name") + " is not a text", value.written, "a text");
      box_.name = kept_name(value.text);
      break;
    case Key::material:
      return read_material(value);
    case Key::mass:
      return read_number(value, kLeastMass, kMostOfLoad, box_.mass);
    case Key::mat:
      return read_number(value, 0.0, kLargestFriction, box_.mat);
    case Key::bearing_limit:
      return read_number(value, 0.0, kMostOfLoad, box_.bearing_limit);
    case Key::fixed:
      if (value.token != Token::boolean)
        return mistake(of_key(" is neither true nor false"), value.written, "true or false");
      box_.fixed = value.truth;
      break;
    case Key::order:
      if (!is_whole(value, -kMostOrder, kMostOrder))
        return mistake(of_key(" is not a whole number"), value.written, "such as 1");
      box_.order = static_cast<long>(value.number);
      break;
    case Key::centre_of_mass:
      box_.centre_of_mass.emplace();
      break;
    case Key::corner_min:
    case Key::corner_max:
    case Key::none:
      break;
  }
  return std::nullopt;
}

Mistake BoxReader::value(const JsonValue& value) {
  Mistake wrong = read(value);
  if (wrong) key_ = Key::none;
  return wrong;
}

Mistake BoxReader::read_element(const JsonValue& value) {
  if (!is_list()) return std::nullopt;
  if (!is_number(value, -kMostOfLoad, kMostOfLoad))
    return mistake(of_box("a number of " + std::string(kBoxKeys.at(static_cast<std::size_t>(key_)))) +
                       (value.token == Token::number ? " is not possible" : " is not a number"),
                   value.written, kThreeNumbers);
  const std::size_t index = elements_++;
  if (index >= 3) return std::nullopt;  // told where the list ends
  if (key_ == Key::centre_of_mass) {
    (*box_.centre_of_mass)[static_cast<Eigen::Index>(index)] = value.number;
    return std::nullopt;
  }
  const bool is_max = key_ == Key::corner_max;
  (is_max ? box_.corner_max : box_.corner_min)[static_cast<Eigen::Index>(index)] = value.number;
  places_.at(index + (is_max ? 3 : 0)) = value.place;
  return std::nullopt;
}

Mistake BoxReader::element(const JsonValue& value) {
  Mistake wrong = read_element(value);
  if (wrong) key_ = Key::none;
  return wrong;
}

Mistake BoxReader::list_ends() {
  if (!is_list() || elements_ == 3) return std::nullopt;
  return mistake(of_key(" does not have three numbers"), counted_numbers(elements_), kThreeNumbers);
}

Mistake BoxReader::box_ends() const {
  for (const Key corner : {Key::corner_min, Key::corner_max})
    if (!given_.has(static_cast<std::size_t>(corner)))
      return mistake(
          (name_.empty() ? "the box" : name_) + " has no " + std::string(kBoxKeys.at(static_cast<std::size_t>(corner))),
          "", "corner_min and corner_max, each a list of three numbers");
  return std::nullopt;
}

ContainerReader::ContainerReader() : given_(kContainerKeys) {}

void ContainerReader::begin(long line, std::string pointer) {
  container_ = {.line = line, .pointer = std::move(pointer)};
  key_ = Key::none;
  given_.reset();
}

Mistake ContainerReader::whole(const JsonValue& value) {
  if (value.token == Token::object_begins) return std::nullopt;
  if (value.token == Token::text && find_container(value.text) != nullptr) {
    container_.type = value.text;
    return std::nullopt;
  }
  return mistake("no container", value.written, std::string(kTypes) + ", or an object with a size");
}

Mistake ContainerReader::key(std::string_view key) {
  std::size_t index = 0;
  Mistake wrong = given_.give(key, "the container", index);
  key_ = static_cast<Key>(index);
  elements_ = 0;
  return wrong;
}

Mistake ContainerReader::read(const JsonValue& value) {
  switch (key_) {
    case Key::type:
      if (value.token != Token::text || find_container(value.text) == nullptr)
        return mistake("no type of container", value.written, kTypes);
      container_.type = value.text;
      break;
    case Key::size:
      if (value.token != Token::list_begins)
        return mistake("the size of the container is not a list", value.written, kThreeNumbers);
      container_.size.emplace();
      break;
    case Key::open_sides:
      if (value.token != Token::list_begins)
        return mistake("open_sides is not a list", value.written, "a list of front, rear, left, right or roof");
      container_.open_sides.emplace();
      break;
    case Key::drop_sides:
      if (value.token != Token::object_begins)
        return mistake("drop_sides is not an object", value.written, R"(such as {"left": 0.6})");
      container_.drop_sides.emplace();
      break;
    case Key::bed_height:
      if (!is_number(value, 0.0, kMostOfLoad))
        return mistake("bed_height is not a number from 0", value.written, "a length");
      container_.bed_height = value.number;
      break;
    case Key::none:
      break;
  }
  return std::nullopt;
}

Mistake ContainerReader::value(const JsonValue& value) {
  Mistake wrong = read(value);
  if (wrong) key_ = Key::none;
  return wrong;
}

Mistake ContainerReader::side(std::string_view key) {
  if (key_ != Key::drop_sides) return std::nullopt;
  Mistake wrong;
  if (!can_be_open(key) || key == "roof")
    wrong = mistake("a drop side that is no wall", key, "front, rear, left or right");
  for (const DropSide& drop : *container_.drop_sides)
    if (drop.side == key) wrong = mistake("a drop side that is given twice", key, "each side once");
  if (wrong)
    key_ = Key::none;
  else
    container_.drop_sides->push_back({std::string(key)});
  return wrong;
}

Mistake ContainerReader::read_element(const JsonValue& value) {
  const bool positive = is_number(value, 0.0, kMostOfLoad) && value.number > 0.0;
  if (key_ == Key::size) {
    if (!positive)
      return mistake("the size of the container is not possible", value.written,
                     "three lengths of at least 1 mm, up to 1000000");
    if (elements_ < 3) (*container_.size)[static_cast<Eigen::Index>(elements_)] = value.number;
    ++elements_;
  } else if (key_ == Key::open_sides) {
    if (value.token != Token::text || !can_be_open(value.text))
      return mistake("an open side that is none", value.written, "front, rear, left, right or roof");
    container_.open_sides->emplace_back(value.text);
  } else if (key_ == Key::drop_sides && !container_.drop_sides->empty()) {
    if (!positive)
      return mistake("the height of a drop side is not possible", value.written,
                     "a length of at least 1 mm, up to 1000000");
    container_.drop_sides->back().height = value.number;
  }
  return std::nullopt;
}

Mistake ContainerReader::element(const JsonValue& value) {
  Mistake wrong = read_element(value);
  if (wrong) key_ = Key::none;
  return wrong;
}

Mistake ContainerReader::list_ends() const {
  if (key_ != Key::size || elements_ == 3) return std::nullopt;
  return mistake("the size of the container does not have three numbers", counted_numbers(elements_), kThreeNumbers);
}

}  // namespace holdfast::internal
