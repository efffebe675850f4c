#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "core/model/layout.hpp"

namespace holdfast::internal {

/// Material of boxes of which nothing is said.
inline constexpr int kUsualMaterial = 1;

/// A load of a file, checked; or what is wrong with it, and its name alone.
struct ReadLoad {
  Layout layout;
  std::vector<Error> errors;    ///< empty when it can be used
  std::vector<Error> warnings;  ///< of this load
  std::size_t box_count = 0;    ///< also of a load that cannot be used
  std::size_t outside = 0;      ///< boxes outside the container, where neither unit nor container explains them
  std::string list_pointer;     ///< of the list of its boxes, in JSON of ours
  std::vector<std::string> box_pointers;  ///< of its boxes, in other JSON
  double guessed_unit = 0.0;  ///< in which lengths were read without a word of it in the file, m; 0: it is known
};

/// All loads of a file.
struct LoadsOfFile {
  std::string form;  ///< what the file was taken for, in words: `JSON, one load per line`
  std::vector<ReadLoad> loads;
  std::vector<Error> notes;                ///< of the file as a whole: how it was taken, and what was left out
  std::vector<std::string> ignored;        ///< headers of columns that mean nothing
  std::vector<std::string> place_headers;  ///< three columns that are taken for corners and may be middles; or none
};

}  // namespace holdfast::internal
