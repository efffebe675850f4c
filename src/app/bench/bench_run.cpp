#include "app/bench/bench_run.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <span>

#include "app/report.hpp"
#include "app/stage_costs_file.hpp"
#include "io/export/text_output.hpp"
#include "io/input/text_file.hpp"
#include "io/results/results_reader.hpp"
#include "parallel/schedulers/ticker.hpp"

namespace holdfast::internal {

namespace {

/// Resources that the process used, and how it ended.
struct Ended {
  int exit_code = 0;
  double wall_seconds = 0.0;
  rusage usage{};
};

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

/// Runs this program again with other arguments, until it ends or `stop` is set. Its standard input and standard error
/// are files, its standard output is dropped.
Result<Ended> run_self(std::vector<std::string> words, const std::string& input_path, const std::string& said_path,
                       const std::atomic<bool>& stop) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, input_path.c_str(), O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDERR_FILENO, said_path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
  const auto begin = std::chrono::steady_clock::now();
  pid_t child = 0;
  const int failure = posix_spawn(&child, "/proc/self/exe", &files, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  if (failure != 0) return Error{.what = "a run cannot be started", .value = std::strerror(failure)};
  {
    // Nothing of a stopped run is kept, so it may end at once. Its number is its own until it is waited for below.
    const Ticker ticker(std::chrono::milliseconds(50), [&] {
      if (stop) ::kill(child, SIGKILL);
    });
    siginfo_t ignored = {};
    ::waitid(P_PID, static_cast<id_t>(child), &ignored, WEXITED | WNOWAIT);
  }
  Ended ended;
  int status = 0;
  ::wait4(child, &status, 0, &ended.usage);
  ended.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  ended.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return ended;
}

/// Appends the bytes of a column.
template <class T>
void append_bytes(const std::vector<T>& column, std::string& bytes) {
  const auto raw = std::as_bytes(std::span(column));
  bytes.append(reinterpret_cast<const char*>(raw.data()), raw.size());
}

/// Adds the figures of the results file to the sample.
std::optional<Error> take_results(const std::string& path, BenchSample& sample) {
  Result<ResultsReader> results = ResultsReader::open(path);
  if (!results) return results.error();
  const ResultsInfo& info = results->info();
  std::string hashes;
  for (std::uint64_t begin = 0; begin < info.world_count; begin += kSliceWorlds) {
    const auto rows = results->worlds(begin, std::min(kSliceWorlds, info.world_count - begin));
    if (!rows) return rows.error();
    std::string bytes;
    for (const WorldRow& row : *rows) {
      sample.steps += row.steps;
      sample.steps_skipped += row.steps_skipped;
      sample.box_steps += row.steps * row.boxes;
      sample.simulated_seconds += row.end_time;
      append_bytes(std::vector<std::uint64_t>{row.state_hash}, bytes);
    }
    const std::uint64_t box_begin = rows->front().box_begin;
    const auto ends = results->ends(box_begin, rows->back().box_begin + rows->back().boxes - box_begin);
    if (!ends) return ends.error();
    append_bytes(ends->end_displacement, bytes);
    append_bytes(ends->end_tilt, bytes);
    append_bytes(ends->peak_displacement, bytes);
    append_bytes(ends->peak_kinetic_energy, bytes);
    hashes += sha256_of(bytes);
  }
  sample.worlds = info.world_count;
  sample.boxes = info.box_count;
  sample.hash = sha256_of(hashes).substr(0, 16);
  return std::nullopt;
}

}  // namespace

Result<BenchSample> run_bench_case(const BenchCase& bench_case, const BenchInputs& inputs,
                                   const std::atomic<bool>& stop) {
  const std::string results = inputs.folder + "/results.h5";
  const std::string costs = inputs.folder + "/costs.json";
  const std::string list = inputs.folder + "/layouts.list";
  const std::string said = inputs.folder + "/said.txt";
  if (const auto error = write_text_file(list, fmt::format("{}\n", fmt::join(bench_case.layouts, "\n")))) return *error;
  std::vector<std::string> words = {"holdfast",  "screen",
                                    "--quiet",   "--overwrite",
                                    "--engine",  bench_case.engine,
                                    "--threads", std::to_string(bench_case.threads),
                                    "-o",        results,
                                    "--costs",   costs,
                                    "--layouts", "-"};
  if (inputs.config_path) words.insert(words.end(), {"-c", *inputs.config_path});
  if (!bench_case.series) words.emplace_back("--no-series");
  words.emplace_back("--accelerations");
  words.insert(words.end(), inputs.accelerations.begin(), inputs.accelerations.end());

  const Result<Ended> ended = run_self(words, list, said, stop);
  if (!ended) return ended.errors();
  if (ended->exit_code != 0) {
    if (const Result<TextFile> text = read_text_file(said); text && !stop) write_to(stderr, text->text);
    return Error{.what = "a run failed, so nothing is measured",
                 .value = fmt::format("exit code {} of: {}", ended->exit_code, fmt::join(words, " "))};
  }
  BenchSample sample;
  sample.wall_seconds = ended->wall_seconds;
  sample.cpu_seconds = seconds_of(ended->usage.ru_utime) + seconds_of(ended->usage.ru_stime);
  sample.peak_memory = static_cast<double>(ended->usage.ru_maxrss) / 1024.0;
  sample.file_size = static_cast<double>(std::filesystem::file_size(results)) / 1048576.0;
  const Result<StageSeconds> stages = read_stage_seconds(costs);
  if (!stages) return stages.errors();
  sample.stages = *stages;
  if (const auto error = take_results(results, sample)) return *error;
  std::filesystem::remove(results);
  return sample;
}

}  // namespace holdfast::internal
