#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace holdfast::internal {

/// A field as RFC 4180 defines it: quoted if it contains a comma, a quote or a line break.
std::string csv_field(const std::string& text);

/// A number; an empty field, which readers treat as a missing value, if it is NaN.
template <class Number>
std::string csv_number(Number value) {
  return std::isnan(value) ? "" : fmt::format("{}", value);
}

}  // namespace holdfast::internal
