#include "core/native/sampled_step.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/model/samples.hpp"

namespace sampled_step_test {

using namespace holdfast::internal;
using native::LoneBlock;
using native::next_part;

namespace {

const Vec3 kGravity(0, 0, -10);
const LoneBlock kSticking{0.5, 0.5, Vec3::Zero()};
const LoneBlock kFree;

/// A phase of samples of a millisecond with these accelerations along x, m/s².
Phase sampled(const std::vector<double>& accelerations) {
  std::vector<Phase> samples;
  for (const double acceleration : accelerations) {
    const double begin = 1e-3 * static_cast<double>(samples.size());
    samples.push_back({begin, begin + 1e-3, Vec3(acceleration, 0, 0)});
  }
  return grouped(samples, 1.0).front();
}

/// How many of the phase's samples the next step takes.
std::size_t taken(const Phase& phase, double begin, const std::vector<LoneBlock>& blocks) {
  const Phase part = next_part(phase, begin, kGravity, blocks);
  CHECK(part.begin == begin);
  return static_cast<std::size_t>(std::lround((part.end - part.begin) / 1e-3));
}

}  // namespace

TEST_CASE("sampled_step: what friction holds under every sample is held in one step", "[core][sampled_step]") {
  const Phase phase = sampled({4.9, -4.9, 4.5, 3, -1, 4.9, -4.9, 2});
  CHECK(taken(phase, 0.0, {kSticking}) == 8);
  const Phase part = next_part(phase, 0.0, kGravity, std::vector{kSticking});
  CHECK(part.end == phase.end);
  CHECK(part.acceleration.x() == Approx(phase.acceleration.x()));
}

TEST_CASE("sampled_step: a sample that friction cannot hold is not lost in the mean", "[core][sampled_step]") {
  const Phase phase = sampled({4, 4, 4, 4, 6, 4, 4, 4});
  // Steps end where the slip begins, and follow it until it has ended: 1 mm/s slows down by 1 m/s², for a millisecond.
  CHECK(taken(phase, 0.000, {kSticking}) == 4);
  CHECK(taken(phase, 0.004, {kSticking}) == 1);
  CHECK(taken(phase, 0.005, {{0.5, 0.5, Vec3(-1e-3, 0, 0)}}) == 3);
  // A block with more friction does not slip; one that slips less is followed all the same.
  CHECK(taken(phase, 0.0, {{0.61, 0.61, Vec3::Zero()}}) == 8);
  CHECK(taken(phase, 0.0, {{0.5999, 0.5999, Vec3::Zero()}}) == 4);
  CHECK(taken(phase, 0.0, {{0.61, 0.61, Vec3::Zero()}, kSticking}) == 4);
}

TEST_CASE("sampled_step: kinetic friction that is lower than static friction lets a slip go on",
          "[core][sampled_step]") {
  const Phase phase = sampled({4.5, 4.5, 5.2, 4.5, 4.5, 4.5, 4.5, 4.5});
  CHECK(taken(phase, 0.0, {{0.5, 0.4, Vec3::Zero()}}) == 2);
  CHECK(taken(phase, 0.0, {{0.53, 0.4, Vec3::Zero()}}) == 8);
}

TEST_CASE("sampled_step: a slide that does not end within the phase takes the mean", "[core][sampled_step]") {
  const Phase phase = sampled({9, 3, 9, 3, 9, 3, 9, 3});
  CHECK(taken(phase, 0.0, {{0.5, 0.5, Vec3(-2, 0, 0)}}) == 8);
  // The same from rest: it slides under one sample in two.
  CHECK(taken(phase, 0.0, {kSticking}) < 8);
}

TEST_CASE("sampled_step: what moves freely goes where the samples lead it", "[core][sampled_step]") {
  // The blow alone moves the container by 0.15 mm within its sample, and then by 0.3 mm in each.
  const Phase phase = sampled({0, 0, 0, 0, 300, -300, 0, 0});
  for (const std::vector<LoneBlock>& blocks : {std::vector<LoneBlock>(), {kFree}}) {
    CHECK(taken(phase, 0.0, blocks) == 4);
    CHECK(taken(phase, 0.004, blocks) == 1);
    CHECK(taken(phase, 0.005, blocks) == 1);
    CHECK(taken(phase, 0.006, blocks) == 2);
  }
}

TEST_CASE("sampled_step: a short push is not lost on what rocks", "[core][sampled_step]") {
  // Friction holds all samples. They take what nothing holds 42 µm far, and their mean 24 µm.
  const Phase phase = sampled({3, 3, 0, 0, 0, 0, 0, 0});
  CHECK(taken(phase, 0.0, {kSticking}) == 8);
  CHECK(taken(phase, 0.0, {kSticking, kFree}) == 2);
  // A push that hardly changes is followed by its mean.
  CHECK(taken(sampled({3, 3.01, 3.02, 3.03, 3.04, 3.05, 3.06, 3.07}), 0.0, {kSticking, kFree}) == 8);
}

}  // namespace sampled_step_test
