#include "core/native/island/solved_motion.hpp"

#include <catch2/catch.hpp>

#include "core/native/island/closing_contacts.hpp"
#include "core/native/island/slips.hpp"
#include "core/native/small_world.hpp"

// What has been solved of a step: how the bodies move, which contacts close, which slips end.

namespace solved_motion_test {

using namespace holdfast::internal;
using namespace holdfast::internal::native;
using namespace holdfast::internal::scenes;
using native_scenes::SmallWorld;

namespace {

constexpr double kStep = 0.004;  // s

/// A small world whose first island is solved for a step.
struct SolvedStep {
  SmallWorld world;
  IslandSolve solve{make_contact_solver()};
  SolvedMotion motion{solve.prepared};
  ClosingContacts closing{motion};
  ImpactTiming timing;
  StepTerms terms;
  IslandReport report;

  SolvedStep(const Settings& settings, Layout layout, const Vec3& acceleration, const Vec3& velocity)
      : world(settings, std::move(layout)) {
    world.act(acceleration, kStep);
    world.bodies().state.velocity[0] = velocity;
    world.state.find_contacts(std::vector<std::uint8_t>(world.bodies().count(), 1));
    world.state.find_islands();
    terms = world.state.rest.terms_for(world.state.terms, island());
    timing = impact_timing(world.bodies(), island(), terms, effort(), false, 0);
    closing.begin(world.state.scene);
    find_sliding(world.state.scene, island(), terms, effort());
    solve.prepared.prepare_step(world.state.scene, island(), terms, kStep, solve.solver(), timing.filter(kStep),
                                closing.predicted());
    solve.solve(limits_after_reset(effort()), terms, kStep, report);
    motion.find(world.bodies(), island(), terms, kStep);
  }

