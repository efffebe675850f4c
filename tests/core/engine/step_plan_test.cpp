#include "core/engine/step_plan.hpp"

#include <catch2/catch.hpp>

namespace step_plan_test {

using holdfast::internal::Phase;
using holdfast::internal::StepPlan;

TEST_CASE("step_plan: equal steps, none longer than requested, end exactly with the phase", "[core][step_plan]") {
  const Phase phase{0.3, 1.0001, {}};
  const StepPlan plan(phase, 240.0);
  CHECK(plan.step_count() == 169);
  CHECK(plan.step() <= 1.0 / 240.0);
  CHECK(plan.end_of(plan.step_count() - 1) == phase.end);
}

TEST_CASE("step_plan: rounding adds no step to a whole number of steps", "[core][step_plan]") {
  CHECK(StepPlan({1.3, 13.3, {}}, 240.0).step_count() == 2880);
  CHECK(StepPlan({0.0, 0.1, {}}, 240.0).step_count() == 24);
  CHECK(StepPlan({0.0, 1e-5, {}}, 240.0).step_count() == 1);
}

TEST_CASE("step_plan: the next step follows from the time reached", "[core][step_plan]") {
  const StepPlan plan({13.3, 13.65, {}}, 240.0);
  CHECK(plan.steps_before(13.3) == 0);
  for (std::uint64_t i = 0; i < plan.step_count(); ++i) CHECK(plan.steps_before(plan.end_of(i)) == i + 1);
}

}  // namespace step_plan_test
