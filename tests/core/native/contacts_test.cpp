#include "core/native/contacts.hpp"

#include <catch2/catch.hpp>

#include "core/native/small_world.hpp"

namespace contacts_test {

using namespace holdfast::internal;
using namespace holdfast::internal::native;
using namespace holdfast::internal::scenes;
using native_scenes::SmallWorld;

namespace {

constexpr double kFar = 5.0;  // m

/// Two cubes of 1 m on the floor, 0.2 mm apart along x; body 0 is the one with the smaller x.
Layout two_cubes() { return layout_of({box({5, 5, 0}, {1, 1, 1}), box({6.0002, 5, 0}, {1, 1, 1})}); }

}  // namespace

TEST_CASE("contacts: near pairs have a manifold, which ends when they part", "[core][contacts]") {
  SmallWorld world(open_floor(0.5), two_cubes());
  REQUIRE(world.contact(0, 1) != nullptr);
  CHECK(world.contact(0, 1)->nearest_gap == Approx(0.0002).margin(1e-12));
  CHECK_FALSE(world.contact(0, 1)->active);
  REQUIRE(world.on_floor(0) != nullptr);
  CHECK(world.on_floor(0)->active);
  CHECK(world.state.scene.manifolds.size() == 3);

  world.put(1, {kFar, 0, 0});
  CHECK(world.contact(0, 1) == nullptr);
  CHECK(world.on_floor(1) != nullptr);
  CHECK(world.state.scene.manifolds.size() == world.state.contacts.pairs().size());

  world.put(1, {0, 0, 3.0});
  CHECK(world.on_floor(1) == nullptr);
  CHECK(world.on_floor(0) != nullptr);
}

TEST_CASE("contacts: bodies that overlap unannounced are marked, but for those that are ahead", "[core][contacts]") {
  SmallWorld world(open_floor(0.5), two_cubes());
  world.state.contacts.forget_missed(2);
  const Vec3 into = {-0.0032, 0, 0};  // 3 mm of overlap
  SECTION("both have to take the step again, with the contact as it was at its start") {
    world.put(1, into);
    CHECK(world.state.contacts.missed() == std::vector<std::uint8_t>{1, 1});
    world.bodies().state.position[1] -= into;
    world.bodies().update_shape(1);
    const auto late = world.state.contacts.late_at_start(world.state.scene);
    REQUIRE(late.size() == 1);
    CHECK(late[0].contact.nearest_gap() == Approx(0.0002).margin(1e-12));
    world.state.contacts.forget_missed(2);
    CHECK(world.state.contacts.missed() == std::vector<std::uint8_t>{0, 0});
    CHECK(world.state.contacts.late_at_start(world.state.scene).empty());
  }
  SECTION("none is taken back where the bodies overlap at the start, too") {
    world.put(1, into);
    CHECK(world.state.contacts.late_at_start(world.state.scene).empty());
  }
  SECTION("one that has taken the whole step is no obstacle") {
    world.bodies().activity[0] = Activity::ahead;
    world.put(1, into);
    CHECK(world.state.contacts.missed() == std::vector<std::uint8_t>{0, 0});
  }
}

TEST_CASE("contacts: a body that has passed through another is found", "[core][contacts]") {
  SmallWorld world(open_floor(0.5), two_cubes());
  const StateColumns before = world.bodies().state;
  world.state.contacts.forget_missed(2);
  SECTION("beyond it on the other side") {
    world.put(0, {kFar, 0, 0});
    world.state.contacts.find_tunnelled(world.state.scene, world.state.terms, before);
    CHECK(world.state.contacts.missed() == std::vector<std::uint8_t>{1, 1});
  }
  SECTION("not past it at its side") {
    world.put(0, {kFar, 5.0, 0});
    world.state.contacts.find_tunnelled(world.state.scene, world.state.terms, before);
    CHECK(world.state.contacts.missed() == std::vector<std::uint8_t>{0, 0});
  }
}

TEST_CASE("contacts: a change of the coefficients reaches all contacts and forgets their forces", "[core][contacts]") {
  SmallWorld world(open_floor(0.5), two_cubes());
  world.on_floor(0)->cached[0].force = {1, 0, 10};
  ContactSettings law = world.settings.contact;
  law.box_floor = 0.25;
  world.state.contacts.set_law(world.state.scene, law);
  CHECK(world.on_floor(0)->friction == 0.25);
  CHECK(world.contact(0, 1)->friction == 0.5);
  CHECK(world.on_floor(0)->cached[0].force == Vec3::Zero());
}

TEST_CASE("contacts: a flush edge that has sunk in is no contact", "[core][contacts]") {
  // A slider over the seam of two plates, of which the second stands 0.2 mm higher; or it stands beyond the side of the
  // first, over which the slider reaches by 80 µm.
  const bool beyond_side = GENERATE(false, true);
  CAPTURE(beyond_side);
  SmallWorld world(open_floor(0.5),
                   layout_of({box({5, 5, 0}, {1, 1, 0.5}), box({6, beyond_side ? 6.0 : 5.0, 0}, {1, 1, 0.5}),
                              box({5.2, beyond_side ? 5.4 + 8e-5 : 5.2, 0.5}, {0.7, 0.6, 0.2})}));
  const std::int32_t slider = 1;  // bodies are sorted by their first positions
  REQUIRE(world.bodies().state.position[1].z() > 0.5);
  SECTION("what it has sunk with its plate does not stop it") {
    world.put(0, {0, 0, -2e-4});
    world.put(1, {0.1 - 1e-6, 0, -2e-4});
    CHECK(world.contact(slider, 2) == nullptr);
  }
  SECTION("what one corner of it has sunk does not, on whichever side that is") {
    const double roll = GENERATE(2.7e-4, -2.7e-4);
    world.bodies().state.orientation[1] = Eigen::AngleAxisd(roll, Vec3::UnitX());
    world.put(1, {0.1 - 1e-6, 0, -1.1e-4});
    CAPTURE(roll);
    CHECK(world.contact(slider, 2) == nullptr);
  }
  SECTION("an edge that is there does") {
    world.put(0, {0, 0, -0.01});  // nothing carries the slider
    world.put(1, {0.1 - 1e-6, 0, -2e-4});
    CHECK(world.contact(slider, 2) != nullptr);
  }
}

}  // namespace contacts_test
