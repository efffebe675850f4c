#include "app/bench/bench_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>

#include "io/export/csv_field.hpp"
#include "io/export/text_output.hpp"
#include "io/input/text_file.hpp"

namespace holdfast::internal {

namespace {

using Figure = std::function<double(const BenchSample&)>;

std::vector<double> sorted(const BenchRow& row, const Figure& figure) {
  std::vector<double> values;
  for (const BenchSample& sample : row.samples) values.push_back(figure(sample));
  std::sort(values.begin(), values.end());
  return values;
}

double median(const BenchRow& row, const Figure& figure) {
  const std::vector<double> values = sorted(row, figure);
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

/// Largest minus smallest, over the median.
double spread(const BenchRow& row, const Figure& figure) {
  const std::vector<double> values = sorted(row, figure);
  return (values.back() - values.front()) / median(row, figure);
}

double share(double part, double whole) { return whole > 0.0 ? part / whole : 0.0; }

double wall(const BenchSample& s) { return s.wall_seconds; }
double worlds_per_second(const BenchSample& s) { return static_cast<double>(s.worlds) / s.wall_seconds; }
double box_steps_per_second(const BenchSample& s) { return static_cast<double>(s.box_steps) / s.wall_seconds; }
double cpu_per_simulated(const BenchSample& s) { return share(s.cpu_seconds, s.simulated_seconds); }
double skipped(const BenchSample& s) {
  return share(static_cast<double>(s.steps_skipped), static_cast<double>(s.steps));
}
double boxes_per_world(const BenchSample& s) {
  return share(static_cast<double>(s.boxes), static_cast<double>(s.worlds));
}

/// The row that a row's efficiency is measured against: the one of the fewest threads.
const BenchRow& base_of(const std::vector<BenchRow>& rows, const BenchRow& row) {
  const BenchRow* base = &row;
  for (const BenchRow& other : rows) {
    const BenchCase& a = row.bench_case;
    const BenchCase& b = other.bench_case;
    if (a.engine == b.engine && a.set == b.set && a.series == b.series && b.threads < base->bench_case.threads)
      base = &other;
  }
  return *base;
}

/// Speed-up over the fewest threads, and the parallel efficiency of the added threads; "-" for the fewest threads.
std::string scaling_text(const std::vector<BenchRow>& rows, const BenchRow& row) {
  const BenchRow& base = base_of(rows, row);
  if (&base == &row) return fmt::format("{:>7}  {:>10}", "-", "-");
  const double speedup = median(base, wall) / median(row, wall);
  const double more = static_cast<double>(row.bench_case.threads) / base.bench_case.threads;
  return fmt::format("{:>7.2f}  {:>8.0f} %", speedup, 100.0 * speedup / more);
}

std::string name_of(const BenchCase& c) {
  return fmt::format("{:<14} {:<14} {:>7} {:>6}", c.engine, c.set, c.threads, c.series ? "on" : "off");
}

constexpr const char* kNameHeader = "engine         layouts        threads series";

std::string csv_header() {
  std::string text =
      "engine,layouts,threads,series,repetition,hash,worlds,boxes,steps,steps_skipped,box_steps,simulated_seconds,"
      "wall_seconds,cpu_seconds,peak_memory_MiB,file_size_MiB";
  for (const char* stage : kStageNames) text += fmt::format(",{}_cpu_seconds", stage);
  return text + "\r\n";
}

}  // namespace

std::optional<Error> check_same_results(const std::vector<BenchRow>& rows) {
  std::map<std::pair<std::string, std::string>, std::string> hashes;
  for (const BenchRow& row : rows) {
    for (const BenchSample& sample : row.samples) {
      const auto [first, is_new] = hashes.try_emplace({row.bench_case.engine, row.bench_case.set}, sample.hash);
      if (is_new || first->second == sample.hash) continue;
      return Error{.what = "runs of the same worlds gave different results, so no speed is reported",
                   .value = fmt::format("{} of {} with {} threads, hash {} instead of {}", row.bench_case.engine,
                                        row.bench_case.set, row.bench_case.threads, sample.hash, first->second)};
    }
  }
  return std::nullopt;
}

std::string bench_tables(const std::vector<BenchRow>& rows) {
  std::string text = fmt::format(
      "{}  boxes  worlds/s  spread  speedup  efficiency  box-steps/s  CPU s/sim. s  skipped  "
      "peak MiB\n",
      kNameHeader);
  for (const BenchRow& row : rows) {
    text += fmt::format("{}  {:>5.0f}  {:>8.2f}  {:>5.1f} %  {}  {:>11.4g}  {:>12.4g}  {:>5.1f} %  {:>8.1f}\n",
                        name_of(row.bench_case), median(row, boxes_per_world), median(row, worlds_per_second),
                        100.0 * spread(row, worlds_per_second), scaling_text(rows, row),
                        median(row, box_steps_per_second), median(row, cpu_per_simulated), 100.0 * median(row, skipped),
                        median(row, [](const BenchSample& s) { return s.peak_memory; }));
  }
  text += fmt::format("\nprocessor time by stage, of the process's whole\n{}", kNameHeader);
  for (const char* stage : kStageNames) text += fmt::format("  {:>8}", stage);
  text += "     other\n";
  for (const BenchRow& row : rows) {
    text += name_of(row.bench_case);
    double rest = 100.0;
    for (std::size_t i = 0; i < kStageNames.size(); ++i) {
      const double percent =
          100.0 * median(row, [i](const BenchSample& s) { return share(s.stages[i], s.cpu_seconds); });
      text += fmt::format("  {:>6.2f} %", percent);
      rest -= percent;
    }
    text += fmt::format("  {:>6.2f} %\n", rest);
  }
  return text;
}

std::string bench_csv(const std::vector<BenchRow>& rows) {
  std::string text = csv_header();
  for (const BenchRow& row : rows) {
    const BenchCase& c = row.bench_case;
    for (std::size_t i = 0; i < row.samples.size(); ++i) {
      const BenchSample& s = row.samples[i];
      text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\r\n", csv_field(c.engine),
                          csv_field(c.set), c.threads, c.series ? 1 : 0, i, s.hash, s.worlds, s.boxes, s.steps,
                          s.steps_skipped, s.box_steps, s.simulated_seconds, s.wall_seconds, s.cpu_seconds,
                          s.peak_memory, s.file_size, fmt::join(s.stages, ","));
    }
  }
  return text;
}

std::optional<Error> check_bench_csv(const std::string& path) {
  return check_output_file(path, [](const std::string& old) {
    const Result<TextFile> file = read_text_file(old);
    return file && file->text.starts_with(csv_header());
  });
}

}  // namespace holdfast::internal
