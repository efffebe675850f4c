#pragma once

#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "core/model/layout.hpp"

namespace holdfast::internal {

/// A load of a file, checked; or what is wrong with it, and its name alone.
struct ReadLoad {
  Layout layout;
  std::vector<Error> errors;    ///< empty when it can be used
  std::vector<Error> warnings;  ///< of this load
};

/// All loads of a file.
struct LoadsOfFile {
  std::vector<ReadLoad> loads;
  std::vector<Error> notes;  ///< of the file as a whole: how it was taken, and what was left out
};

}  // namespace holdfast::internal