  IslandView island() const { return world.state.islands[0]; }
  const Effort& effort() const { return world.options.effort(1); }
};

}  // namespace

TEST_CASE("solved motion: the mean velocity of constant forces is the trapezoid, and a part is cut at a share",
          "[core][motion]") {
  const Vec3 velocity(1, 2, 3);
  SolvedStep step(open_floor(0.5), layout_of({box({5, 5, 3}, {1, 1, 1})}), {1, 0, 0}, velocity);
  const Vec3 g = step.terms.effective_gravity;
  CHECK(step.motion.at_end(step.world.bodies(), 0).linear.isApprox(velocity + kStep * g, 1e-12));
  CHECK(step.motion.mean(step.world.bodies(), 0).linear.isApprox(velocity + 0.5 * kStep * g, 1e-12));
  CHECK(step.motion.at_end(step.world.bodies(), -1).linear == Vec3::Zero());
  const Vec3 start = step.world.bodies().state.position[0];
  const double share = 0.25, time = share * kStep;
  step.solve.prepared.find_missing_velocities();
  step.motion.move(step.world.bodies(), step.island(), kStep, share);
  CHECK(step.world.bodies().state.position[0].isApprox(start + time * velocity + 0.5 * time * time * g, 1e-12));
  CHECK(step.world.bodies().state.velocity[0].isApprox(velocity + time * g, 1e-12));
  CHECK(step.world.bodies().last_step[0].acceleration.isApprox(g, 1e-9));
}

TEST_CASE("closing contacts: the first fast impact is found when it is", "[core][impacts]") {
  const double height = 0.002, speed = 1.0;
  SolvedStep step(open_floor(0.5), layout_of({box({5, 5, height}, {1, 1, 0.5})}), Vec3::Zero(), {0, 0, -speed});
  const auto event =
      step.closing.find(step.world.state.scene, step.island(), step.terms, step.effort(), step.timing, kStep);
  const double g = step.world.settings.gravity;
  CHECK_FALSE(event.activated);
  CHECK(event.time == Approx((std::sqrt(speed * speed + 2.0 * g * height) - speed) / g).epsilon(1e-6));
}

TEST_CASE("closing contacts: where impacts are not located, what closes is solved with the step", "[core][impacts]") {
  SolvedStep step(open_floor(0.5), layout_of({box({5, 5, 0.002}, {1, 1, 0.5})}), Vec3::Zero(), {0, 0, -1});
  step.timing.locates = false;
  const auto event =
      step.closing.find(step.world.state.scene, step.island(), step.terms, step.effort(), step.timing, kStep);
  CHECK(event.activated);
  CHECK(step.world.on_floor(0)->active);
  const auto& predicted = step.closing.predicted();
  CHECK(std::any_of(predicted.begin(), predicted.end(), [](std::uint8_t points) { return points != 0; }));
}

TEST_CASE("slips: a block that slides comes to rest after v / (mu g)", "[core][slips]") {
  const double friction = 0.5, speed = 0.01;
  SolvedStep step(open_floor(friction), layout_of({box({5, 5, 0}, {1, 1, 0.1})}), Vec3::Zero(), {speed, 0, 0});
  const Slips slips(step.solve.prepared, step.motion);
  const double stop = speed / (friction * step.world.settings.gravity);
  REQUIRE(stop < kStep);
  step.terms.reset_warm_start = true;
  for (const double residual : {0.0, 1e-6})
    CHECK(slips.first_change(step.world.state.scene, step.terms, residual, true, false, kStep) ==
          Approx(stop).epsilon(1e-6));
}

TEST_CASE("slips: one that ends where it is pushed aside is followed as it turns", "[core][slips]") {
  const double friction = 0.5, speed = 0.01;
  const Vec3 across(0, 0.3 * Settings().gravity, 0);
  SolvedStep step(open_floor(friction), layout_of({box({5, 5, 0}, {1, 1, 0.1})}), across, {speed, 0, 0});
  const Slips slips(step.solve.prepared, step.motion);
  step.terms.reset_warm_start = step.terms.to_and_fro = step.terms.changes_on = true;
  const double stop = speed / (friction * step.world.settings.gravity);
  const auto change = [&](bool turns) {
    return slips.first_change(step.world.state.scene, step.terms, 1e-6, true, turns, kStep);
  };
  CHECK(change(false) == Approx(stop).epsilon(1e-6));
  CHECK(change(true) < stop);
  CHECK(step.terms.lasting_slip(change(true)) < speed);
}

TEST_CASE("slips: one that keeps its direction goes on through the step", "[core][slips]") {
  SolvedStep step(open_floor(0.5), layout_of({box({5, 5, 0}, {1, 1, 0.1})}), Vec3::Zero(), {1, 0, 0});
  const Slips slips(step.solve.prepared, step.motion);
  CHECK(slips.first_change(step.world.state.scene, step.terms, 0.0, true, true, kStep) == kStep);
}

TEST_CASE("slips: friction is kinetic where surfaces slide, and where they begin to", "[core][slips]") {
  Settings settings = open_floor(0.5);
  settings.contact.kinetic_friction = 0.8;
  SECTION("they slide") {
    SolvedStep step(settings, layout_of({box({5, 5, 0}, {1, 1, 0.1})}), Vec3::Zero(), {1, 0, 0});
    CHECK(step.world.on_floor(0)->slides);
    CHECK(step.motion.at_end(step.world.bodies(), 0).linear.x() ==
          Approx(1.0 - 0.8 * 0.5 * settings.gravity * kStep).epsilon(1e-5));
    step.solve.prepared.store_step_impulses(step.world.state.scene, step.island(), kStep);
    const Slips slips(step.solve.prepared, step.motion);
    slips.find_ended(step.world.state.scene, step.island(), step.terms, 0.0);
    CHECK(step.world.on_floor(0)->slides);
  }
  SECTION("they stick, and give way in the step") {
    SolvedStep step(settings, layout_of({box({5, 5, 0}, {1, 1, 0.1})}), {8, 0, 0}, Vec3::Zero());
    CHECK_FALSE(step.world.on_floor(0)->slides);
    const Slips slips(step.solve.prepared, step.motion);
    CHECK(slips.find_begun(step.world.state.scene, step.terms, step.effort(), 0.0));
    CHECK(step.world.on_floor(0)->slides);
  }
  SECTION("they stick, and hold") {
    SolvedStep step(settings, layout_of({box({5, 5, 0}, {1, 1, 0.1})}), {3, 0, 0}, Vec3::Zero());
    const Slips slips(step.solve.prepared, step.motion);
    CHECK_FALSE(slips.find_begun(step.world.state.scene, step.terms, step.effort(), 0.0));
  }
}

}  // namespace solved_motion_test
