#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.hpp"
#include "core/engine/result_sink.hpp"
#include "io/results/results_schema.hpp"

namespace holdfast::internal {

class ColumnSet;
class ResultsReader;
struct SummarySlice;

/// Fields of CSV, each with a comma before it: one text per world of a slice, and one per box of it.
struct CsvFields {
  std::vector<std::string> worlds, boxes;
};

/// What the results file and CSV have of an analysis; `tables_of_worlds` and `tables_of_layouts` make it of the
/// description of what is found.
struct AnalysisTables {
  std::string_view name;      ///< of its group in the results file, and of its file in CSV
  std::string_view asked_by;  ///< keys of the configuration that ask for it, for docs/reference/results_file.md
  std::string_view page;      ///< of docs/guide/ that explains it
  int file_order = 0;         ///< of its datasets: rising, and negative before those of worlds

  std::vector<DatasetSpec> (*datasets)() = nullptr;
  /// Adds what was found of a layout, or of a world of that many boxes; what nothing was found of is unknown.
  void (*append_layout)(ColumnSet& columns, const LayoutRecord& layout) = nullptr;
  void (*append_world)(ColumnSet& columns, const WorldRecord& world, bool series) = nullptr;
  /// Reads it again, without time series, into records of consecutive layouts or worlds of a file.
  /// @param begin row of the first one
  std::optional<Error> (*read_layouts)(ResultsReader& results, std::uint64_t begin,
                                       std::vector<LayoutRecord>& layouts) = nullptr;
  std::optional<Error> (*read_worlds)(ResultsReader& results, std::uint64_t begin,
                                      std::vector<WorldRecord>& worlds) = nullptr;

  /// Writes a file of its own, piece by piece. May be absent.
  std::optional<Error> (*csv)(ResultsReader& results, const std::function<void(std::string_view)>& write) = nullptr;
  /// Columns at the end of worlds.csv and boxes.csv; headings have a comma before each.
  std::string_view world_headings = "", box_headings = "";
  Result<CsvFields> (*csv_fields)(ResultsReader& results, const SummarySlice& slice) = nullptr;
};

/// Those of a run, or of a file.
using RunTables = std::vector<const AnalysisTables*>;

/// Whether a run has a dataset: it is of what every run finds, or of one of its analyses.
bool includes(const RunTables& tables, const DatasetSpec& spec);

/// All that there are. Defined beside the table of analyses, in src/analyses.
const RunTables& all_tables();

}  // namespace holdfast::internal
