#include "parallel/screening/world_limits.hpp"

#include "scenes.hpp"

namespace world_limits_test {

using namespace holdfast::internal;
using namespace holdfast::internal::scenes;

TEST_CASE("world_limits: steps count settling and run-out, and too many are refused", "[parallel][world_limits]") {
  Settings settings;
  settings.screening.settle_seconds = 2.0;
  settings.screening.run_out_seconds = 5.0;
  const Acceleration acceleration = constant(1.0, 3.0);
  CHECK(most_steps(acceleration, settings, 100.0) == Approx(1000.0));
  CHECK_FALSE(check_steps("a.txt", acceleration, settings, 1e8));
  const std::optional<Error> error = check_steps("a.txt", acceleration, settings, 1.2e8);
  REQUIRE(error);
  CHECK(error->message() ==
        "a.txt: would take a world too many steps: 1200000000; at most 1000000000: fewer steps per second, or a "
        "shorter time");
  settings.timeout = 1.0;
  CHECK(most_steps(acceleration, settings, 100.0) == Approx(300.0));
}

TEST_CASE("world_limits: a message tells one step too many from the limit, and rounding is no step",
          "[parallel][world_limits]") {
  Settings settings;
  settings.screening.settle_seconds = 0.1;
  settings.screening.run_out_seconds = 0.0;
  const Acceleration acceleration = constant(1.0, 0.2);
  CHECK_FALSE(check_steps("a.txt", acceleration, settings, 1e9 / 0.3));  // 0.1 + 0.2 is more than 0.3
  const std::optional<Error> error = check_steps("a.txt", acceleration, settings, (1e9 + 0.5) / 0.3);
  REQUIRE(error);
  CHECK(error->value == "1000000001");
  const std::optional<Error> absurd = check_steps("a.txt", acceleration, settings, 1e200);
  REQUIRE(absurd);
  CHECK(absurd->value == "3e+199");
}

}  // namespace world_limits_test
