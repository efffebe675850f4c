#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "io/results/results_reader.hpp"

namespace holdfast::internal {

/// What the loads of a results file call their boxes, materials and containers, read when it is asked for. A file that
/// does not have it, as those of earlier versions do not, has no names; nor has a layout that is described in another
/// part of the run.
class LoadNames {
 public:
  explicit LoadNames(ResultsReader& results) : results_(results) {}

  /// The names of all boxes of a layout, empty for those that have none; nothing where none has.
  /// @param layout its number in the run
  const std::vector<std::string>& box_names(std::uint64_t layout) {
    return texts_of_layout("/inputs/layouts/box_name", layout);
  }

  /// @param layout its number in the run
  /// @param box    from 1
  std::string box_name(std::uint64_t layout, std::uint64_t box);
  std::string material_name(std::uint64_t layout, std::uint64_t box);  ///< empty where it has a number

  /// A box in a table for people: "box 3 (Paper 1)".
  std::string box_text(std::uint64_t layout, std::uint64_t box);

  /// The load's own container: its type, or its size in m where it has none; empty where it is that of the run.
  std::string container(std::uint64_t layout);

 private:
  /// The texts of the layout that was asked for last.
  struct Column {
    std::uint64_t layout = UINT64_MAX;
    std::vector<std::string> texts = {};
  };

  const std::vector<std::string>& texts_of_layout(std::string_view path, std::uint64_t layout);
  std::string text(std::string_view path, std::uint64_t layout, std::uint64_t box);
  std::vector<std::string> texts(std::string_view path, std::uint64_t begin, std::uint64_t count);

  ResultsReader& results_;
  std::map<std::string_view, Column> columns_;
  std::vector<std::string> containers_;
  bool has_containers_ = false;
};

}  // namespace holdfast::internal
