#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/result.hpp"

namespace holdfast::internal {

/// The rows of a table, whatever it is written in.
class LoadRows {
 public:
  LoadRows() = default;
  LoadRows(const LoadRows&) = delete;
  LoadRows& operator=(const LoadRows&) = delete;
  virtual ~LoadRows() = default;

  virtual const std::vector<std::string>& headers() const = 0;

  /// Moves to the next row, or to the first one. False at the end, or where the table cannot be read on: see `mistake`.
  virtual bool next() = 0;
  virtual void restart() = 0;

  /// A cell of the row; empty where the row has none.
  virtual std::string_view cell(int column) const = 0;

  /// An error at a cell, or at the row with a column of -1, with what is wrong.
  virtual Error at(int column, std::string what) const = 0;

  /// Line of the row in the file, from 1; 0 where it has none.
  virtual long line() const = 0;

  /// JSON pointer of the row; empty where it has none.
  virtual std::string pointer() const { return {}; }

  /// Whether numbers are written in one way only, as JSON has them.
  virtual bool has_exact_numbers() const { return false; }

  /// What keeps the table from being read on; `what` is empty where nothing does.
  virtual Error mistake() const { return {}; }
};

}  // namespace holdfast::internal
