#include "app/shard_job.hpp"

#include <filesystem>

#include "app/run_inputs.hpp"
#include "io/results/shard_file.hpp"

namespace holdfast::internal {

Result<ScreeningJob> shard_job(const ScreeningJob& whole, const std::vector<ReadAcceleration>& accelerations) {
  const Shard shard{.part = whole.part->part,
                    .parts = whole.part->parts,
                    .block = Shard::block_of(accelerations.size()),
                    .layouts = whole.layout_paths.size()};
  ScreeningJob job = whole;
  job.part.reset();
  job.shard = {shard, fingerprint(describe_run(whole, accelerations, {}))};
  job.results_path = shard_path(whole.results_path, shard.part, shard.parts);
  job.layout_paths.clear();
  for (std::uint64_t layout = 0; layout < shard.layouts; ++layout)
    if (shard.has(layout)) job.layout_paths.push_back(whole.layout_paths[layout]);
  const std::string folder = shards_folder(whole.results_path);
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure) return Error{.file = folder, .what = "cannot be created", .value = failure.message()};
  return job;
}

}  // namespace holdfast::internal
