#include <algorithm>
#include <array>
#include <iterator>

#include "analyses/analysis.hpp"
#include "analyses/damage/damage.hpp"
#include "analyses/indicators/indicators.hpp"
#include "analyses/load_shift/load_shift.hpp"
#include "analyses/margins/margins.hpp"
#include "analyses/replicas/replica_verdict.hpp"
#include "analyses/walls/wall_forces.hpp"
#include "core/engine/engine_support.hpp"

namespace holdfast::internal {

namespace {

constexpr std::array kAnalyses = {&kReplicas, &kMargins, &kMarginSpread, &kWalls, &kDamage, &kLoadShift, &kIndicators};

}  // namespace

std::span<const Analysis* const> all_analyses() { return kAnalyses; }

std::vector<const Analysis*> analyses_of(const Settings& settings) {
  std::vector<const Analysis*> asked;
  std::copy_if(kAnalyses.begin(), kAnalyses.end(), std::back_inserter(asked),
               [&](const Analysis* analysis) { return analysis->enabled(settings); });
  return asked;
}

std::vector<WorldNumber> world_numbers() {
  std::vector<WorldNumber> numbers;
  for (const Analysis* analysis : kAnalyses)
    numbers.insert(numbers.end(), analysis->numbers.begin(), analysis->numbers.end());
  return numbers;
}

std::vector<double> numbers_of(const Findings& found) {
  std::vector<double> values;
  for (const Analysis* analysis : kAnalyses)
    for (const WorldNumber& number : analysis->numbers) values.push_back(number.value(found));
  return values;
}

RunTables tables_of(std::span<const Analysis* const> analyses) {
  RunTables tables;
  for (const Analysis* analysis : analyses) tables.push_back(&analysis->tables);
  return tables;
}

AnalysisMethods methods_of(std::span<const Analysis* const> analyses) {
  AnalysisMethods methods;
  for (const Analysis* analysis : analyses) methods.push_back(&analysis->method);
  return methods;
}

std::optional<Error> why_not_asked(const Engine& engine, const Settings& settings) {
  if (auto error = why_unsupported(engine, settings)) return error;
  for (const Analysis* analysis : analyses_of(settings))
    if (analysis->why_not != nullptr)
      if (auto error = analysis->why_not(engine, settings)) return error;
  return std::nullopt;
}

const RunTables& all_tables() {
  static const RunTables kTables = tables_of(kAnalyses);
  return kTables;
}

}  // namespace holdfast::internal
