#pragma once

#include <vector>

#include "validate/laboratory/laboratory.hpp"
#include "validate/laboratory/measurement.hpp"

namespace holdfast::internal {

/// Largest distance of any box from where it was at the time `from`, at any later step end, m. Ends the run once that
/// passes `enough`, and then returns what it was. Infinite when the run failed.
double departure(Laboratory& laboratory, const Scene& scene, double from, double enough);

/// The load along x, from the rest of `scene` on, that moves a box by more than `distance` within `duration`, m/s²:
/// found by bisection between the two bounds, which are loads, to a share of `precision`. The scene's own motion, if
/// any, comes first and is no part of the departure.
double smallest_load_that_moves(Laboratory& laboratory, const Scene& scene, double distance, double duration,
                                double low, double high, double precision);

/// Rest asked of a whole run: the largest displacement and turn from the start and the greatest speed at the end, all
/// of which are to be zero exactly; errors are the values themselves in m, rad and m/s. A run ends early once a box has
/// gone 0.1 m.
std::vector<Measurement> rest_of(Laboratory& laboratory, const Scene& scene);

}  // namespace holdfast::internal
