#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "analyses/analysis.hpp"
#include "analyses/replicas/replica_run.hpp"
#include "analyses/replicas/replica_verdict.hpp"
#include "io/export/csv_field.hpp"
#include "io/results/found_tables.hpp"

namespace holdfast::internal {

namespace {

bool simulate_replicas(const AnalysisInputs& inputs, const Layout& layout, const Acceleration& acceleration,
                       WorldRecord& world) {
  const double begin = inputs.processor_seconds();
  std::optional<ReplicaOutcome> replicas =
      run_replicas(inputs.engine, layout, acceleration, world, inputs.settings, inputs.abort);
  if (!replicas) return false;
  replicas->cpu_seconds = inputs.processor_seconds() - begin;
  world.found.put(std::move(*replicas));
  return true;
}

void replica_json(nlohmann::ordered_json& json, const holdfast::WorldOutcome& world) {
  if (world.replicas.count == 0) return;
  json["replicas"] = {{"verdict", to_string(world.replicas.verdict)},
                      {"count", world.replicas.count},
                      {"failed", world.replicas.failed},
                      {"share", world.replicas.share},
                      {"wilson_95", {world.replicas.wilson_low, world.replicas.wilson_high}},
                      {"cpu_seconds", world.replicas.cpu_seconds}};
}

std::string replica_line(const ResultsInfo& info, std::uint64_t world, const WorldRow& row,
                         const ReplicaOutcome& replicas) {
  return fmt::format("{},{},{},{},{},{},{},{},{},{},{}\r\n", world, csv_field(info.layout_name(row.layout)),
                     csv_field(info.acceleration_name(row.acceleration)), to_string(replicas.verdict), replicas.count,
                     replicas.failed, csv_number(replicas.share), csv_number(replicas.wilson_low),
                     csv_number(replicas.wilson_high), replicas.simulated, replicas.cpu_seconds);
}

constexpr WorldNumber kReplicaNumbers[] = {
    {"replica_verdict", "u1", "What the replicas of the world say, see :class:`ReplicaVerdict`.",
     [](const Findings& found) { return static_cast<double>(found.value<ReplicaOutcome>().verdict); }},
    {"replicas", "u4", "Number of replicas whose end is known; 0 without ``Replicas``.",
     [](const Findings& found) { return static_cast<double>(found.value<ReplicaOutcome>().count); }},
    {"replicas_failed", "u4", "Of these, those in which a box fell, moved or tilted, or was unstable.",
     [](const Findings& found) { return static_cast<double>(found.value<ReplicaOutcome>().failed); }},
    {"wilson_low", "f8", "Low end of the interval in which the share of failing replicas is at 95 %; NaN without.",
     [](const Findings& found) { return found.value<ReplicaOutcome>().wilson_low; }},
    {"wilson_high", "f8", "High end of the interval.",
     [](const Findings& found) { return found.value<ReplicaOutcome>().wilson_high; }}};

/// One line per world.
std::optional<Error> write_replica_csv(ResultsReader& results, const std::function<void(std::string_view)>& write) {
  const ResultsInfo& info = results.info();
  write("world,layout,acceleration,verdict,replicas,failed,share,wilson_low,wilson_high,simulated,cpu_seconds\r\n");
  for (std::uint64_t begin = 0; begin < info.world_count; begin += kSliceWorlds) {
    const Result<std::vector<WorldRow>> rows = results.worlds(begin, std::min(kSliceWorlds, info.world_count - begin));
    if (!rows) return rows.error();
    const Result<std::vector<ReplicaOutcome>> replicas = read_worlds<ReplicaOutcome>(results, begin, *rows);
    if (!replicas) return replicas.error();
    for (std::size_t i = 0; i < rows->size(); ++i) write(replica_line(info, begin + i, (*rows)[i], (*replicas)[i]));
  }
  return std::nullopt;
}

}  // namespace

const Analysis kReplicas = {.enabled = [](const Settings& settings) { return settings.screening.replicas > 0; },
                            .method = {.of_world = simulate_replicas},
                            .tables = tables_of_worlds<ReplicaOutcome>({.name = "replicas",
                                                                        .asked_by = "`Replicas`",
                                                                        .page = "confidence.md",
                                                                        .file_order = -1,
                                                                        .csv = write_replica_csv}),
                            .table = replica_table,
                            .world_json = replica_json,
                            .numbers = kReplicaNumbers};

}  // namespace holdfast::internal
