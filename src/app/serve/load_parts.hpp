#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/result.hpp"
#include "holdfast/holdfast.hpp"

namespace holdfast::internal {

/// What the parser of a line reports, one after the other. A key and the ends of lists and objects are among them.
enum class Token { null, boolean, number, text, object_begins, object_ends, list_begins, list_ends, key };

/// A value of a line.
struct LineValue {
  Token token = Token::null;
  bool truth = false;        ///< of a boolean
  double number = 0.0;       ///< of a number
  std::string_view text;     ///< of a text
  std::string_view written;  ///< its beginning, as it is in the line
  std::size_t place = 0;     ///< where it begins in the line, bytes from 0
};

/// What is wrong with a key or a value; nothing when it can be used. The caller knows the place.
using Mistake = std::optional<Error>;

/// Reads a box that is an object, value by value: its keys are those of docs/start/loads.md.
class BoxReader {
 public:
  /// Begins with a box.
  /// @param name what messages call it
  void begin(std::string name);

  Mistake key(std::string_view key);
  Mistake value(const LineValue& value);    ///< of the key
  Mistake element(const LineValue& value);  ///< of the list that is the value of the key
  Mistake list_ends();
  Mistake box_ends() const;

  const holdfast::Box& box() const { return box_; }

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
  std::string of_box(std::string_view what) const { return std::string(what) + " of " + name_; }
  Mistake read_number(const LineValue& value, double least, std::optional<double>& number) const;
  Mistake read_material(const LineValue& value);

  std::string name_;
  holdfast::Box box_;
  Key key_ = Key::none;
  std::bitset<10> given_;
  std::size_t elements_ = 0;
  std::array<std::size_t, 7> places_ = {};
};

/// Reads a container: a name of a type, or an object with the keys of docs/start/loads.md.
class ContainerReader {
 public:
  Mistake whole(const LineValue& value);  ///< the value of the key `container`
  Mistake key(std::string_view key);
  Mistake value(const LineValue& value);    ///< of the key
  Mistake side(std::string_view key);       ///< a key of the object with drop sides
  Mistake element(const LineValue& value);  ///< of the list or object that is the value of the key
  Mistake list_ends() const;

  const holdfast::Container& container() const { return container_; }

 private:
  enum class Key { type, size, open_sides, drop_sides, bed_height, none };

  holdfast::Container container_;
  Key key_ = Key::none;
  std::bitset<5> given_;
  std::size_t elements_ = 0;
};

}  // namespace holdfast::internal
