#pragma once

#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "core/model/layout.hpp"
#include "core/model/settings.hpp"

namespace holdfast::internal {

/// The text that `check` prints about the weight on each box at rest; docs/guide/bearing.md explains it.
struct BearingFindings {
  std::string text;             ///< lines to print; empty where nothing was asked for
  std::vector<Error> warnings;  ///< boxes that certainly carry more than their limit; those that cannot stand
};

/// How the boxes of a layout compare with their limits, where it has any.
/// @param path   of the layout's file, for messages
/// @param table  whether all boxes are listed, with or without limits
BearingFindings find_bearing_of(const std::string& path, const Layout& layout, const Settings& settings, bool table);

}  // namespace holdfast::internal
