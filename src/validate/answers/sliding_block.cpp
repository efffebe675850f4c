#include "validate/answers/sliding_block.hpp"

#include <algorithm>
#include <cmath>

namespace holdfast::internal {

namespace {

/// Moves the block through an interval of constant acceleration, from stop to stop.
void slide(SlidingBlock& block, double acceleration, double duration, const FrictionDeceleration& friction) {
  double left = duration;
  while (left > 0.0) {
    const bool at_rest = block.velocity == 0.0;
    if (at_rest && std::abs(acceleration) <= friction.at_rest) return;
    const double heading = at_rest ? -std::copysign(1.0, acceleration) : std::copysign(1.0, block.velocity);
    const double rate = -acceleration - heading * friction.sliding;
    // A decelerating block stops after |v| / |rate|, unless the interval ends before.
    const bool slows = !at_rest && rate * heading < 0.0;
    const double until_stop = slows ? -block.velocity / rate : left;
    const bool stops = slows && until_stop <= left;
    const double time = stops ? until_stop : left;
    const double path = time * (block.velocity + 0.5 * rate * time);
    block.displacement += path;
    block.distance += std::abs(path);
    block.velocity = stops ? 0.0 : block.velocity + rate * time;
    left -= time;
  }
}

}  // namespace

SlidingBlock slide_along_x(const Acceleration& acceleration, const FrictionDeceleration& friction) {
  SlidingBlock block;
  for (const Phase& phase : phases_of(acceleration, acceleration.end_time()))
    slide(block, phase.acceleration.x(), phase.end - phase.begin, friction);
  return block;
}

}  // namespace holdfast::internal
