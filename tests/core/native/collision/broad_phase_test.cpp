#include "core/native/collision/broad_phase.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "random.hpp"

template <>
struct Catch::StringMaker<holdfast::internal::native::IndexPair> {
  static std::string convert(const holdfast::internal::native::IndexPair& pair) {
    return std::to_string(pair.i) + "-" + std::to_string(pair.j);
  }
};

namespace broad_phase_test {

using holdfast::internal::Random;
using holdfast::internal::Vec3;
using holdfast::internal::native::BroadPhase;
using holdfast::internal::native::IndexPair;

namespace {

/// Bounds of a number of boxes.
struct Bounds {
  std::vector<Vec3> lower;
  std::vector<Vec3> upper;
  std::vector<std::uint8_t> awake;

  void add(const Vec3& low, const Vec3& high, bool is_awake = true) {
    lower.push_back(low);
    upper.push_back(high);
    awake.push_back(is_awake ? 1 : 0);
  }
};

std::vector<IndexPair> found(BroadPhase& phase, const Bounds& bounds) {
  const auto pairs = phase.find_pairs(bounds.lower, bounds.upper, bounds.awake);
  return {pairs.begin(), pairs.end()};
}

std::vector<IndexPair> brute_force(const Bounds& bounds) {
  std::vector<IndexPair> pairs;
  for (std::uint32_t i = 0; i < bounds.lower.size(); ++i) {
    for (std::uint32_t j = i + 1; j < bounds.lower.size(); ++j) {
      const bool overlap = (bounds.lower[i].array() <= bounds.upper[j].array()).all() &&
                           (bounds.lower[j].array() <= bounds.upper[i].array()).all();
      if (overlap && (bounds.awake[i] != 0 || bounds.awake[j] != 0)) pairs.push_back({i, j});
    }
  }
  return pairs;
}

/// Boxes in a room, on a grid of 0.1 m so that many only just touch.
Bounds scattered(Random& random, std::size_t count, const Vec3& room, double awake) {
  Bounds bounds;
  for (std::size_t n = 0; n < count; ++n) {
    Vec3 low;
    Vec3 high;
    for (int k = 0; k < 3; ++k) {
      low[k] = 0.1 * random.below(static_cast<std::uint32_t>(10.0 * room[k]));
      high[k] = low[k] + 0.1 * (1.0 + random.below(6));
    }
    bounds.add(low, high, random.between(0, 1) < awake);
  }
  return bounds;
}

}  // namespace

TEST_CASE("broad_phase: boxes that touch are a pair, boxes apart are none", "[core][broad_phase]") {
  Bounds bounds;
  bounds.add({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0});
  bounds.add({1.0, 0.0, 0.0}, {2.0, 1.0, 1.0});
  bounds.add({2.0, 1.0, 1.0}, {3.0, 2.0, 2.0});
  bounds.add({0.0, 0.0, 1.001}, {1.0, 0.5, 2.0});
  BroadPhase phase;
  CHECK(found(phase, bounds) == std::vector<IndexPair>{{0, 1}, {1, 2}});
}

TEST_CASE("broad_phase: of a pair at least one box is awake", "[core][broad_phase]") {
  Bounds bounds;
  bounds.add({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}, false);
  bounds.add({1.0, 0.0, 0.0}, {2.0, 1.0, 1.0}, false);
  bounds.add({2.0, 0.0, 0.0}, {3.0, 1.0, 1.0}, true);
  BroadPhase phase;
  CHECK(found(phase, bounds) == std::vector<IndexPair>{{1, 2}});
  bounds.awake[2] = 0;
  CHECK(found(phase, bounds).empty());
}

TEST_CASE("broad_phase: no boxes and one box have no pairs", "[core][broad_phase]") {
  BroadPhase phase;
  Bounds bounds;
  CHECK(found(phase, bounds).empty());
  bounds.add({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0});
  CHECK(found(phase, bounds).empty());
}

TEST_CASE("broad_phase: finds what comparing all with all finds, in its order", "[core][broad_phase]") {
  Random random(17);
  BroadPhase phase;
  std::size_t pairs = 0;
  for (int round = 0; round < 200; ++round) {
    // Long in each direction in turn; sizes change between calls as between worlds.
    Vec3 room(2.0, 2.0, 2.0);
    room[round % 3] = 12.0;
    const Bounds bounds = scattered(random, random.below(150), room, random.between(0, 1));
    const std::vector<IndexPair> expected = brute_force(bounds);
    const std::vector<IndexPair> got = found(phase, bounds);
    CAPTURE(round, bounds.lower.size(), expected.size(), got.size());
    CHECK(got == expected);
    pairs += expected.size();
  }
  CAPTURE(pairs);
  CHECK(pairs > 3000);
}

TEST_CASE("broad_phase: follows boxes that move from step to step", "[core][broad_phase]") {
  Random random(17);
  BroadPhase phase;
  Bounds bounds = scattered(random, 120, {6.0, 2.4, 2.4}, 0.7);
  for (int step = 0; step < 200; ++step) {
    for (std::size_t i = 0; i < bounds.lower.size(); ++i) {
      // The boxes are drawn out along y, until that is the longest way.
      Vec3 shift = random.vector(-0.1, 0.1);
      shift.y() += 0.001 * static_cast<double>(i);
      bounds.lower[i] += shift;
      bounds.upper[i] += shift;
      bounds.awake[i] = random.below(10) < 7 ? 1 : 0;
    }
    const std::vector<IndexPair> expected = brute_force(bounds);
    const std::vector<IndexPair> got = found(phase, bounds);
    BroadPhase fresh;
    CAPTURE(step, expected.size(), got.size());
    CHECK(got == expected);
    CHECK(found(fresh, bounds) == expected);
  }
}

TEST_CASE("broad_phase: bounds that are not numbers overlap none and hide none", "[core][broad_phase]") {
  Random random(17);
  Bounds bounds = scattered(random, 80, {3.0, 2.0, 2.0}, 1.0);
  const double nan = std::nan("");
  const double infinity = std::numeric_limits<double>::infinity();
  bounds.lower[3].x() = bounds.upper[3].x() = nan;
  bounds.lower[40] = bounds.upper[40] = Vec3::Constant(nan);
  bounds.upper[55].z() = nan;
  bounds.lower[70] = Vec3::Constant(-infinity);
  bounds.upper[70] = Vec3::Constant(infinity);
  BroadPhase phase;
  const std::vector<IndexPair> expected = brute_force(bounds);
  CAPTURE(expected.size());
  CHECK(found(phase, bounds) == expected);
  CHECK(found(phase, bounds) == expected);
}

}  // namespace broad_phase_test
