#include "analyses/replicas/replica_verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "io/input/text_lines.hpp"
#include "io/results/found_tables.hpp"

namespace holdfast::internal {

namespace {

constexpr std::size_t kUncertainShown = 10;

/// Layouts under one acceleration, by their verdict.
using Counts = std::array<std::uint64_t, kReplicaVerdictCount>;

std::string lines_of(const ResultsInfo& info, const std::vector<Counts>& accelerations) {
  std::size_t width = std::string_view("layouts that").size();
  for (const std::string& name : info.accelerations) width = std::max(width, printable(name).size());
  std::string text = fmt::format("  {:<{}}  {:>6}  {:>9}  {:>6}\n", "layouts that", width, "hold", "uncertain", "fail");
  const auto of = [](const Counts& counts, ReplicaVerdict verdict) {
    return counts.at(static_cast<std::size_t>(verdict));
  };
  for (std::size_t i = 0; i < accelerations.size(); ++i) {
    const Counts& counts = accelerations[i];
    text += fmt::format("  {:<{}}  {:>6}  {:>9}  {:>6}\n", printable(info.accelerations[i]), width,
                        of(counts, ReplicaVerdict::holds), of(counts, ReplicaVerdict::uncertain),
                        of(counts, ReplicaVerdict::fails));
  }
  return text;
}

std::string line_of(const ResultsInfo& info, const WorldRow& row, const ReplicaOutcome& replicas) {
  return fmt::format("  {} under {}: {} of {} fail, which is {:.0f} to {:.0f} %\n",
                     printable(info.layout_name(row.layout)), printable(info.acceleration_name(row.acceleration)),
                     replicas.failed, replicas.count, 100.0 * replicas.wilson_low, 100.0 * replicas.wilson_high);
}

}  // namespace

Result<std::string> replica_table(ResultsReader& results) {
  const ResultsInfo& info = results.info();
  const Result<std::vector<WorldRow>> rows = results.worlds(0, info.world_count);
  if (!rows) return rows.errors();
  const Result<std::vector<ReplicaOutcome>> replicas = read_worlds<ReplicaOutcome>(results, 0, *rows);
  if (!replicas) return replicas.errors();

  std::vector<Counts> accelerations(info.accelerations.size());
  std::vector<std::size_t> uncertain;
  for (std::size_t i = 0; i < rows->size(); ++i) {
    const WorldRow& row = (*rows)[i];
    const ReplicaOutcome& outcome = (*replicas)[i];
    if (row.acceleration >= accelerations.size() || outcome.verdict > ReplicaVerdict::uncertain)
      return Error{.file = info.path, .what = "is damaged: a world has indices that are not in the file"};
    ++accelerations[row.acceleration].at(static_cast<std::size_t>(outcome.verdict));
    if (outcome.verdict == ReplicaVerdict::uncertain) uncertain.push_back(i);
  }
  const auto doubt = [&](std::size_t world) { return std::abs((*replicas)[world].share - 0.5); };
  std::stable_sort(uncertain.begin(), uncertain.end(),
                   [&](std::size_t a, std::size_t b) { return doubt(a) < doubt(b); });

  std::string text = "\nreplicas: each world again, with friction that is not known exactly\n";
  text += lines_of(info, accelerations);
  if (!uncertain.empty()) text += "uncertain, the most doubtful first\n";
  for (std::size_t i = 0; i < std::min(uncertain.size(), kUncertainShown); ++i)
    text += line_of(info, (*rows)[uncertain[i]], (*replicas)[uncertain[i]]);
  if (uncertain.size() > kUncertainShown) text += fmt::format("  and {} more\n", uncertain.size() - kUncertainShown);
  return text;
}

}  // namespace holdfast::internal
