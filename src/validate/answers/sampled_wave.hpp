#pragma once

#include <cstdint>
#include <vector>

#include "core/model/acceleration.hpp"

namespace holdfast::internal {

/// One sine of an acceleration: amplitude · sin(2π · frequency · t + phase).
struct Wave {
  Vec3 amplitude = Vec3::Zero();  ///< m/s²
  double frequency = 1.0;         ///< Hz, positive
  double phase = 0.0;             ///< rad
};

/// An acceleration that oscillates about a mean.
struct Oscillation {
  Vec3 mean = Vec3::Zero();  ///< m/s²
  std::vector<Wave> waves;
};

/// The oscillation as a recorder stores it: `rate` samples per second from t = 0, each the mean of its interval, which
/// is exact here: A (cos(2πf t₀ + φ) − cos(2πf t₁ + φ)) / (2πf (t₁ − t₀)).
/// @param duration s; the last sample ends there, or up to one interval later
Acceleration sampled(const Oscillation& oscillation, double duration, double rate);

/// A band of noise: `count` sines with amplitudes of equal power, with frequencies that are drawn between two limits at
/// equal distances of their logarithms, and drawn phases. The same seed gives the same noise on every machine.
/// @param root_mean_square of each coordinate, m/s²; the phases along x, y and z are drawn one by one
std::vector<Wave> noise(std::uint64_t seed, int count, double lowest, double highest, const Vec3& root_mean_square);

/// A friction coefficient and the ratios of half the footprint to the height of the centre of mass, along x and y: what
/// a load at rest holds by.
struct Hold {
  double friction = 0.0;
  double along_x = 0.0;
  double along_y = 0.0;
};

/// The largest share of what friction and balance hold that a sample uses up: the friction's is |a_h| / (μ (g + a_z)),
/// the balance's |a_x| / (g + a_z) over half the footprint per height of the centre, and likewise along y.
double largest_use(const Acceleration& acceleration, const Hold& hold, double gravity);

}  // namespace holdfast::internal
