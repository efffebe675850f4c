// The native engine against the slow and obvious one, which shares no code with it.

#include <algorithm>

#include "core/native/native_engine.hpp"
#include "core/reference/plain_engine.hpp"
#include "physics/measures.hpp"

namespace native_plain_twin_test {

using namespace holdfast::internal;
using namespace holdfast::internal::scenes;
using namespace holdfast::internal::physics;

namespace {

/// Largest distance between the places of a box in the two, m, and what was the furthest that any went, m.
struct Difference {
  double of_twins = 0.0;
  double moved = 0.0;
};

Difference difference_of(const Layout& layout, const Acceleration& acceleration, double steps_per_second) {
  Settings settings = small_container(Accuracy::reference);
  settings.steps_per_second = steps_per_second;
  const Run native = run(NativeEngine(settings), layout, acceleration, settings);
  const Run plain = run(PlainEngine(settings), layout, acceleration, settings);
  Difference difference;
  for (std::size_t i = 0; i < layout.boxes.size(); ++i) {
    difference.of_twins = std::max(difference.of_twins, (native.state.position[i] - plain.state.position[i]).norm());
    difference.moved = std::max(difference.moved, native.displacement(i).norm());
  }
  return difference;
}

}  // namespace

TEST_CASE("native_plain_twin: in random scenes both engines bring the boxes to the same places",
          "[physics][native_plain_twin][slow]") {
  for (std::uint32_t seed = 1; seed <= 10; ++seed) {
    Random random(100 + seed);
    const Layout layout = random_layout(random, 4, 6);
    const Acceleration acceleration = random_acceleration(random, 0.1);
    // Coarser steps may part where an impact could go either way.
    const Difference difference = difference_of(layout, acceleration, 960);
    CAPTURE(seed, layout.boxes.size(), text(difference.of_twins), text(difference.moved));
    CHECK(difference.of_twins < 1e-2);
    CHECK(difference.moved > 1e-2);
  }
}

TEST_CASE("native_plain_twin: what rests in one rests in the other", "[physics][native_plain_twin]") {
  const Layout layout = stack(4, {1, 0.5, 0}, {0.8, 0.6, 0.15});
  for (const double share : {0.0, 0.9, 0.999}) {
    const Difference difference = difference_of(layout, constant(share * 0.5 * kGravity, 0.3), 240);
    CAPTURE(share, text(difference.of_twins), text(difference.moved));
    CHECK(difference.moved == 0.0);
    CHECK(difference.of_twins < 1e-5);
  }
}

}  // namespace native_plain_twin_test
