#include "core/model/material_name.hpp"

#include <limits>

#include "core/base/number_text.hpp"

namespace holdfast::internal {

MaterialName::MaterialName(std::string_view text) {
  const std::optional<long> number = parse_integer(text);
  if (number && *number >= 0 && *number <= std::numeric_limits<int>::max()) {
    id_ = static_cast<int>(*number);
  } else {
    id_ = -1;
    name_ = text;
  }
}

}  // namespace holdfast::internal
