#include <fmt/format.h>

#include <algorithm>

#include "io/export/csv_field.hpp"
#include "io/export/output_file.hpp"
#include "io/results/summary.hpp"

namespace holdfast::internal {

namespace {

std::string line_of(const ResultsInfo& info, std::uint64_t world, const WorldRow& row, const ReplicaOutcome& replicas) {
  return fmt::format("{},{},{},{},{},{},{},{},{},{},{}\r\n", world, csv_field(layout_name(info, row)),
                     csv_field(acceleration_name(info, row)), to_string(replicas.verdict), replicas.count,
                     replicas.failed, csv_number(replicas.share), csv_number(replicas.wilson_low),
                     csv_number(replicas.wilson_high), replicas.simulated, replicas.cpu_seconds);
}

}  // namespace

void write_replica_csv(ResultsReader& results, const std::string& path) {
  const ResultsInfo& info = results.info();
  OutputFile file(path);
  file.write(
      "world,layout,acceleration,verdict,replicas,failed,share,wilson_low,wilson_high,simulated,cpu_seconds\r\n");
  for (std::uint64_t begin = 0; begin < info.world_count; begin += kSliceWorlds) {
    const std::uint64_t count = std::min(kSliceWorlds, info.world_count - begin);
    const Result<std::vector<WorldRow>> rows = results.worlds(begin, count);
    if (!rows) throw h5::Failure(rows.error());
    const Result<std::vector<ReplicaOutcome>> replicas = results.replicas(begin, count);
    if (!replicas) throw h5::Failure(replicas.error());
    for (std::size_t i = 0; i < rows->size(); ++i)
      file.write(line_of(info, info.world_begin + begin + i, (*rows)[i], (*replicas)[i]));
  }
  file.close();
}

}  // namespace holdfast::internal
