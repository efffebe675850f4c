#include "core/native/collision/manifold.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstddef>

#include "core/native/collision/boxes.hpp"

namespace manifold_test {

using namespace holdfast::internal::native;
using holdfast::internal::Vec3;

namespace {

constexpr double kMargin = 1e-3;

/// Takes the contact of the boxes where they are now.
void renew(Manifold& manifold, const Bodies& bodies, const std::vector<Side>& sides = {}) {
  update_contact(manifold, contact_now(bodies, sides, manifold.a, manifold.b, kMargin, manifold.contact.axis), bodies);
}

/// The bodies' manifold of four points, each with an impulse of its own: the force on point i is i + 1 newton upwards.
Manifold marked_manifold(std::int32_t a, std::int32_t b, const Bodies& bodies, const std::vector<Side>& sides = {}) {
  Manifold manifold;
  manifold.a = a;
  manifold.b = b;
  manifold.activate();
  renew(manifold, bodies, sides);
  REQUIRE(manifold.contact.count == 4);
  for (std::size_t i = 0; i < manifold.cached.size(); ++i)
    manifold.cached[i].force = Vec3(0, 0, static_cast<double>(i) + 1.0);
  return manifold;
}

/// A box that stands across the corner of another.
Bodies two_boxes() {
  Bodies bodies;
  bodies.shape = {box_at({0, 0, 0.5}, {2, 2, 1}), box_at({1, 1, 1.5}, {2, 2, 1})};
  return bodies;
}

std::size_t points_with_impulse(const Manifold& manifold) {
  return static_cast<std::size_t>(
      std::count_if(manifold.cached.begin(), manifold.cached.begin() + manifold.contact.count,
                    [](const CachedImpulse& cached) { return cached.force != Vec3::Zero(); }));
}

}  // namespace

TEST_CASE("manifold: points keep their impulses where both bodies go and turn far", "[core][manifold]") {
  Bodies bodies = two_boxes();
  Manifold manifold = marked_manifold(0, 1, bodies);
  const Manifold before = manifold;

  const Mat3 turn = Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const Vec3 shift(1.3, -0.4, 0.0);
  for (OrientedBox& box : bodies.shape) {
    box.centre = turn * box.centre + shift;
    box.axes = turn * box.axes;
    box.aligned = false;
  }
  renew(manifold, bodies);
  REQUIRE(manifold.contact.count == 4);
  for (std::size_t i = 0; i < 4; ++i) {
    const auto same =
        std::find_if(before.contact.points.begin(), before.contact.points.begin() + 4, [&](const ContactPoint& old) {
          return (turn * old.on_b + shift - manifold.contact.points[i].on_b).norm() < 1e-9;
        });
    REQUIRE(same != before.contact.points.begin() + 4);
    CHECK(manifold.cached[i].force ==
          before.cached[static_cast<std::size_t>(same - before.contact.points.begin())].force);
  }
}

TEST_CASE("manifold: a box that slides far over a side keeps the impulses of its corners", "[core][manifold]") {
  Bodies bodies;
  bodies.shape = {box_at({2, 1, 0.5}, {2, 2, 1})};
  const std::vector<Side> floor = {{.play = {0.0}}};
  Manifold manifold = marked_manifold(-1, 0, bodies, floor);
  bodies.shape[0].centre.x() += 0.3;
  renew(manifold, bodies, floor);
  CHECK(points_with_impulse(manifold) == 4);
}

TEST_CASE("manifold: points that are on neither body where one was have no cached impulse", "[core][manifold]") {
  Bodies bodies = two_boxes();
  Manifold manifold = marked_manifold(0, 1, bodies);
  // The corner of each body stays a corner of the overlap; where sides cross, both have moved on.
  bodies.shape[1].centre += Vec3(-0.1, -0.2, 0.0);
  renew(manifold, bodies);
  REQUIRE(manifold.contact.count == 4);
  CHECK(points_with_impulse(manifold) == 2);
}

}  // namespace manifold_test
