#include "analyses/replicas/replica_run.hpp"

#include <atomic>
#include <catch2/catch.hpp>

#include "analyses/replicas/replica_draw.hpp"
#include "core/model/play.hpp"
#include "scenes.hpp"

namespace replica_run_test {

using namespace holdfast::internal;
using namespace holdfast::internal::scenes;

namespace {

ReplicaOutcome replicas_of(const std::string& engine, const Layout& layout, const Acceleration& acceleration,
                           const Settings& settings) {
  const std::atomic<bool> abort = false;
  const auto simulator = engine_of(engine, settings);
  const WorldRecord nominal = run(*simulator, layout, acceleration, settings).record;
  const auto outcome = run_replicas(*simulator, layout, acceleration, nominal, settings, abort);
  REQUIRE(outcome.has_value());
  return *outcome;
}

Settings floor_with_replicas() {
  Settings settings = open_floor(0.5);
  settings.screening.replicas = 32;
  return settings;
}

Layout one_box() { return layout_of({box({9, 9, 0}, {1, 1, 0.2})}); }

}  // namespace

TEST_CASE("replica_run: those replicas fail whose friction does not hold the box", "[replica_run]") {
  const std::string engine = GENERATE("native", "native-plain", "bullet");
  Settings settings = floor_with_replicas();
  settings.contact.friction_model = GENERATE(FrictionModel::pairs, FrictionModel::product);
  settings.box_friction = settings.container.friction = std::sqrt(0.5);
  settings.steps_per_second = 120;
  const Layout layout = one_box();
  const double strength = 0.48 * kGravity;
  std::uint32_t sliding = 0;
  for (std::uint32_t number = 1; number <= 32; ++number) {
    const ReplicaDraw draw = draw_replica(layout, boxes_hash(layout), number, settings.screening);
    const bool pairs = settings.contact.friction_model == FrictionModel::pairs;
    const double friction = 0.5 * (pairs ? draw.box_floor : draw.materials.at(1) * draw.container);
    // An engine with steps is right about a box that is not just at the threshold.
    const double distance = 0.5 * (strength - friction * kGravity) * 2.0 * 2.0;
    REQUIRE((distance < 0.09 || distance > 0.11));
    if (distance > 0.1) ++sliding;
  }
  REQUIRE(sliding > 3);
  const ReplicaOutcome outcome = replicas_of(engine, layout, constant(strength, 2.0), settings);
  CAPTURE(engine);
  CHECK(outcome.count == 32);
  CHECK(outcome.failed == sliding);
  CHECK(outcome.share == sliding / 32.0);
  CHECK(outcome.verdict == ReplicaVerdict::uncertain);
  CHECK(outcome.simulated == 33);
  CHECK(outcome.box_share == std::vector<float>{static_cast<float>(sliding) / 32.0F});
}

TEST_CASE("replica_run: a load that rests with the least friction holds, and no other world is simulated",
          "[replica_run]") {
  const ReplicaOutcome outcome = replicas_of("native", one_box(), constant(0.3 * kGravity, 1.0), floor_with_replicas());
  CHECK(outcome.simulated == 1);
  CHECK(outcome.count == 32);
  CHECK(outcome.failed == 0);
  CHECK(outcome.verdict == ReplicaVerdict::holds);
  CHECK(outcome.box_share == std::vector<float>{0.0F});
}

TEST_CASE("replica_run: where the world itself moves, the one with the least friction is not asked", "[replica_run]") {
  const ReplicaOutcome outcome =
      replicas_of("native", one_box(), constant(0.505 * kGravity, 1.0), floor_with_replicas());
  CHECK(outcome.simulated == 32);
  CHECK(outcome.count == 32);
  CHECK(outcome.failed > 0);
  CHECK(outcome.verdict == ReplicaVerdict::uncertain);
}

TEST_CASE("replica_run: drawing ends with the first replicas whose failures can decide", "[replica_run]") {
  const ReplicaOutcome outcome = replicas_of("native", one_box(), constant(0.9 * kGravity, 2.0), floor_with_replicas());
  CHECK(outcome.simulated == kReplicaBlock);
  CHECK(outcome.count == kReplicaBlock);
  CHECK(outcome.failed == kReplicaBlock);
  CHECK(outcome.verdict == ReplicaVerdict::fails);
  CHECK(judge_share(wilson_interval(kReplicaBlock, kReplicaBlock, kEarlyScore)) == ReplicaVerdict::fails);
  CHECK(judge_share(wilson_interval(kReplicaBlock - 1, kReplicaBlock - 1, kEarlyScore)) == ReplicaVerdict::uncertain);
}

TEST_CASE("replica_run: with a spread of accelerations every replica that is needed is simulated", "[replica_run]") {
  Settings settings = floor_with_replicas();
  settings.screening.friction_spread = 0.0;
  settings.screening.acceleration_spread = 0.1;
  const Layout layout = one_box();
  std::uint32_t sliding = 0;
  for (std::uint32_t number = 1; number <= 32; ++number) {
    const double factor = draw_replica(layout, boxes_hash(layout), number, settings.screening).acceleration;
    if (0.5 * (0.48 * factor - 0.5) * kGravity * 4.0 > 0.1) ++sliding;
  }
  REQUIRE(sliding > 3);
  const ReplicaOutcome outcome = replicas_of("native", layout, constant(0.48 * kGravity, 2.0), settings);
  CHECK(outcome.failed == sliding);
  CHECK(outcome.simulated == 32);
}

TEST_CASE("replica_run: boxes are shifted within their play", "[replica_run]") {
  // A board stands out of a box, and falls when that box, or it, is shifted so far that its centre is beyond the edge.
  Settings settings = floor_with_replicas();
  settings.screening.friction_spread = 0.0;
  settings.screening.play_shift = 0.1;
  Layout layout = layout_of({box({9, 9, 0}, {1, 1, 1}), box({9.45, 9, 1}, {1, 1, 0.2})});
  const std::vector<BoxPlay> play = play_of(layout, settings, 0.1);
  std::uint32_t falling = 0;
  for (std::uint32_t number = 1; number <= 32; ++number) {
    const Layout shifted = shifted_layout(layout, play, boxes_hash(layout), number);
    const double beyond = shifted.boxes[1].corner_min.x() - shifted.boxes[0].corner_min.x() - 0.5;
    REQUIRE(std::abs(beyond) > 1e-4);
    if (beyond > 0.0) ++falling;
  }
  REQUIRE(falling > 3);
  const ReplicaOutcome outcome = replicas_of("native", layout, constant(0.0, 3.0), settings);
  CHECK(outcome.count == 32);
  CHECK(outcome.failed == falling);
  CHECK(outcome.simulated == 32);
}

TEST_CASE("replica_run: an abort leaves nothing", "[replica_run]") {
  const Settings settings = floor_with_replicas();
  const std::atomic<bool> abort = true;
  const WorldRecord nominal;
  CHECK_FALSE(run_replicas(*engine_of("native", settings), one_box(), constant(5.0, 1.0), nominal, settings, abort));
}

}  // namespace replica_run_test
