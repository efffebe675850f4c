#include "core/native/sampled_step.hpp"

#include <algorithm>
#include <cmath>

#include "core/model/samples.hpp"
#include "core/native/constants.hpp"

namespace holdfast::internal::native {

namespace {

/// How far a body may be, in a step with the mean of its samples, from where these lead it: one that slides alone, and
/// one that nothing holds where a body turns, also by `kSlack` of its way at most. Far below the error of a simulation
/// with such steps.
/// @measured Half and twice: insensitive, also the suite `oscillate` of `validate`.
constexpr double kSampledShift = 2.0 * kContactTolerance;  // m

/// How a block has moved: horizontally, and one that nothing holds also vertically.
struct Path {
  Vec3 shift = Vec3::Zero();  ///< m
  Vec3 slip = Vec3::Zero();   ///< velocity, m/s
};

Vec3 horizontal(const Vec3& v) { return {v.x(), v.y(), 0.0}; }

Vec3 vertical(const Vec3& v) { return {0.0, 0.0, v.z()}; }

/// What presses a block on the surface, over its mass, m/s².
double pressure(const Vec3& effective_gravity) { return std::max(0.0, -effective_gravity.z()); }

/// Takes a block through a time of constant effective gravity: exact along a line and without friction, and else
/// along the direction in which it slides at the begin.
void slide(const LoneBlock& block, const Vec3& effective_gravity, double duration, Path& path) {
  if (block.friction == 0.0) {
    path.shift += duration * (path.slip + 0.5 * duration * effective_gravity);
    path.slip += duration * effective_gravity;
    return;
  }
  const Vec3 drive = horizontal(effective_gravity);
  const double hold = pressure(effective_gravity);
  if (path.slip == Vec3::Zero() && drive.norm() <= block.friction * hold) return;
  const Vec3 direction = (path.slip != Vec3::Zero() ? path.slip : drive).stableNormalized();
  const Vec3 rate = drive - block.kinetic_friction * hold * direction;
  const double speed = path.slip.norm();
  const double slowing = -rate.dot(direction);
  const double time = slowing * duration > speed ? speed / slowing : duration;
  path.shift += time * (path.slip + 0.5 * time * rate);
  path.slip += time * rate;
  if (time == duration) return;
  path.slip = Vec3::Zero();
  slide(block, effective_gravity, duration - time, path);
}

/// Whether a step with the mean leads the block to where the samples do, and lets it slide on as they do.
bool follows(const LoneBlock& block, std::span<const Phase> samples, const Phase& mean, const Vec3& gravity) {
  const double duration = mean.end - mean.begin;
  Path path{.slip = block.slip}, with_mean = path;
  for_each_within(samples, mean.begin, mean.end,
                  [&](const Vec3& acceleration, double length) { slide(block, gravity - acceleration, length, path); });
  slide(block, gravity - mean.acceleration, duration, with_mean);
  const auto is_near = [&](auto part_of) {
    const double away =
        part_of(path.shift - with_mean.shift).norm() + duration * part_of(path.slip - with_mean.slip).norm();
    const double way = part_of(path.shift).norm() + duration * part_of(path.slip).norm();
    return away <= std::min(kSlack * way, kSampledShift);
  };
  return is_near(horizontal) && is_near(vertical);
}

/// How far the container is from where it is under the samples, at most at their ends, where a step with their mean
/// begins from the same state, m.
double largest_shift(std::span<const Phase> samples, const Phase& mean) {
  Vec3 velocity = Vec3::Zero(), shift = Vec3::Zero();
  double largest = 0.0;
  for_each_within(samples, mean.begin, mean.end, [&](const Vec3& acceleration, double duration) {
    const Vec3 difference = acceleration - mean.acceleration;
    shift += duration * (velocity + 0.5 * duration * difference);
    velocity += duration * difference;
    largest = std::max(largest, shift.norm());
  });
  return largest;
}

}  // namespace

Phase next_part(const Phase& phase, double begin, const Vec3& gravity, std::span<const LoneBlock> blocks) {
  const std::span<const Phase> samples = phase.samples;
  const auto first = phase_after(samples, begin);
  for (auto count = samples.end() - first; count > 1; count = (count + 1) / 2) {
    const Phase part = mean_of(samples, begin, (first + count - 1)->end);
    const auto is_led = [&](const LoneBlock& block) { return follows(block, samples, part, gravity); };
    if (largest_shift(samples, part) <= kSampledShift && std::all_of(blocks.begin(), blocks.end(), is_led)) return part;
  }
  return {begin, first->end, first->acceleration};
}

}  // namespace holdfast::internal::native
