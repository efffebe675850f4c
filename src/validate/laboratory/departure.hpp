#pragma once

#include <vector>

#include "validate/laboratory/laboratory.hpp"
#include "validate/laboratory/measurement.hpp"

namespace holdfast::internal {

/// Largest distance of any box from its position at the time `from`, over all later ends of steps, m. Ends the run once
/// it exceeds `enough`. Infinite if the run failed.
double departure(Laboratory& laboratory, const Scene& scene, double from, double enough);

/// The acceleration along x, applied after the scene's own acceleration, that moves a box by more than `distance`
/// within `duration`, m/s². Found by bisection between the two bounds, which are accelerations, to the relative
/// precision `precision`. Motion during the scene's own acceleration does not count.
double smallest_load_that_moves(Laboratory& laboratory, const Scene& scene, double distance, double duration,
                                double low, double high, double precision);

/// Measurements of rest in a whole run: the largest displacement and rotation from the start and the largest speed at
/// the end, all of which should be exactly zero; errors are the values in m, rad and m/s. A run ends early once a box
/// has moved by 0.1 m.
std::vector<Measurement> rest_of(Laboratory& laboratory, const Scene& scene);

}  // namespace holdfast::internal
