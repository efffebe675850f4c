#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/model/layout.hpp"
#include "validate/laboratory/laboratory.hpp"
#include "validate/laboratory/measurement.hpp"

namespace holdfast::internal {

/// A real loading under a road acceleration. It has no exact answer; engines are compared with a converged reference.
struct LoadWorld {
  std::string layout;        ///< name
  std::string acceleration;  ///< name
  Scene scene;
};

/// Every layout under full braking (0.8 g), hard acceleration (0.5 g) and cornering to both sides (0.5 g): half a
/// second of gravity alone, one second of the acceleration, half a second of gravity alone. Friction coefficient 0.45,
/// so that 0.5 g is not exactly marginal.
std::vector<LoadWorld> load_worlds(std::span<const Layout> layouts);

/// The record of a run: positions of all boxes at equal intervals, in double.
struct LoadRun {
  std::vector<std::vector<Vec3>> positions;  ///< [sample][box], m
  double cpu_seconds = 0.0;
  double box_seconds = 0.0;
  bool failed = false;
};

/// Runs a world of the suite; samples every 10 ms.
LoadRun run_load(Laboratory& laboratory, const LoadWorld& world);

/// Compares the runs of all worlds with one setting with those of the reference, as measurements:
///
/// - displacement error while predictable: for each world the largest distance of any box from its position in the
///   reference, up to the time at which the two references differ by more than 1 mm anywhere; median and largest over
///   worlds
/// - share of worlds where "any box fell" (5 cm) and "any box moved" (10 cm) differ at the end of the run
/// - mean difference of the number of fallen boxes
/// - one minus Spearman's rank correlation of the largest displacement over worlds
/// @param runs, reference, second one entry per world, in the same order
std::vector<Measurement> compare_loads(std::span<const LoadRun> runs, std::span<const LoadRun> reference,
                                       std::span<const LoadRun> second);

/// The two settings that are references, the finer step first: `native` at `reference`, with other steps and iterations
/// the second time. Their agreement shows how far they can be trusted; that of the other engines, whether they are
/// right.
const std::vector<EngineSetting>& load_references();

}  // namespace holdfast::internal
