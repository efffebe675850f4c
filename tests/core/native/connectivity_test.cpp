#include "core/native/connectivity.hpp"

#include <catch2/catch.hpp>
#include <limits>
#include <set>

#include "random.hpp"

namespace connectivity_test {

using namespace holdfast::internal;
using namespace holdfast::internal::native;

namespace {

Bodies bodies_with(const std::vector<std::uint8_t>& fixed) {
  Bodies bodies;
  bodies.mass.assign(fixed.size(), 1.0);
  for (const std::uint8_t is_fixed : fixed)
    bodies.activity.push_back(is_fixed != 0 ? Activity::fixed : Activity::moving);
  return bodies;
}

Manifold pair(std::int32_t a, std::int32_t b, bool active = true) {
  Manifold manifold;
  manifold.a = a;
  manifold.b = b;
  manifold.active = active;
  return manifold;
}

std::vector<std::uint32_t> list(std::span<const std::uint32_t> from) { return {from.begin(), from.end()}; }

using Indices = std::vector<std::uint32_t>;

}  // namespace

TEST_CASE("connectivity: active contacts join bodies, others do not", "[core][connectivity]") {
  Connectivity islands;
  islands.find(bodies_with({0, 0, 0, 0, 0}), {pair(3, 4), pair(1, 3), pair(0, 2, false), pair(-1, 2)});
  REQUIRE(islands.size() == 3);
  CHECK(list(islands[0].bodies) == Indices{0});
  CHECK(list(islands[1].bodies) == Indices{1, 3, 4});
  CHECK(list(islands[1].manifolds) == Indices{0, 1});
  CHECK(list(islands[2].bodies) == Indices{2});
  // A contact of two islands belongs to none, one with a side to its body's.
  CHECK(list(islands[0].manifolds).empty());
  CHECK(list(islands[2].manifolds) == Indices{3});
}

TEST_CASE("connectivity: what sleeps joins nothing and belongs to no island", "[core][connectivity]") {
  Connectivity islands;
  Bodies bodies = bodies_with({0, 0, 0});
  bodies.activity[1] = Activity::asleep;
  islands.find(bodies, {pair(0, 1), pair(1, 2)});
  REQUIRE(islands.size() == 2);
  CHECK(list(islands[0].bodies) == Indices{0});
  CHECK(list(islands[0].manifolds) == Indices{0});
  CHECK(list(islands[1].bodies) == Indices{2});
  CHECK(list(islands[1].manifolds) == Indices{1});
}

TEST_CASE("connectivity: what is fixed joins nothing and belongs to no island", "[core][connectivity]") {
  Connectivity islands;
  islands.find(bodies_with({0, 1, 0}), {pair(0, 1), pair(1, 2), pair(-1, 0), pair(-1, 2), pair(-1, 1)});
  REQUIRE(islands.size() == 2);
  CHECK(islands.of(1) == Connectivity::kNone);
  CHECK(list(islands[0].manifolds) == Indices{0, 2});
  CHECK(list(islands[1].manifolds) == Indices{1, 3});
}

TEST_CASE("connectivity: no bodies are no islands", "[core][connectivity]") {
  Connectivity islands;
  islands.find(bodies_with({}), {});
  CHECK(islands.size() == 0);
}

// The independent reference: labels that spread along active contacts until nothing changes.
TEST_CASE("connectivity: random worlds fall into the islands that spreading labels find", "[core][connectivity]") {
  Random random(17);
  Connectivity islands;  // One object for all worlds: nothing is left over from the one before.
  for (int world = 0; world < 200; ++world) {
    const std::uint32_t count = 1 + random.below(30);
    std::vector<std::uint8_t> fixed(count);
    for (std::uint8_t& f : fixed) f = random.below(6) == 0 ? 1 : 0;
    std::vector<Manifold> manifolds;
    const std::uint32_t contacts = random.below(40);
    for (std::uint32_t m = 0; m < contacts; ++m) {
      const auto a = static_cast<std::int32_t>(random.below(count + 2)) - 2;
      const auto b = static_cast<std::int32_t>(random.below(count));
      if (a < b) manifolds.push_back(pair(a, b, random.below(2) == 0));
    }
    islands.find(bodies_with(fixed), manifolds);
    const auto is_free = [&](std::int32_t i) { return i >= 0 && fixed[static_cast<std::size_t>(i)] == 0; };
    std::vector<std::uint32_t> label(count);
    for (std::uint32_t i = 0; i < count; ++i) label[i] = i;
    for (bool changed = true; changed;) {
      changed = false;
      for (const Manifold& manifold : manifolds) {
        if (!manifold.active || !is_free(manifold.a) || !is_free(manifold.b)) continue;
        std::uint32_t& a = label[static_cast<std::size_t>(manifold.a)];
        std::uint32_t& b = label[static_cast<std::size_t>(manifold.b)];
        changed = changed || a != b;
        a = b = std::min(a, b);
      }
    }
    std::multiset<std::uint32_t> seen, seen_manifolds;
    for (std::size_t i = 0; i < islands.size(); ++i) {
      const IslandView view = islands[i];
      REQUIRE_FALSE(view.bodies.empty());
      for (const std::uint32_t body : view.bodies) {
        seen.insert(body);
        REQUIRE(islands.of(body) == i);
        REQUIRE(label[body] == view.bodies.front());
      }
      for (const std::uint32_t m : view.manifolds) {
        seen_manifolds.insert(m);
        for (const std::int32_t end : {manifolds[m].a, manifolds[m].b})
          REQUIRE((!is_free(end) || islands.of(static_cast<std::size_t>(end)) == i));
      }
    }
    for (std::uint32_t i = 0; i < count; ++i) REQUIRE(seen.count(i) == (fixed[i] != 0 ? 0U : 1U));
    for (std::uint32_t m = 0; m < manifolds.size(); ++m)
      if (manifolds[m].active && (is_free(manifolds[m].a) || is_free(manifolds[m].b)))
        REQUIRE(seen_manifolds.count(m) == 1);
  }
}

}  // namespace connectivity_test
