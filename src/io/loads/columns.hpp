#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.hpp"
#include "io/loads/column_words.hpp"

namespace holdfast::internal {

/// A column that is read.
struct UsedColumn {
  int index = -1;     ///< in the row; -1: there is none
  double unit = 0.0;  ///< of its numbers, in m or kg; 0: its header does not say
  explicit operator bool() const { return index >= 0; }
};

/// What the columns of a table mean.
struct ColumnPlan {
  std::array<UsedColumn, 3> low, high, middle, extent;  ///< along the axes of the file
  UsedColumn length, width, height;
  UsedColumn orientation, name, material, mass, mass_unit, mat, fixed, order, order_or_group, bearing_limit, nesting;
  UsedColumn load, group, container, type, quantity, status;
  UsedColumn container_length, container_width, container_height;
  std::vector<std::string> ignored;  ///< headers of columns that mean nothing

  bool has_place() const;  ///< along all axes
  bool has_size() const;   ///< along all axes, or a second corner
  bool has_boxes() const { return has_place() && has_size(); }
};

/// A choice of the user: a header, and the word of a column that it stands for.
struct ColumnChoice {
  std::string header;
  std::string word;
  bool needed = true;  ///< a table without that header is an error
};

/// Reads `PosX = y, Artikel = name`.
Result<std::vector<ColumnChoice>> parse_column_choice(std::string_view text);

/// The header as words are compared: lower case, letters and digits alone, Latin ones without accents; without a unit
/// at its end, which is returned.
struct HeaderWord {
  std::string word;
  double length_unit = 0.0;  ///< m; 0: none
  double mass_unit = 0.0;    ///< kg; 0: none
  bool in_brackets = false;  ///< the unit
};
HeaderWord header_word(std::string_view header);

/// What the columns with these headers mean. An error says that two of them mean the same, or that a choice is none.
/// Keys of JSON are joined by points: of `item.size.x` the longest end that is a word counts.
Result<ColumnPlan> plan_columns(std::span<const std::string> headers, std::span<const ColumnChoice> choices);

/// Calls `visit` for every column that is used.
void for_each_column(ColumnPlan& plan, const std::function<void(UsedColumn&)>& visit);

/// Gives the columns that have no unit those of a row beneath the header. False, and nothing changes, where the row has
/// digits, or no unit for a column of lengths.
bool give_units(ColumnPlan& plan, std::span<const std::string> row);

/// The words of a text, as words of headers are compared.
std::vector<std::string> words_of(std::string_view text);

/// What a plan lacks to tell boxes, in words.
std::string missing_columns(const ColumnPlan& plan);

}  // namespace holdfast::internal
