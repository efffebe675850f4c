#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/model/layout.hpp"
#include "validate/laboratory/laboratory.hpp"
#include "validate/laboratory/measurement.hpp"

namespace holdfast::internal {

/// A real load under a road acceleration: no exact answer, so engines are compared with a converged reference.
struct LoadWorld {
  std::string layout;        ///< name
  std::string acceleration;  ///< name
  Scene scene;
};

/// Every layout under full braking (0.8 g), hard acceleration (0.5 g) and cornering to both sides (0.5 g): half a
/// second at rest, one second of it, half a second at rest. Friction coefficient 0.45, so that 0.5 g is not exactly
/// marginal.
std::vector<LoadWorld> load_worlds(std::span<const Layout> layouts);

/// What is kept of a run of a load: positions of all boxes at equal intervals, in double.
struct LoadRun {
  std::vector<std::vector<Vec3>> positions;  ///< [sample][box], m
  double cpu_seconds = 0.0;
  double box_seconds = 0.0;
  bool failed = false;
};

/// Runs a load; samples every 10 ms.
LoadRun run_load(Laboratory& laboratory, const LoadWorld& world);

/// The outcome of all loads with one setting against the reference's, as measurements:
///
/// - displacement error while predictable: of each world the largest distance of any box from where the reference has
///   it, up to the time at which the two references differ by more than 1 mm somewhere; median and largest over worlds
/// - share of worlds where "any box fell" (5 cm) and "any box moved" (10 cm) come out differently over the whole run
/// - mean difference of the number of fallen boxes
/// - one minus Spearman's rank correlation of the largest displacement over worlds
/// @param runs, reference, second an entry a world, in the same order
std::vector<Measurement> compare_loads(std::span<const LoadRun> runs, std::span<const LoadRun> reference,
                                       std::span<const LoadRun> second);

/// The two settings that serve as references, the finer one first: they differ in step, iterations and precision, and
/// how far they agree says how far either can be trusted.
const std::vector<EngineSetting>& load_references();

}  // namespace holdfast::internal
