#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.hpp"
#include "core/engine/analysis_method.hpp"
#include "core/engine/engine.hpp"
#include "core/model/settings.hpp"
#include "holdfast/outcomes.hpp"
#include "io/results/analysis_tables.hpp"

namespace holdfast::internal {

/// A number of a world for tables of the library.
struct WorldNumber {
  std::string_view name;
  std::string_view type;      ///< as numpy names it
  std::string_view sentence;  ///< its meaning and unit, and what it is where nothing was found
  double (*value)(const Findings& found);
  std::string_view label = "";  ///< in JSON, with the unit; where the analysis has no `world_json`
};

/// Something that a run finds out beside the verdicts, where it is asked for. An analysis is a folder of src/analyses
/// and a row of its table.
struct Analysis {
  /// Key of [Screening] that asks for it where it is true, and what the option of that name says; empty where it is
  /// asked for in another way.
  std::string_view key = "", option = "";
  bool (*enabled)(const Settings& settings);
  /// Why an engine cannot do it with these settings; absent: every engine can.
  std::optional<Error> (*why_not)(const Engine& engine, const Settings& settings) = nullptr;
  AnalysisMethod method;
  AnalysisTables tables;
  /// Lines for the terminal, of a file that has the analysis; absent where another one shows it.
  Result<std::string> (*table)(ResultsReader& results) = nullptr;
  /// Adds to the object of a world, or of a layout. Without the first, a world has an object of the `numbers`.
  void (*world_json)(nlohmann::ordered_json& json, const holdfast::WorldOutcome& world) = nullptr;
  void (*layout_json)(nlohmann::ordered_json& json, const LayoutRecord& layout) = nullptr;
  std::span<const WorldNumber> numbers = {};
};

/// The table of analyses, in the order in which a terminal shows them.
std::span<const Analysis* const> all_analyses();

/// What the settings ask for, in the order of the table.
std::vector<const Analysis*> analyses_of(const Settings& settings);

/// The numbers of a world that all analyses have, in the order of the table.
std::vector<WorldNumber> world_numbers();
std::vector<double> numbers_of(const Findings& found);

RunTables tables_of(std::span<const Analysis* const> analyses);
AnalysisMethods methods_of(std::span<const Analysis* const> analyses);

/// Why an engine cannot do what the settings ask for, by its own traits or by an analysis.
std::optional<Error> why_not_asked(const Engine& engine, const Settings& settings);

}  // namespace holdfast::internal
