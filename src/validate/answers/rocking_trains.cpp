#include "validate/answers/rocking_trains.hpp"

#include <algorithm>

#include "validate/answers/rocking.hpp"
#include "validate/answers/sampled_wave.hpp"

namespace holdfast::internal {

const std::vector<RockingTrains>& rocking_trains() {
  // Of periods from 0.5 to 4 s and amplitudes from 1.03 to 1.8, for each period the weakest trains that surely overturn
  // the block, and the strongest that surely do not.
  static const std::vector<RockingTrains> kTrains = {
      {.size = {0.26, 0.60, 1.35},
       .falling = {{1, 0.5, 1.7},  {1, 0.7, 1.4},  {1, 1, 1.3},  {1, 1.25, 1.3}, {1, 1.5, 1.2}, {1, 2, 1.2},
                   {1, 2.5, 1.15}, {1, 3, 1.15},   {1, 4, 1.1},  {2, 0.7, 1.6},  {2, 0.7, 1.8}, {2, 1, 1.3},
                   {2, 1.25, 1.2}, {2, 1.5, 1.15}, {2, 2, 1.1},  {2, 2.5, 1.1},  {2, 3, 1.1},   {2, 4, 1.1},
                   {4, 0.7, 1.5},  {4, 0.7, 1.7},  {4, 1, 1.15}, {4, 1.25, 1.1}, {4, 1.5, 1.1}, {4, 2, 1.1},
                   {4, 2.5, 1.1},  {4, 3, 1.1},    {4, 4, 1.06}, {8, 0.7, 1.5},  {8, 0.7, 1.7}, {8, 1, 1.1},
                   {8, 1.25, 1.1}, {8, 1.5, 1.06}, {8, 2, 1.1},  {8, 2.5, 1.1},  {8, 3, 1.06},  {8, 4, 1.06}},
       .standing = {{1, 0.5, 1.5},
                    {1, 0.7, 1.2},
                    {1, 1, 1.15},
                    {1, 1.5, 1.1},
                    {2, 0.5, 1.6},
                    {2, 0.5, 1.8},
                    {2, 0.7, 1.03},
                    {2, 0.7, 1.4},
                    {2, 1, 1.03},
                    {4, 0.5, 1.06},
                    {4, 0.5, 1.15},
                    {4, 0.5, 1.3},
                    {4, 0.5, 1.5},
                    {4, 0.5, 1.7},
                    {8, 0.5, 1.1},
                    {8, 0.5, 1.2},
                    {8, 0.5, 1.4},
                    {8, 0.5, 1.6}},
       .swinging = {{1, 0.5, 1.4}, {1, 0.5, 1.5}, {2, 0.5, 1.5}, {2, 0.7, 1.3}, {4, 0.5, 1.5}, {8, 0.5, 1.3}}},
      {.size = {0.20, 0.60, 1.60},
       .falling = {{1, 0.7, 1.5},
                   {1, 1.25, 1.3},
                   {1, 2, 1.2},
                   {1, 3, 1.15},
                   {2, 1, 1.4},
                   {2, 1.5, 1.15},
                   {2, 2.5, 1.1},
                   {2, 4, 1.06},
                   {4, 0.7, 1.8},
                   {4, 1.25, 1.1},
                   {4, 2, 1.06},
                   {4, 3, 1.06},
                   {8, 1, 1.1},
                   {8, 1.5, 1.06},
                   {8, 2.5, 1.06},
                   {8, 4, 1.06}},
       .standing = {{1, 0.5, 1.6},
                    {1, 0.7, 1.3},
                    {2, 0.5, 1.8},
                    {2, 0.7, 1.5},
                    {4, 0.5, 1.5},
                    {4, 0.5, 1.7},
                    {8, 0.5, 1.4},
                    {8, 0.5, 1.6}},
       .swinging = {{1, 0.5, 1.6}, {2, 0.7, 1.5}, {8, 0.5, 1.6}}},
      {.size = {0.30, 0.60, 0.90},
       .falling = {{1, 0.7, 1.3},
                   {1, 1.25, 1.2},
                   {1, 2, 1.15},
                   {1, 3, 1.1},
                   {2, 1, 1.2},
                   {2, 1.5, 1.15},
                   {2, 2.5, 1.1},
                   {2, 4, 1.1},
                   {4, 0.7, 1.15},
                   {4, 1.25, 1.15},
                   {4, 2, 1.1},
                   {4, 3, 1.1},
                   {8, 1, 1.2},
                   {8, 1.5, 1.1},
                   {8, 2.5, 1.1},
                   {8, 4, 1.1}},
       .standing = {{1, 0.5, 1.3},
                    {1, 0.7, 1.2},
                    {2, 0.5, 1.4},
                    {2, 0.7, 1.06},
                    {4, 0.5, 1.4},
                    {4, 2, 1.03},
                    {8, 0.5, 1.4},
                    {8, 2, 1.03}},
       .swinging = {{1, 0.5, 1.3}, {2, 0.5, 1.3}}},
      {.size = {0.60, 0.80, 1.20},
       .falling = {{1, 0.7, 1.4},
                   {1, 1.25, 1.3},
                   {1, 2, 1.2},
                   {1, 3, 1.15},
                   {2, 1, 1.2},
                   {2, 1.5, 1.2},
                   {2, 2.5, 1.15},
                   {2, 4, 1.1},
                   {4, 0.7, 1.2},
                   {4, 1.25, 1.2},
                   {4, 2, 1.15},
                   {4, 3, 1.15},
                   {8, 1, 1.2},
                   {8, 1.5, 1.2},
                   {8, 2.5, 1.15},
                   {8, 4, 1.1}},
       .standing = {{1, 0.5, 1.5},
                    {1, 0.7, 1.2},
                    {2, 0.5, 1.8},
                    {2, 0.7, 1.1},
                    {4, 0.5, 1.8},
                    {4, 0.7, 1.06},
                    {8, 0.5, 1.8},
                    {8, 0.7, 1.06}},
       .swinging = {{1, 0.5, 1.4}, {2, 0.5, 1.25}, {4, 0.5, 1.5}}},
  };
  return kTrains;
}

Acceleration acceleration_of(const RockingTrain& train, const Vec3& size, double gravity, double factor) {
  constexpr double kRate = 100.0;     // samples per second
  constexpr double kAftermath = 2.0;  // s
  const double limit = gravity * size.x() / size.z();
  const Oscillation sine = {Vec3::Zero(),
                            {{factor * train.amplitude * limit * Vec3::UnitX(), 1.0 / train.period, 0.0}}};
  Acceleration acceleration = sampled(sine, train.cycles * train.period, kRate);
  acceleration.segments.push_back({acceleration.end_time(), kAftermath, Vec3::Zero()});
  return acceleration;
}

double largest_tilt(const RockingTrain& train, const Vec3& size, double gravity, double factor) {
  const RockingBlock block = rocking_block(size.x(), size.z(), gravity);
  const double lost = std::max(block.slenderness, kFallenTilt) + 0.1;
  return rocked_by(block, acceleration_of(train, size, gravity, factor), gravity, lost).largest_tilt;
}

}  // namespace holdfast::internal
