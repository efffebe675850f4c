#include "app/serve/load_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "api/given_parts.hpp"
#include "core/base/closest_word.hpp"
#include "core/model/container_catalogue.hpp"
#include "core/model/container_sides.hpp"

namespace holdfast::internal {

namespace {

constexpr std::array<std::string_view, 10> kBoxKeys = {
    "corner_min", "corner_max", "name", "material", "mass", "mat", "centre_of_mass", "fixed", "order", "bearing_limit"};
constexpr std::array<std::string_view, 5> kContainerKeys = {"type", "size", "open_sides", "drop_sides", "bed_height"};

constexpr const char* kThreeNumbers = "a list of three numbers";

Error mistake(std::string what, std::string_view value, std::string accepted) {
  return {.what = std::move(what), .value = std::string(value), .accepted = std::move(accepted)};
}

/// Index of a key; an error for one that is not known, or was given before.
/// @param of what has the key, for messages
template <std::size_t Count>
Mistake find_key(std::string_view key, const std::array<std::string_view, Count>& keys, std::bitset<Count>& given,
                 const std::string& of, std::size_t& index) {
  index = static_cast<std::size_t>(std::find(keys.begin(), keys.end(), key) - keys.begin());
  if (index == Count) {
    const auto meant = closest_word(key, keys);
    return mistake(
        "unknown key of " + of, key,
        meant ? fmt::format("did you mean '{}'?", *meant) : fmt::format("accepted are {}", fmt::join(keys, ", ")));
  }
  if (given.test(index)) return mistake("a key of " + of + " that is given twice", key, "each key once");
  given.set(index);
  return std::nullopt;
}

bool is_whole(const LineValue& value, double least, double most) {
  return value.token == Token::number && value.number == std::floor(value.number) && value.number >= least &&
         value.number <= most;
}

}  // namespace

void BoxReader::begin(std::string name) {
  name_ = std::move(name);
  box_ = {.material = 1};
  key_ = Key::none;
  given_.reset();
  places_ = {};
}

Mistake BoxReader::key(std::string_view key) {
  std::size_t index = 0;
  Mistake wrong = find_key(key, kBoxKeys, given_, name_, index);
  key_ = wrong ? Key::none : static_cast<Key>(index);
  elements_ = 0;
  return wrong;
}

Mistake BoxReader::read_number(const LineValue& value, double least, std::optional<double>& number) const {
  const std::string what = of_box(kBoxKeys.at(static_cast<std::size_t>(key_)));
  const std::string accepted = std::string(least > 0.0 ? "a number above 0" : "a number from 0") + ", up to 1000000";
  if (value.token != Token::number) return mistake(what + " is not a number", value.written, accepted);
  if (!(value.number >= least && value.number <= kMostOfBox))
    return mistake(what + " is not possible", value.written, accepted);
  number = value.number;
  return std::nullopt;
}

Mistake BoxReader::read_material(const LineValue& value) {
  places_[6] = value.place;
  if (value.token == Token::text && !value.text.empty())
    box_.material_name = value.text;
  else if (is_whole(value, 0.0, std::numeric_limits<int>::max()))
    box_.material = static_cast<int>(value.number);
  else
    return mistake(of_box("the material") + " is neither a name nor an id", value.written,
                   "a name or a whole number from 0");
  return std::nullopt;
}

Mistake BoxReader::value(const LineValue& value) {
  if (is_list() && value.token != Token::list_begins)
    return mistake(of_box(kBoxKeys.at(static_cast<std::size_t>(key_))) + " is not a list", value.written,
                   kThreeNumbers);
  constexpr double kMostOrder = 1e15;  // a whole number that a double has exactly
  switch (key_) {
    case Key::name:
      if (value.token != Token::text) return mistake(of_box("the name") + " is not a text", value.written, "a text");
      box_.name = value.text;
      break;
    case Key::material:
      return read_material(value);
    case Key::mass:
      return read_number(value, kLeastMass, box_.mass);
    case Key::mat:
      return read_number(value, 0.0, box_.mat);
    case Key::bearing_limit:
      return read_number(value, 0.0, box_.bearing_limit);
    case Key::fixed:
      if (value.token != Token::boolean)
        return mistake(of_box("fixed") + " is neither true nor false", value.written, "true or false");
      box_.fixed = value.truth;
      break;
    case Key::order:
      if (!is_whole(value, -kMostOrder, kMostOrder))
        return mistake(of_box("order") + " is not a whole number", value.written, "such as 1");
      box_.order = static_cast<std::int64_t>(value.number);
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

Mistake BoxReader::element(const LineValue& value) {
  if (!is_list()) return std::nullopt;
  if (value.token != Token::number)
    return mistake(
        of_box("a number of " + std::string(kBoxKeys.at(static_cast<std::size_t>(key_)))) + " is not a number",
        value.written, kThreeNumbers);
  const std::size_t index = elements_++;
  if (index >= 3) return std::nullopt;  // told where the list ends
  if (key_ == Key::centre_of_mass) {
    (*box_.centre_of_mass).at(index) = value.number;
    return std::nullopt;
  }
  const bool is_max = key_ == Key::corner_max;
  (is_max ? box_.corner_max : box_.corner_min).at(index) = value.number;
  places_.at(index + (is_max ? 3 : 0)) = value.place;
  return std::nullopt;
}

Mistake BoxReader::list_ends() {
  if (!is_list() || elements_ == 3) return std::nullopt;
  return mistake(of_box(kBoxKeys.at(static_cast<std::size_t>(key_))) + " does not have three numbers",
                 fmt::format("{} numbers", elements_), kThreeNumbers);
}

Mistake BoxReader::box_ends() const {
  for (const Key corner : {Key::corner_min, Key::corner_max})
    if (!given_.test(static_cast<std::size_t>(corner)))
      return mistake(name_ + " has no " + std::string(kBoxKeys.at(static_cast<std::size_t>(corner))), "",
                     "corner_min and corner_max, each a list of three numbers");
  return std::nullopt;
}

Mistake ContainerReader::whole(const LineValue& value) {
  if (value.token == Token::object_begins) return std::nullopt;
  if (value.token == Token::text && find_container(value.text) != nullptr) {
    container_.type = value.text;
    return std::nullopt;
  }
  return mistake("no container", value.written,
                 "a name that `holdfast containers` lists, such as 40hc, or an object with a size");
}

Mistake ContainerReader::key(std::string_view key) {
  std::size_t index = 0;
  Mistake wrong = find_key(key, kContainerKeys, given_, "the container", index);
  key_ = wrong ? Key::none : static_cast<Key>(index);
  elements_ = 0;
  return wrong;
}

Mistake ContainerReader::value(const LineValue& value) {
  switch (key_) {
    case Key::type:
      if (value.token != Token::text || find_container(value.text) == nullptr)
        return mistake("no type of container", value.written, "a name that `holdfast containers` lists, such as 40hc");
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
      if (value.token != Token::number || !(value.number >= 0.0))
        return mistake("bed_height is not a number from 0", value.written, "a length");
      container_.bed_height = value.number;
      break;
    case Key::none:
      break;
  }
  return std::nullopt;
}

Mistake ContainerReader::side(std::string_view key) {
  if (key_ != Key::drop_sides) return std::nullopt;
  if (!can_be_open(key) || key == "roof")
    return mistake("a drop side that is no wall", key, "front, rear, left or right");
  for (const holdfast::DropSide& drop : *container_.drop_sides)
    if (drop.side == key) return mistake("a drop side that is given twice", key, "each side once");
  container_.drop_sides->push_back({std::string(key)});
  return std::nullopt;
}

Mistake ContainerReader::element(const LineValue& value) {
  const bool positive = value.token == Token::number && value.number > 0.0;
  if (key_ == Key::size) {
    if (!positive) return mistake("the size of the container is not possible", value.written, "three numbers above 0");
    if (elements_ < 3) container_.size->at(elements_) = value.number;
    ++elements_;
  } else if (key_ == Key::open_sides) {
    if (value.token != Token::text || !can_be_open(value.text))
      return mistake("an open side that is none", value.written, "front, rear, left, right or roof");
    container_.open_sides->emplace_back(value.text);
  } else if (key_ == Key::drop_sides && !container_.drop_sides->empty()) {
    if (!positive) return mistake("the height of a drop side is not possible", value.written, "a number above 0");
    container_.drop_sides->back().height = value.number;
  }
  return std::nullopt;
}

Mistake ContainerReader::list_ends() const {
  if (key_ != Key::size || elements_ == 3) return std::nullopt;
  return mistake("the size of the container does not have three numbers", fmt::format("{} numbers", elements_),
                 kThreeNumbers);
}

}  // namespace holdfast::internal
