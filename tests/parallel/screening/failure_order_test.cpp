#include "parallel/screening/failure_order.hpp"

#include <catch2/catch.hpp>

namespace failure_order_test {

using namespace holdfast::internal;

namespace {

/// A world whose only box is displaced by so much, m.
WorldRecord world_of(std::size_t acceleration, float displacement, Status status = Status::ok) {
  WorldRecord world;
  world.row.acceleration = acceleration;
  world.row.status = status;
  world.row.stop_reason = StopReason::timeout;
  visit_ends<EndTable>([&](const OutcomeField&, auto member) { (world.end.*member).resize(1); });
  world.end.peak_displacement = {displacement};
  return world;
}

std::vector<std::size_t> order_of(const FailureOrder& failures) {
  return {failures.order().begin(), failures.order().end()};
}

using Order = std::vector<std::size_t>;

}  // namespace

TEST_CASE("failure_order: the order holds for a block, and is drawn up from those before it",
          "[parallel][failure_order]") {
  FailureOrder failures(3, {});
  failures.enter(0);
  CHECK(order_of(failures) == Order{0, 1, 2});
  CHECK(failures.block_end() == 8);
  failures.count(world_of(2, 0.2F), {});
  failures.enter(7);
  CHECK(order_of(failures) == Order{0, 1, 2});
  failures.enter(8);
  CHECK(order_of(failures) == Order{2, 0, 1});
  CHECK(failures.block_end() == 16);
  for (int i = 0; i < 2; ++i) failures.count(world_of(1, 0.2F), {});
  failures.enter(16);
  CHECK(order_of(failures) == Order{1, 2, 0});
}

TEST_CASE("failure_order: another run begins with the failures that were counted", "[parallel][failure_order]") {
  FailureOrder failures(3, {});
  failures.enter(0);
  failures.count_rejection(2);
  FailureOrder next = failures.for_next_run();
  next.enter(0);
  CHECK(order_of(next) == Order{2, 0, 1});
  CHECK(next.block_end() == 8);
}

TEST_CASE("failure_order: blocks double, up to 256 layouts", "[parallel][failure_order]") {
  FailureOrder failures(1, {});
  std::vector<std::size_t> ends;
  for (std::size_t layout = 0; layout < 1100; ++layout) {
    failures.enter(layout);
    if (ends.empty() || ends.back() != failures.block_end()) ends.push_back(failures.block_end());
  }
  CHECK(ends == Order{8, 16, 32, 64, 128, 256, 512, 768, 1024, 1280});
}

TEST_CASE("failure_order: layouts that the engine takes together have one order", "[parallel][failure_order]") {
  EngineTraits traits;
  traits.layouts_per_unit = 10;
  FailureOrder failures(2, traits);
  failures.enter(0);
  failures.count(world_of(1, 0.2F), {});
  failures.enter(9);
  CHECK(order_of(failures) == Order{0, 1});
  failures.enter(10);
  CHECK(order_of(failures) == Order{1, 0});
}

TEST_CASE("failure_order: only what neither stayed nor failed rejects a layout", "[parallel][failure_order]") {
  CHECK(rejects(world_of(0, 0.2F), {}));
  CHECK_FALSE(rejects(world_of(0, 0.05F), {}));
  CHECK_FALSE(rejects(world_of(0, 0.05F, Status::not_converged), {}));
  CHECK(rejects(world_of(0, 0.2F, Status::not_converged), {}));  // the limit came first
  WorldRecord spared;
  spared.row.status = Status::not_needed;
  CHECK_FALSE(rejects(spared, {}));
  WorldRecord unstable = world_of(0, 0.0F);
  unstable.end.settling_peak_displacement = {0.2F};
  CHECK(rejects(unstable, {}));
}

}  // namespace failure_order_test
