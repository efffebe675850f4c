#include "core/native/collision/pair_table.hpp"

#include <catch2/catch.hpp>
#include <map>
#include <utility>

#include "random.hpp"

namespace pair_table_test {

using namespace holdfast::internal;
using namespace holdfast::internal::native;

TEST_CASE("pair_table: an empty table knows no pair", "[core][pair_table]") {
  const PairTable table;
  CHECK(table.find(0, 1) == PairTable::kNone);
  CHECK(table.size() == 0);
}

TEST_CASE("pair_table: a pair is ordered, and a side of the container is a member like others", "[core][pair_table]") {
  PairTable table;
  table.set(-1, 0, 4);
  table.set(0, 1, 5);
  CHECK(table.find(-1, 0) == 4);
  CHECK(table.find(0, 1) == 5);
  CHECK(table.find(1, 0) == PairTable::kNone);
  table.set(0, 1, 6);
  CHECK(table.find(0, 1) == 6);
  CHECK(table.size() == 2);
}

TEST_CASE("pair_table: whatever is set and erased, it holds what a sorted map holds", "[core][pair_table]") {
  Random random(3);
  PairTable table;
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> expected;
  for (int step = 0; step < 20000; ++step) {
    // Few bodies, so that pairs come back; rounds of growing and of shrinking.
    const std::pair pair(static_cast<std::int32_t>(random.below(40)) - 6, static_cast<std::int32_t>(random.below(40)));
    const bool shrinking = step / 2000 % 2 == 1;
    if (random.below(4) < (shrinking ? 3U : 1U)) {
      if (expected.erase(pair) > 0) table.erase(pair.first, pair.second);
    } else {
      table.set(pair.first, pair.second, step);
      expected[pair] = step;
    }
    const std::pair other(static_cast<std::int32_t>(random.below(40)) - 6, static_cast<std::int32_t>(random.below(40)));
    const auto found = expected.find(other);
    REQUIRE(table.find(other.first, other.second) == (found == expected.end() ? PairTable::kNone : found->second));
    REQUIRE(table.size() == expected.size());
  }
  for (const auto& [pair, index] : expected) CHECK(table.find(pair.first, pair.second) == index);
}

}  // namespace pair_table_test
