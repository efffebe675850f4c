// The bits of fixed scenes, which must be the same on every machine, with every compiler, at every optimisation.

#include <fmt/format.h>

#include <cstdint>
#include <string>

#include "core/native/native_engine.hpp"
#include "core/native/solver/each_instruction_set.hpp"
#include "physics/measures.hpp"

namespace native_golden_test {

using namespace holdfast::internal;
using namespace holdfast::internal::scenes;
using namespace holdfast::internal::physics;

namespace {

/// A whole load, far over its limit.
Run brake() {
  Settings settings = at_once();
  settings.native.accuracy = Accuracy::screening;
  const Layout layout = bundled_layout("BR5_020_layer_h60", settings);
  const Acceleration acceleration = acceleration_of({{0.4, Vec3(1.2 * kGravity, 0, 0)}, {0.1, Vec3::Zero()}});
  return run(NativeEngine(settings), layout, acceleration, settings);
}

/// Slides, leans, and comes back; one of the boxes has an offset centre of mass.
Run lean() {
  Settings settings = at_once();
  settings.materials[2].centre_of_mass = {0.05, 0.1, 0.03};
  Layout layout = stack(6, {2, 1, 0}, {0.6, 0.5, 0.3});
  layout.boxes[3].material = 2;
  return run(NativeEngine(settings), layout, acceleration_of({{0.3, Vec3(4, 6, 0)}, {0.3, Vec3(-3, 0, 1)}}), settings);
}

/// Boxes that spin, fall onto each other and rebound.
Run tumble() {
  Random random(5);
  Settings settings = small_container(Accuracy::standard);
  settings.contact.restitution = 0.3;
  const Layout layout = random_layout(random);
  const Acceleration acceleration = random_acceleration(random, 0.2);
  return run(NativeEngine(settings), layout, acceleration, settings, [&](StateColumns& state) {
    for (Vec3& spin : state.angular_velocity) spin = random.vector(-2, 2);
  });
}

/// Boxes that fall onto each other, solved as well as can be.
Run drop() {
  Random random(7);
  Settings settings = small_container(Accuracy::reference);
  settings.steps_per_second = 240;
  const Layout layout = random_layout(random);
  return run(NativeEngine(settings), layout, random_acceleration(random, 0.1), settings);
}

/// A scene and the hash of its final state; to be recorded anew whenever the engine's numbers change.
struct Golden {
  const char* name;
  Run (*run)();
  std::uint64_t hash;
};
constexpr Golden kGolden[] = {
    {"brake", brake, 0x73c47c26719894d0},
    {"lean", lean, 0x39ee2ff3a35c344a},
    {"tumble", tumble, 0x8a922588464ddbb4},
    {"drop", drop, 0xe525aa7a86af08c2},
};

}  // namespace

TEST_CASE("native_golden: fixed scenes end in the same bits as ever, on every instruction set",
          "[physics][native_golden]") {
  for (const Golden& golden : kGolden) {
    native::for_each_instruction_set([&](std::int64_t set) {
      const Run run = golden.run();
      const StateView end = {run.state.position, run.state.orientation, run.state.velocity, run.state.angular_velocity};
      CHECK(is_finite(end));
      // As the table has it, to be copied there.
      const auto entry = [&](std::uint64_t hash) {
        return fmt::format("{{\"{0}\", {0}, {1:#018x}}},", golden.name, hash);
      };
      const std::string now = entry(state_hash(end));
      CAPTURE(set);
      CHECK(now == entry(golden.hash));
    });
  }
}

}  // namespace native_golden_test
