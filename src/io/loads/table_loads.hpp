#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "core/model/settings.hpp"
#include "io/loads/columns.hpp"
#include "io/loads/load_rows.hpp"
#include "io/loads/read_load.hpp"

namespace holdfast::internal {

/// What a table is part of.
struct TableContext {
  std::string path;  ///< of the file, as messages name it
  std::string name;  ///< of the file, without the folder
  /// Of the load, where the table has no column for it and the file several tables; empty: the name of the file.
  std::string load;
  std::string container;                                ///< type that stands above the table; empty: none
  std::array<std::optional<double>, 3> container_size;  ///< length, width, height above the table, in the table's unit
  double unit = 0.0;            ///< that stands above the table, of columns without one, m; 0: none
  double mass_unit = 0.0;       ///< likewise, kg
  double container_unit = 0.0;  ///< of the container's size above the table, m; 0: that of lengths
};

/// How a table is to be read: what the user has chosen, and the known format.
struct TableChoices {
  std::vector<ColumnChoice> columns;
  std::optional<FileAxes> axes;
  std::optional<double> unit;  ///< m, where headers have none
  std::string_view turns;      ///< of a known format: what its codes of orientations mean, see `KnownFormat`

  /// Those of the settings, or what is wrong with them.
  static Result<TableChoices> of(const Settings& settings);
};

/// Whether the name of a load is that of a type of container: `40HC`, but not `40`, which may be the fortieth.
bool is_container_name(std::string_view name);

/// The loads of a table: rows with a place and a size are boxes, a column for loads splits them, and rows of containers
/// give sizes. Loads are not checked yet: see `check_load`.
/// @param plan that has boxes
LoadsOfFile read_table(LoadRows& rows, const ColumnPlan& plan, const TableContext& context, const TableChoices& choices,
                       const Settings& settings);

}  // namespace holdfast::internal
