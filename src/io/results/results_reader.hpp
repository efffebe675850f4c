#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "core/engine/world_record.hpp"
#include "core/model/indicators.hpp"
#include "core/model/margin.hpp"
#include "core/model/verdict.hpp"

namespace holdfast::internal {

/// The description of a run in its results file.
struct ResultsInfo {
  std::string path;  ///< as it was opened, for messages
  std::string software;
  std::string git_commit;
  std::string engine;
  std::string command_line;
  std::string created_utc;
  std::string host;
  std::string fingerprint;
  bool complete = false;           ///< false for a part
  Thresholds thresholds;           ///< of its summary
  std::string norm;                ///< of the run; empty: none
  bool has_margins = false;        ///< whether the run was asked for margins
  bool has_margin_spread = false;  ///< whether it was asked for these and for replicas
  bool has_walls = false;          ///< whether the run was asked for wall forces
  bool has_replicas = false;       ///< whether it was asked for replicas
  bool has_damage = false;         ///< whether it was asked for damage
  bool has_indicators = false;     ///< whether it was asked for indicators
  std::uint64_t world_begin = 0;   ///< index in the run of the file's first world; 0 unless a part
  std::uint64_t layout_begin = 0;  ///< index in the run of the file's first layout; 0 unless a part
  std::uint64_t world_count = 0;
  std::uint64_t box_count = 0;
  std::vector<std::string> layouts;        ///< names, from `layout_begin` on
  std::vector<std::string> accelerations;  ///< names
};

/// One row of /worlds. The begin indices are indices in the file, also for a part.
struct WorldRow {
  std::uint64_t layout = 0;
  std::uint64_t acceleration = 0;
  Status status = Status::ok;
  std::string status_text;
  StopReason stop_reason = StopReason::not_run;
  std::uint64_t box_begin = 0;
  std::uint32_t box_count = 0;
  std::uint64_t sample_begin = 0;
  std::uint32_t sample_count = 0;
  std::uint64_t row_begin = 0;
  double end_time = 0.0;
  std::uint64_t steps = 0;
  std::uint64_t steps_skipped = 0;
  std::uint64_t solve_iterations = 0;
  double max_residual = 0.0;    ///< m/s; in a file of version 1, where the scale is 1, a ratio
  double residual_scale = 1.0;  ///< m/s
  double max_penetration = 0.0;
  double peak_total_kinetic_energy = 0.0;
  double cpu_seconds = 0.0;
  std::uint64_t state_hash = 0;
  std::string engine;
};

namespace h5 {
class File;
}

/// Worlds that are read and held in memory at a time by what goes through all worlds of a file.
inline constexpr std::uint64_t kSliceWorlds = 1024;

/// Reads a results file, or a single part of one. Used by one thread at a time.
class ResultsReader {
 public:
  /// An error if the file cannot be opened, is not a results file, or has a later format.
  static Result<ResultsReader> open(const std::string& path);

  /// Reads a file that is still being written; `file` must outlive the reader. For src/io only.
  static Result<ResultsReader> attach(const h5::File& file);

  ResultsReader(ResultsReader&&) noexcept;
  ResultsReader& operator=(ResultsReader&&) noexcept;
  ~ResultsReader();

  const ResultsInfo& info() const;

  /// Rows [begin, begin + count) of /worlds.
  Result<std::vector<WorldRow>> worlds(std::uint64_t begin, std::uint64_t count);

  /// Rows [begin, begin + count) of /margins, of a file that has them: one per layout, from the file's first one on.
  Result<std::vector<LayoutMargins>> margins(std::uint64_t begin, std::uint64_t count);

  /// The indicators of layouts [begin, begin + count) of a file that has them, without those of boxes.
  Result<std::vector<LayoutIndicators>> indicators(std::uint64_t begin, std::uint64_t count);
  /// Those of the boxes of a layout of the file alone.
  Result<LayoutIndicators> box_indicators(std::uint64_t layout);

  /// Rows [begin, begin + count) of /walls, of a file that has them.
  Result<std::vector<WallForces>> walls(std::uint64_t begin, std::uint64_t count);
  /// Rows [begin, begin + count) of /replicas, of a file that has them: one per world, without shares of boxes.
  Result<std::vector<ReplicaOutcome>> replicas(std::uint64_t begin, std::uint64_t count);

  /// How many boxes are beyond the damage boundary, in worlds [begin, begin + count) of a file that has damage.
  Result<std::vector<std::uint32_t>> boxes_beyond(std::uint64_t begin, std::uint64_t count);
  /// Boxes [begin, begin + count) of such a file.
  Result<BoxDamage> box_damage(std::uint64_t begin, std::uint64_t count);

  /// Rows [begin, begin + count) of /boxes: properties and end values of boxes.
  Result<BoxTable> boxes(std::uint64_t begin, std::uint64_t count);
  Result<EndTable> ends(std::uint64_t begin, std::uint64_t count);

  /// The series of a world; empty when not recorded.
  Result<Series> series(const WorldRow& world);

  /// The series of a world with time and displacement only.
  Result<Series> path_of(const WorldRow& world);

 private:
  struct State;
  explicit ResultsReader(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace holdfast::internal
