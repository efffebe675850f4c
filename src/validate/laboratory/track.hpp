#pragma once

#include <functional>
#include <vector>

#include "validate/laboratory/laboratory.hpp"

namespace holdfast::internal {

/// The start and the end of every step of a run, in order; never empty.
using Track = std::vector<Snapshot>;

/// Runs the scene to its end. The track of a run that failed ends early.
Track track_of(Laboratory& laboratory, const Scene& scene);

/// A quantity of a state.
using Quantity = std::function<double(const Snapshot&)>;

/// A local maximum of a quantity.
struct Peak {
  double time = 0.0;  ///< s
  double value = 0.0;
};

/// The maxima of a quantity within the track, by the parabola through the largest sample and its neighbours: exact for
/// free flight, of fourth order in the step for smooth oscillations.
/// @param least smaller maxima are ignored as noise of a box at rest
std::vector<Peak> peaks_of(const Track& track, const Quantity& quantity, double least);

/// The impact on an obstacle, computed from the last state before it.
struct Arrival {
  double time = 0.0;   ///< s; infinity if there is no impact
  double speed = 0.0;  ///< m/s
};

/// Time and speed at which a gap closes. From the last end of a step before the impact, the remaining distance is
/// covered with the constant acceleration `acceleration`, so that nothing is interpolated across the impact.
/// @param gap          remaining distance, m
/// @param speed        speed at which the gap closes, m/s; never decreases before the impact
/// @param acceleration of the closing speed, m/s²
Arrival arrival_of(const Track& track, const Quantity& gap, const Quantity& speed, double acceleration);

/// Time at which box `i` comes to its last stop, s, with the constant deceleration `deceleration` (m/s²) before it:
/// computed from the last end of a step at which the box was faster than 1 cm/s.
double stop_time(const Track& track, std::size_t i, double deceleration);

/// Kinetic energy of all boxes that can move, J.
double kinetic_energy(const Scene& scene, const Snapshot& state);

/// Largest excess of the kinetic energy of all boxes over that of the start plus the work of gravity and of the
/// inertial forces since then, J; 0 if there is none. Contacts with fixed bodies do no work.
double energy_gain(const Scene& scene, const Track& track);

}  // namespace holdfast::internal
