#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <type_traits>

#include "core/model/outcome.hpp"

namespace holdfast::internal {

/// A field as RFC 4180 defines it: quoted if it contains a comma, a quote or a line break. A text that a spreadsheet
/// would take for a formula begins with an apostrophe.
std::string csv_field(const std::string& text);

/// A number; an empty field, which readers treat as a missing value, if it is NaN.
template <class Number>
std::string csv_number(Number value) {
  return std::isnan(value) ? "" : fmt::format("{}", value);
}

/// The three components of a vector.
inline std::string csv_vector(const Vec3& v) {
  return csv_number(v.x()) + ',' + csv_number(v.y()) + ',' + csv_number(v.z());
}

/// A number of boxes; an empty field where they were not counted.
inline std::string csv_count(std::uint32_t boxes) { return boxes == kNotCounted ? "" : fmt::format("{}", boxes); }

/// Headings of a field of an outcome; of a vector three: "displacement_x_m".
std::string csv_heading(const OutcomeField& field);

/// A value of an outcome: names of codes, three fields of a vector, and an empty field
/// for what is not known.
template <class Value>
std::string csv_value(const Value& value) {
  if constexpr (std::is_same_v<Value, std::string>)
    return csv_field(value);
  else if constexpr (std::is_same_v<Value, Float3>)
    return csv_number(value.x) + ',' + csv_number(value.y) + ',' + csv_number(value.z);
  else if constexpr (std::is_enum_v<Value>)
    return to_string(value);
  else if constexpr (std::is_floating_point_v<Value>)
    return csv_number(value);
  else if constexpr (std::is_same_v<Value, bool>)
    return value ? "1" : "0";
  else if constexpr (std::is_same_v<Value, std::uint32_t>)
    return csv_count(value);
  else
    return fmt::format("{}", value);
}

}  // namespace holdfast::internal
