#include "validate/answers/sampled_wave.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace holdfast::internal {

namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

/// Uniform numbers from 0 to 1, equal on every machine: SplitMix64 (Steele, Lea, Flood 2014), of which the upper 53
/// bits are used.
class Drawing {
 public:
  explicit Drawing(std::uint64_t seed) : state_(seed) {}

  double next() {
    state_ += 0x9e3779b97f4a7c15ULL;
    std::uint64_t mixed = state_;
    mixed = (mixed ^ (mixed >> 30)) * 0xbf58476d1ce4e5b9ULL;
    mixed = (mixed ^ (mixed >> 27)) * 0x94d049bb133111ebULL;
    mixed ^= mixed >> 31;
    return static_cast<double>(mixed >> 11) * 0x1.0p-53;
  }

 private:
  std::uint64_t state_;
};

}  // namespace

Acceleration sampled(const Oscillation& oscillation, double duration, double rate) {
  Acceleration acceleration;
  const double count = std::ceil(duration * rate - kSameInstant);
  for (double i = 0.0; i < count; ++i) {
    const double begin = i / rate;
    const double end = (i + 1.0) / rate;
    Vec3 value = oscillation.mean;
    for (const Wave& wave : oscillation.waves) {
      const double pulsation = kTurn * wave.frequency;
      // The difference of the two cosines as a product, which does not cancel: 2 sin(middle) sin(half the interval).
      const double half = 0.5 * pulsation / rate;
      value += std::sin(0.5 * pulsation * (begin + end) + wave.phase) * std::sin(half) / half * wave.amplitude;
    }
    acceleration.segments.push_back({begin, end - begin, value});
  }
  return acceleration;
}

std::vector<Wave> noise(std::uint64_t seed, int count, double lowest, double highest, const Vec3& root_mean_square) {
  Drawing drawing(seed);
  // The power of a sine is half the square of its amplitude.
  const double share = std::sqrt(2.0 / count);
  std::vector<Wave> waves;
  for (int i = 0; i < count; ++i) {
    const double frequency = lowest * std::pow(highest / lowest, (i + drawing.next()) / count);
    for (int axis = 0; axis < 3; ++axis) {
      const double phase = kTurn * drawing.next();
      if (root_mean_square[axis] == 0.0) continue;
      waves.push_back({share * root_mean_square[axis] * Vec3::Unit(axis), frequency, phase});
    }
  }
  return waves;
}

double largest_use(const Acceleration& acceleration, const Hold& hold, double gravity) {
  double largest = 0.0;
  for (const Segment& segment : acceleration.segments) {
    const Vec3& a = segment.acceleration;
    const double weight = gravity + a.z();
    largest = std::max({largest, a.head<2>().norm() / (hold.friction * weight),
                        std::abs(a.x()) / (hold.along_x * weight), std::abs(a.y()) / (hold.along_y * weight)});
  }
  return largest;
}

}  // namespace holdfast::internal
