#include "core/native/collision/clipping.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/native/collision/boxes.hpp"
#include "core/native/constants.hpp"
#include "random.hpp"

namespace clipping_test {

using namespace holdfast::internal;
using namespace holdfast::internal::native;

namespace {

constexpr ContactAxis kTopOfA{ContactAxis::Kind::face_of_a, 2, 0};

/// A box with its lower face in the upper one of `below`, turned about the vertical.
OrientedBox yawed_on(const OrientedBox& below, const Vec3& size, double x, double y, double angle) {
  const double top = below.centre.z() + below.half_extents.z();
  return turned(box_at({x, y, top + 0.5 * size.z()}, size), Vec3::UnitZ(), angle);
}

ContactSet top_contact(const OrientedBox& a, const OrientedBox& b, double margin = 1e-3) {
  return face_contact(a, b, relative_pose(a, b), kTopOfA, margin);
}

double area_of(const ContactSet& contact) {
  double twice = 0.0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(contact.count); ++i) {
    const Vec3& p = contact.points[i].on_a;
    const Vec3& q = contact.points[(i + 1) % static_cast<std::size_t>(contact.count)].on_a;
    twice += p.x() * q.y() - q.x() * p.y();
  }
  return 0.5 * std::abs(twice);
}

bool covers(const OrientedBox& box, const Vec3& point) {
  const Vec3 local = box.axes.transpose() * (point - box.centre);
  return std::abs(local.x()) <= box.half_extents.x() && std::abs(local.y()) <= box.half_extents.y();
}

}  // namespace

TEST_CASE("clipping: a plate yawed by 45 degrees on a like one overlaps in an octagon", "[core][clipping]") {
  const OrientedBox below = as_rotated(box_at({0, 0, 0.5}, {1, 1, 1}));
  const ContactSet contact = top_contact(below, yawed_on(below, {1, 1, 1}, 0, 0, std::acos(-1.0) / 4));
  CHECK(contact.count == 8);
  CHECK(area_of(contact) == Approx(2 * (std::sqrt(2.0) - 1)).epsilon(1e-12));
  CHECK(contact.normal == Vec3::UnitZ());
}

// The independent reference: a fine grid of points, counted where both outlines cover them.
TEST_CASE("clipping: the points span the area that both faces share", "[core][clipping]") {
  Random random(21);
  constexpr int kGrid = 400;
  int checked = 0;
  for (int i = 0; i < 60; ++i) {
    const OrientedBox below = as_rotated(box_at({0, 0, 0.5}, {random.between(0.3, 1), random.between(0.3, 1), 1}));
    const OrientedBox above = yawed_on(below, {random.between(0.3, 1), random.between(0.3, 1), 0.4},
                                       random.between(-0.5, 0.5), random.between(-0.5, 0.5), random.between(0, 6.28));
    const ContactSet contact = top_contact(below, above);
    int inside = 0;
    for (int u = 0; u < kGrid; ++u)
      for (int v = 0; v < kGrid; ++v)
        inside += covers(above, below.half_extents.cwiseProduct(
                                    Vec3(2.0 * (u + 0.5) / kGrid - 1, 2.0 * (v + 0.5) / kGrid - 1, 0.0)));
    const double face = 4 * below.half_extents.x() * below.half_extents.y();
    const double expected = face * inside / (kGrid * kGrid);
    CAPTURE(i, contact.count, expected);
    CHECK(area_of(contact) == Approx(expected).margin(0.01 * face));
    for (int p = 0; p < contact.count; ++p) {
      const ContactPoint& point = contact.points[static_cast<std::size_t>(p)];
      CHECK(std::abs(point.gap) < 1e-12);
      CHECK((point.on_a - point.on_b).norm() < 1e-12);
    }
    checked += contact.count > 2 ? 1 : 0;
  }
  CHECK(checked > 30);
}

TEST_CASE("clipping: points farther than the margin are left out", "[core][clipping]") {
  const OrientedBox below = as_rotated(box_at({0, 0, 0.5}, {4, 4, 1}));
  // Tilted about y: one edge touches, the other is 0.1 m up.
  OrientedBox tilted = turned(box_at({0, 0, 0}, {1, 1, 0.2}), Vec3::UnitY(), 0.1);
  tilted.centre.z() = 1.0 + 0.5 * std::sin(0.1) + 0.1 * std::cos(0.1);
  CHECK(top_contact(below, tilted, 1e-3).count == 2);
  const ContactSet all = top_contact(below, tilted, 0.2);
  REQUIRE(all.count == 4);
  double highest = 0.0;
  for (const ContactPoint& point : {all.points[0], all.points[1], all.points[2], all.points[3]})
    highest = std::max(highest, point.gap);
  CHECK(highest == Approx(std::sin(0.1)).epsilon(1e-12));
}

TEST_CASE("clipping: outlines that overlap by less than the tolerance have no contact", "[core][clipping]") {
  const OrientedBox below = as_rotated(box_at({0, 0, 0.5}, {1, 1, 1}));
  const double angle = 0.3;
  // The corner of the upper box that reaches farthest towards -x.
  const double reach = 0.5 * (std::cos(angle) + std::sin(angle));
  CHECK(top_contact(below, yawed_on(below, {1, 1, 1}, 0.5 + reach - 0.5 * kContactTolerance, 0, angle)).count == 0);
  CHECK(top_contact(below, yawed_on(below, {1, 1, 1}, 0.5 + reach - 1e-3, 0, angle)).count >= 3);
}

TEST_CASE("clipping: two edges that cross touch where they are nearest", "[core][clipping]") {
  const double half = 0.5, gap = 2e-3, diagonal = half * std::sqrt(2.0);
  const double quarter = std::acos(-1.0) / 4;
  // Each stands on an edge: a's upper edge is along x, b's lower one along y.
  const OrientedBox a = turned(box_at({0.2, 0, 0}, {1, 1, 1}), Vec3::UnitX(), quarter);
  const OrientedBox b = turned(box_at({0, 0.1, 2 * diagonal + gap}, {1, 1, 1}), Vec3::UnitY(), quarter);
  const ContactSet contact = edge_contact(a, b, relative_pose(a, b), {ContactAxis::Kind::edges, 0, 1});
  REQUIRE(contact.count == 1);
  CHECK((contact.normal - Vec3::UnitZ()).norm() < 1e-12);
  CHECK(contact.points[0].gap == Approx(gap).epsilon(1e-10));
  CHECK((contact.points[0].on_a - Vec3(0, 0, diagonal)).norm() < 1e-12);
  CHECK((contact.points[0].on_b - Vec3(0, 0, diagonal + gap)).norm() < 1e-12);
  // Beside the edge's end they do not cross.
  const OrientedBox beside = turned(box_at({0.8, 0.1, 2 * diagonal + gap}, {1, 1, 1}), Vec3::UnitY(), quarter);
  CHECK(edge_contact(a, beside, relative_pose(a, beside), {ContactAxis::Kind::edges, 0, 1}).count == 0);
}

}  // namespace clipping_test
