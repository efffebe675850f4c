#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "core/model/verdict.hpp"
#include "io/results/results_reader.hpp"

namespace holdfast::internal {

/// /summary/worlds, one entry per world; see WorldVerdict for a world that was not simulated.
struct WorldSummary {
  std::vector<Verdict> verdict;
  std::vector<std::uint32_t> fallen_boxes;
  std::vector<std::uint32_t> unstable_boxes;
  std::vector<std::uint32_t> moved_boxes;
  std::vector<std::uint32_t> tilted_boxes;
  std::vector<double> total_kinetic_energy;  ///< at the end, J
  std::vector<double> peak_kinetic_energy;   ///< of the total, over all steps, J
  std::vector<float> max_displacement;       ///< at the end, m
  std::vector<float> peak_displacement;      ///< over all steps, m
};

/// /summary/boxes, one entry per box.
struct BoxSummary {
  std::vector<Float3> displacement;        ///< at the end, m
  std::vector<float> max_displacement;     ///< over all steps, m
  std::vector<float> drop;                 ///< m
  std::vector<float> tilt;                 ///< degrees
  std::vector<float> kinetic_energy;       ///< at the end, J
  std::vector<float> peak_kinetic_energy;  ///< over all steps, J
  std::vector<std::uint8_t> fallen;        ///< 0 or 1; so are the next three
  std::vector<std::uint8_t> moved;
  std::vector<std::uint8_t> tilted;
  std::vector<std::uint8_t> unstable;
  std::vector<float> first_move_time;  ///< s; NaN if the box never moved, or without series
};

/// The summary of some consecutive worlds and all their boxes.
struct SummarySlice {
  std::uint64_t world_begin = 0;  ///< row of /worlds of the first one
  std::uint64_t box_begin = 0;    ///< row of /boxes of their first box
  std::vector<WorldRow> rows;
  WorldSummary worlds;
  BoxSummary boxes;
};

/// Adds a world and its boxes to the summary.
void append_summary(const WorldRecord& world, const Thresholds& thresholds, WorldSummary& worlds, BoxSummary& boxes);

/// Derives the summary of all worlds in slices, in the order of the file; memory does not grow with the file.
/// Used for other thresholds, and for printing; the summary in a results file is derived when each world finishes.
/// @param visit returns an error to stop
std::optional<Error> derive_summary(ResultsReader& results, const Thresholds& thresholds,
                                    const std::function<std::optional<Error>(const SummarySlice&)>& visit);

/// Writes the summary for other thresholds into a new HDF5 file, with the names that are needed to read it; attributes
/// name the results file. Never overwrites a file; refuses a part, because a part repeats boxes of others.
std::optional<Error> write_summary(const std::string& results_path, const Thresholds& thresholds,
                                   const std::string& path);

/// Writes the margins of a file that has them as `layout,direction,margin_g,critical_box`, and with replicas
/// `low_g,median_g,high_g`, one line per layout and direction. For src/io only; throws `h5::Failure`.
void write_margin_csv(ResultsReader& results, const std::string& path);

/// Writes the forces on the sides of a file that has them, one line per world that was simulated and side. For src/io
/// only; throws `h5::Failure`.
void write_wall_csv(ResultsReader& results, const std::string& path);

/// Writes the replicas of a file that has them, one line per world. For src/io only; throws `h5::Failure`.
void write_replica_csv(ResultsReader& results, const std::string& path);

/// Writes `worlds.csv` and `boxes.csv` into the folder, and `margins.csv`, `walls.csv` and `replicas.csv` where the run
/// was asked for these; with damage or indicators, both of the first have more columns. The folder is created if it is
/// missing; existing files are replaced. RFC 4180, one header line, units at the end of the names (`drop_m`).
/// pandas.read_csv needs no options.
std::optional<Error> write_summary_csv(const std::string& results_path, const Thresholds& thresholds,
                                       const std::string& folder);

}  // namespace holdfast::internal
