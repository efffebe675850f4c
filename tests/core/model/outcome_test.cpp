#include "core/model/outcome.hpp"

#include <catch2/catch.hpp>

namespace outcome_test {

using namespace holdfast::internal;

TEST_CASE("outcome: names of the bits, joined", "[core][outcome]") {
  CHECK(to_string(Status::ok) == "ok");
  CHECK(to_string(Status::bad_layout) == "bad_layout");
  CHECK(to_string(Status::bad_acceleration) == "bad_acceleration");
  CHECK(to_string(Status::non_finite | Status::not_converged) == "non_finite+not_converged");
  CHECK(to_string(Status::capacity | Status::bad_layout) == "bad_layout+capacity");
  CHECK(to_string(Status::too_large) == "too_large");
  CHECK(to_string(Status::not_needed) == "not_needed");
}

TEST_CASE("outcome: bits are independent", "[core][outcome]") {
  const Status both = Status::non_finite | Status::capacity;
  CHECK(has(both, Status::non_finite));
  CHECK(has(both, Status::capacity));
  CHECK_FALSE(has(both, Status::not_converged));
  CHECK_FALSE(has(Status::ok, Status::bad_layout));
}

TEST_CASE("outcome: names of the reasons to stop", "[core][outcome]") {
  CHECK(to_string(StopReason::not_run) == "not_run");
  CHECK(to_string(StopReason::timeout) == "timeout");
  CHECK(to_string(StopReason::sleeping) == "sleeping");
  CHECK(to_string(StopReason::failed) == "failed");
  CHECK(to_string(StopReason::decided) == "decided");
  CHECK(to_string(static_cast<StopReason>(255)) == "unknown");
}

}  // namespace outcome_test
