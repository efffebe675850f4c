#pragma once

#include <optional>
#include <string>

#include "core/base/result.hpp"
#include "io/input/config_reader.hpp"

namespace holdfast::internal {

/// How files of loads are to be read, by options beside the configuration; what is given stands in for the key of the
/// same name.
struct LoadChoices {
  std::optional<std::string> container;  ///< also before what a load says of its own
  std::optional<std::string> unit;
  std::optional<std::string> axes;
  std::optional<std::string> format;
  std::optional<std::string> columns;

  /// Puts what was given into the settings, or says what is wrong with it.
  /// @param config that the settings are from
  std::optional<Error> apply_to(Settings& settings, const Config& config) const;
};

}  // namespace holdfast::internal
