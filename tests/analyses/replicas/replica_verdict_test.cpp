#include "analyses/replicas/replica_verdict.hpp"

#include "core/model/settings.hpp"

#include <catch2/catch.hpp>

namespace replica_verdict_test {

using namespace holdfast::internal;

TEST_CASE("replica_verdict: Wilson's interval is that of the literature", "[replica_verdict]") {
  // Newcombe 1998, Statistics in Medicine 17, table I, method 3.
  const auto [failed, count, low, high] = GENERATE(
      std::tuple(81U, 263U, 0.2553, 0.3662), std::tuple(15U, 148U, 0.0624, 0.1605), std::tuple(0U, 20U, 0.0, 0.1611),
      std::tuple(1U, 29U, 0.0061, 0.1718), std::tuple(20U, 20U, 1.0 - 0.1611, 1.0));
  const ShareInterval interval = wilson_interval(failed, count, kToldScore);
  CAPTURE(failed, count);
  CHECK(interval.low == Approx(low).margin(5e-5));
  CHECK(interval.high == Approx(high).margin(5e-5));
}

TEST_CASE("replica_verdict: nothing is known without replicas", "[replica_verdict]") {
  const ShareInterval interval = wilson_interval(0, 0, kToldScore);
  CHECK(interval.low == 0.0);
  CHECK(interval.high == 1.0);
  CHECK(judge_share(interval) == ReplicaVerdict::uncertain);
}

TEST_CASE("replica_verdict: the fewest replicas can tell that a world holds, and fewer cannot", "[replica_verdict]") {
  const auto verdict_of = [](std::uint32_t count) { return judge_share(wilson_interval(0, count, kToldScore)); };
  CHECK(verdict_of(kFewestReplicas) == ReplicaVerdict::holds);
  CHECK(verdict_of(kFewestReplicas - 1) == ReplicaVerdict::uncertain);
}

TEST_CASE("replica_verdict: of 32 replicas none may fail in a world that holds, and 22 in one that fails",
          "[replica_verdict]") {
  const auto verdict_of = [](std::uint32_t failed) { return judge_share(wilson_interval(failed, 32, kToldScore)); };
  CHECK(verdict_of(0) == ReplicaVerdict::holds);
  CHECK(verdict_of(1) == ReplicaVerdict::uncertain);
  CHECK(verdict_of(21) == ReplicaVerdict::uncertain);
  CHECK(verdict_of(22) == ReplicaVerdict::fails);
}

}  // namespace replica_verdict_test
