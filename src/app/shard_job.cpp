#include "app/shard_job.hpp"

#include <filesystem>
#include <system_error>
#include <utility>

#include "app/run_inputs.hpp"
#include "io/input/layout_files.hpp"
#include "io/results/shard_file.hpp"

namespace holdfast::internal {

DividedJob::DividedJob(const ScreeningJob& whole, const LayoutFiles& layouts,
                       const std::vector<ReadAcceleration>& accelerations, std::uint64_t shards)
    : whole_(whole),
      layouts_(layouts),
      without_layouts_(whole),
      shard_{.parts = shards, .block = Shard::block_of(accelerations.size()), .layouts = layouts.count()},
      fingerprint_(fingerprint_with_contents(describe_run(whole, layouts, accelerations))) {
  without_layouts_.layout_paths.clear();
  without_layouts_.part.reset();
}

Result<ScreeningJob> DividedJob::shard(std::uint64_t part) const {
  ScreeningJob job = without_layouts_;
  Shard shard = shard_;
  shard.part = part;
  job.shard = {shard, fingerprint_};
  std::vector<std::size_t> chosen;
  job.results_path = shard_path(whole_.results_path, part, shard.parts);
  for (std::uint64_t block = part - 1; block < shard.block_count(); block += shard.parts) {
    const std::uint64_t end = std::min(shard.layouts, (block + 1) * shard.block);
    for (std::uint64_t layout = block * shard.block; layout < end; ++layout) chosen.push_back(layout);
  }
  job.layouts = layouts_.chosen(chosen);
  const std::string folder = shards_folder(whole_.results_path);
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure) return Error{.file = folder, .what = "cannot be created", .value = failure.message()};
  return job;
}

}  // namespace holdfast::internal
