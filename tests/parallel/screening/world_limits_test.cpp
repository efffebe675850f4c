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
        "a.txt: would take a world too many steps: 1.2e+09; at most 1e+09: fewer steps per second, or a "
        "shorter time");
  settings.timeout = 1.0;
  CHECK(most_steps(acceleration, settings, 100.0) == Approx(300.0));
}

}  // namespace world_limits_test
