#pragma once

#include <optional>
#include <set>
#include <string_view>
#include <vector>

#include "io/loads/columns.hpp"
#include "io/loads/load_rows.hpp"

namespace holdfast::internal {

/// How the cells of a table write numbers: what marks decimals and thousands, and units within cells.
class CellNumbers {
 public:
  /// Rows that are looked at before the table is read.
  static constexpr int kRowsLookedAt = 200;

  /// @param rows,plan of the table; must outlive this
  /// @param unit      of lengths whose columns have none, m; 0: it is not known
  CellNumbers(LoadRows& rows, ColumnPlan& plan, double unit) : rows_(rows), plan_(plan), unit_(unit) {}

  /// Looks at the first rows: gives columns whose cells have units these units, and finds what marks thousands.
  void look_at_cells();

  struct Reading {
    std::optional<double> number;  ///< in the unit of the column
    bool lacks_unit = false;       ///< other cells of the column have one
  };
  /// @param column of the plan
  Reading read(const UsedColumn& column, std::string_view cell);

  /// What has been seen so far.
  bool has_decimal_commas() const { return decimal_mark_ == ','; }

 private:
  std::string_view text(const UsedColumn& column) const;
  void take_units_of_cells();
  void find_marks_of_thousands();
  char thousands_of_masses();
  char decimal_mark_of_others();
  char thousands_mark(const UsedColumn& column) const;
  template <class Note>
  char thousands_of(const std::vector<UsedColumn>& columns, Note note);

  LoadRows& rows_;
  ColumnPlan& plan_;
  double unit_;
  char decimal_mark_ = 0;                                    ///< that has been seen; 0: none yet
  char thousands_of_lengths_ = 0, thousands_of_masses_ = 0;  ///< marks; 0: there is none
  std::set<int> columns_with_units_;                         ///< in their cells
};

}  // namespace holdfast::internal
