#pragma once

#include <string>

namespace holdfast::internal {

/// A field as RFC 4180 defines it: quoted if it contains a comma, a quote or a line break.
std::string csv_field(const std::string& text);

}  // namespace holdfast::internal
