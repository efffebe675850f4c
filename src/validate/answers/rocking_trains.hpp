#pragma once

#include <vector>

#include "core/model/acceleration.hpp"

namespace holdfast::internal {

/// A train of sine cycles along x, from rest, on a block that stands on a floor of very high friction.
struct RockingTrain {
  int cycles = 1;
  double period = 1.0;     ///< s
  double amplitude = 1.0;  ///< share of the acceleration at which the block begins to tip, g · width / height
};

/// The trains of one block. Whether a train overturns a block is chaotic near the limit: only those are judged of which
/// Housner's equation says the same at every amplitude within 3 % of theirs.
struct RockingTrains {
  Vec3 size = Vec3::Ones();            ///< of the block, m; it rocks about the edges at ± x
  std::vector<RockingTrain> falling;   ///< tilt it by more than `kFallenTilt`
  std::vector<RockingTrain> standing;  ///< do not
  std::vector<RockingTrain> swinging;  ///< tilt it by 2° to 9°, within 30 % at every amplitude within 3 % of theirs
};

/// Tilt above which a train is judged to have overturned the block, rad: 10 degrees.
inline constexpr double kFallenTilt = 0.17453292519943295;

/// Four blocks with slendernesses of 7, 11, 18 and 27 degrees; at least a third of the trains leaves its block
/// standing.
const std::vector<RockingTrains>& rocking_trains();

/// The train as the acceleration of the container, in 100 samples per second, each the mean of its interval, and two
/// seconds without acceleration.
/// @param size of the block, m
/// @param factor of the amplitude
Acceleration acceleration_of(const RockingTrain& train, const Vec3& size, double gravity, double factor = 1.0);

/// The largest tilt under the train by Housner's equation with impacts, rad; a block that falls is followed to 0.1 rad
/// beyond its tipping angle.
double largest_tilt(const RockingTrain& train, const Vec3& size, double gravity, double factor = 1.0);

}  // namespace holdfast::internal
