#include "core/native/world_invariants.hpp"

#include <catch2/catch.hpp>
#include <functional>
#include <limits>

#include "core/native/native_scenes.hpp"
#include "random.hpp"

namespace world_invariants_test {

using namespace holdfast::internal;
using namespace holdfast::internal::native;
using namespace holdfast::internal::scenes;
using native_scenes::OneWorld;

namespace {

/// Two stacks side by side: one is pushed against the other, and both come to rest.
OneWorld two_stacks() {
  Layout layout = stack(3, {2, 1, 0}, {0.5, 0.5, 0.5});
  for (const Box& box : stack(2, {2.52, 1, 0}, {0.5, 0.5, 0.5}).boxes) layout.boxes.push_back(box);
  return OneWorld(Settings(), layout, acceleration_of({{0.2, Vec3(-4, 0, 0)}, {2.0, Vec3::Zero()}}));
}

}  // namespace

TEST_CASE("world_invariants: they hold after every step, at every accuracy", "[core][world_invariants]") {
  for (const Accuracy accuracy : {Accuracy::screening, Accuracy::standard, Accuracy::reference}) {
    Settings settings = at_once();
    settings.native.accuracy = accuracy;
    settings.contact.restitution = 0.3;
    Random random(7);
    Layout layout = layout_of({});
    for (int i = 0; i < 12; ++i) {
      const Vec3 size(random.between(0.2, 0.5), random.between(0.2, 0.5), random.between(0.1, 0.5));
      const int row = i / 3 % 2;
      const int layer = i / 6;
      layout.boxes.push_back(box({1.0 + 0.6 * (i % 3), 0.1 + 0.6 * row, 0.02 + 0.6 * layer}, size));
    }
    OneWorld scene(settings, layout,
                   acceleration_of({{0.3, Vec3(6, 3, 0)}, {0.3, Vec3(-5, 0, 2)}, {0.2, Vec3::Zero()}}));
    int looks = 0;
    bool touched = false;
    scene.run([&] {
      ++looks;
      touched = touched || !scene.world.view().scene.manifolds.empty();
      const std::vector<std::string> broken = broken_invariants(scene.world.view());
      CAPTURE(static_cast<int>(accuracy), looks, broken.empty() ? "" : broken.front());
      REQUIRE(broken.empty());
    });
    CHECK(touched);
    CHECK(looks > 40);
  }
}

TEST_CASE("world_invariants: whatever is broken in a world is reported", "[core][world_invariants]") {
  OneWorld whole = two_stacks();
  whole.run([] {});
  const WorldView view = whole.world.view();
  REQUIRE(broken_invariants(view).empty());
  REQUIRE(view.scene.manifolds.size() > 4);
  REQUIRE_FALSE(view.scene.bodies.any(Activity::moving));
  const auto is_told = [&](const std::function<void(Scene&, PairTable&)>& damage) {
    Scene scene = view.scene;
    PairTable pairs = view.pairs;
    damage(scene, pairs);
    return !broken_invariants({scene, pairs, view.islands}).empty();
  };
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(is_told([](Scene&, PairTable&) {}));
  CHECK(is_told([](Scene& s, PairTable&) { s.manifolds.pop_back(); }));
  CHECK(is_told([](Scene& s, PairTable&) { std::swap(s.manifolds[0], s.manifolds[1]); }));
  CHECK(is_told([](Scene& s, PairTable& p) { p.erase(s.manifolds[0].a, s.manifolds[0].b); }));
  CHECK(is_told([](Scene& s, PairTable& p) { p.set(0, static_cast<std::int32_t>(s.bodies.count()) + 5, 0); }));
  CHECK(is_told([](Scene& s, PairTable&) { s.manifolds[0].b = 1000; }));
  CHECK(is_told([](Scene& s, PairTable&) { s.manifolds[0].contact.normal *= 1.001; }));
  CHECK(is_told([](Scene& s, PairTable&) { s.manifolds[0].contact.count = 0; }));
  CHECK(is_told([](Scene& s, PairTable&) { s.manifolds[0].contact.points[0].gap = kNan; }));
  CHECK(is_told([](Scene& s, PairTable&) { s.manifolds[0].cached[0].force[1] = kNan; }));
  CHECK(is_told([](Scene& s, PairTable&) { s.manifolds[0].cached[0].pressed = -1.0; }));
  CHECK(is_told([](Scene& s, PairTable&) {
    s.manifolds[0].deactivate();
    s.manifolds[0].cached[0].pressed = 1.0;
  }));
  CHECK(is_told([](Scene& s, PairTable&) { s.bodies.state.velocity[0].x() = 1e-12; }));
  CHECK(is_told([](Scene& s, PairTable&) { s.bodies.state.position[0].x() = kNan; }));
  CHECK(is_told([](Scene& s, PairTable&) { s.bodies.state.orientation[0].w() = 2.0; }));
  // Islands that know of no active contact are not closed under those that there are.
  Scene idle = view.scene;
  for (Manifold& manifold : idle.manifolds) manifold.deactivate();
  Connectivity apart;
  apart.find(idle.bodies, idle.manifolds);
  CHECK(broken_invariants({idle, view.pairs, apart}).empty());
  CHECK_FALSE(broken_invariants({view.scene, view.pairs, apart}).empty());
}

}  // namespace world_invariants_test
