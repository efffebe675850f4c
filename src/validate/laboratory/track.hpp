#pragma once

#include <functional>
#include <vector>

#include "validate/laboratory/laboratory.hpp"

namespace holdfast::internal {

/// The start and every step end of a run, in order; never empty.
using Track = std::vector<Snapshot>;

/// Runs the scene to its end. The track of a run that failed ends early.
Track track_of(Laboratory& laboratory, const Scene& scene);

/// A number that a state has.
using Quantity = std::function<double(const Snapshot&)>;

/// A local maximum of a quantity.
struct Peak {
  double time = 0.0;  ///< s
  double value = 0.0;
};

/// The maxima of a quantity inside the track, by the parabola through the largest sample and its neighbours: exact for
/// what flies, of fourth order in the step for what swings smoothly through its peak.
/// @param least smaller maxima are left out: noise of a box at rest
std::vector<Peak> peaks_of(const Track& track, const Quantity& quantity, double least);

/// How something meets an obstacle, judged by the last state before.
struct Arrival {
  double time = 0.0;   ///< s; infinity when it never meets it
  double speed = 0.0;  ///< m/s
};

/// When and how fast a gap closes. What is known is the last step end before the impact; the rest of the way is run
/// under the constant acceleration `acceleration`, so that no interpolation over the impact spoils the answer.
/// @param gap          distance left, m
/// @param speed        speed at which the gap closes, m/s; never falls before the impact
/// @param acceleration of the closing speed, m/s²
Arrival arrival_of(const Track& track, const Quantity& gap, const Quantity& speed, double acceleration);

/// When box `i` comes to its last stop, s, known that it decelerates steadily by `deceleration` (m/s²) before: the last
/// step end at which it was faster than 1 cm/s, and the rest of the way at that deceleration.
double stop_time(const Track& track, std::size_t i, double deceleration);

/// Kinetic energy of all boxes that can move, J.
double kinetic_energy(const Scene& scene, const Snapshot& state);

/// By how much the kinetic energy of all boxes exceeds, at worst, that of the start plus the work of gravity and of the
/// container's acceleration since, J; 0 when it never does. Contacts with what is fixed do no work.
double energy_gain(const Scene& scene, const Track& track);

}  // namespace holdfast::internal
