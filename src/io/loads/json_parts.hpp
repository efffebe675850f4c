#pragma once

#include <algorithm>
#include <array>
#include <bitset>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "core/base/result.hpp"
#include "core/model/given_container.hpp"
#include "core/model/layout.hpp"

namespace holdfast::internal {

/// What a parser of JSON reports, one after the other. A key and the ends of lists and objects are among them.
enum class Token { null, boolean, number, text, object_begins, object_ends, list_begins, list_ends, key };

/// A value of JSON.
struct JsonValue {
  Token token = Token::null;
  bool truth = false;        ///< of a boolean
  double number = 0.0;       ///< of a number
  std::string_view text;     ///< of a text
  std::string_view written;  ///< its beginning, as it is in the text; may be empty
  std::size_t place = 0;     ///< where it begins in the text, bytes from 0
};

/// What is wrong with a key or a value; nothing when it can be used. The caller knows the place. After a mistake, what
/// follows until the next key is left out.
using Mistake = std::optional<Error>;

Mistake unknown_key(std::string_view key, std::string_view of, std::span<const std::string_view> keys);
Mistake given_twice(std::string_view key, std::string_view of);

/// The factor of the value of the key `unit`, m.
Mistake read_unit(const JsonValue& value, std::optional<double>& factor);

/// Makes a box of seven numbers: two corners and a material.
/// @param number of the box in messages, from 1; 0 where they have its place
Mistake box_of_row(std::span<const double> row, std::size_t number, Box& box);

/// Turns lengths in a unit into metres.
void turn_to_metres(Box& box, double unit);
void turn_to_metres(GivenContainer& container, double unit);

/// Keys of an object, of which each may be given once.
template <std::size_t Count>
class KeySet {
 public:
  explicit constexpr KeySet(const std::array<std::string_view, Count>& keys) : keys_(keys) {}

  /// Notes a key. An error for one that is not known, or was given before.
  /// @param of    what has the key, for messages; may be empty
  /// @param index gets its index, or Count
  Mistake give(std::string_view key, std::string_view of, std::size_t& index) {
    index = static_cast<std::size_t>(std::find(keys_.begin(), keys_.end(), key) - keys_.begin());
    if (index < Count && !given_.test(index)) {
      given_.set(index);
      return std::nullopt;
    }
    const bool is_known = std::exchange(index, Count) < Count;
    return is_known ? given_twice(key, of) : unknown_key(key, of, keys_);
  }
  bool has(std::size_t index) const { return given_.test(index); }
  void reset() { given_.reset(); }

 private:
  const std::array<std::string_view, Count>& keys_;
  std::bitset<Count> given_;
};

/// Reads a box that is an object, value by value: its keys are those of docs/start/loads.md.
class BoxReader {
 public:
  BoxReader();

  /// Begins with a box.
  /// @param name what messages call it; empty where they have its place
  void begin(std::string name);

  Mistake key(std::string_view key);
  Mistake value(const JsonValue& value);    ///< of the key
  Mistake element(const JsonValue& value);  ///< of the list that is the value of the key
  Mistake list_ends();
  Mistake box_ends() const;

  /// The box, in the unit of its numbers.
  Box take() { return std::move(box_); }

  /// Where its seven numbers begin in the line, bytes from 0; 0 for those that are not there.
  const std::array<std::size_t, 7>& places() const { return places_; }

 private:
  enum class Key {
    corner_min,
    corner_max,
    name,
    material,
    mass,
    mat,
    centre_of_mass,
    fixed,
    order,
    bearing_limit,
    none
  };

  bool is_list() const { return key_ == Key::corner_min || key_ == Key::corner_max || key_ == Key::centre_of_mass; }
  std::string of_box(std::string_view what) const;
  std::string of_key(std::string_view what) const;
  Mistake read(const JsonValue& value);
  Mistake read_element(const JsonValue& value);
  Mistake read_number(const JsonValue& value, double least, double most, std::optional<double>& number) const;
  Mistake read_material(const JsonValue& value);

  std::string name_;
  Box box_;
  Key key_ = Key::none;
  KeySet<10> given_;
  std::size_t elements_ = 0;
  std::array<std::size_t, 7> places_ = {};
};

/// Reads a container: a name of a type, or an object with the keys of docs/start/loads.md.
class ContainerReader {
 public:
  ContainerReader();

  /// Begins with a container.
  /// @param line    of the file, from 1; 0 where it does not matter
  /// @param pointer of it in JSON, for messages; may be empty
  void begin(long line, std::string pointer);
  Mistake whole(const JsonValue& value);  ///< the value of the key `container`
  Mistake key(std::string_view key);
  Mistake value(const JsonValue& value);    ///< of the key
  Mistake side(std::string_view key);       ///< a key of the object with drop sides
  Mistake element(const JsonValue& value);  ///< of the list or object that is the value of the key
  Mistake list_ends() const;

  /// In the unit of the numbers.
  const GivenContainer& container() const { return container_; }

 private:
  enum class Key { type, size, open_sides, drop_sides, bed_height, none };

  Mistake read(const JsonValue& value);
  Mistake read_element(const JsonValue& value);

  GivenContainer container_;
  Key key_ = Key::none;
  KeySet<5> given_;
  std::size_t elements_ = 0;
};

}  // namespace holdfast::internal
