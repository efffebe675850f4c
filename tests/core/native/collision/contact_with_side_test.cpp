#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/native/collision/box_box.hpp"
#include "core/native/collision/boxes.hpp"

namespace contact_with_side_test {

using namespace holdfast::internal::native;
using holdfast::internal::Vec3;

namespace {

constexpr double kMargin = 1e-3;
constexpr double kPi = 3.14159265358979323846;

/// Lowers the box until its lowest corner is `gap` from the side.
OrientedBox at_gap(OrientedBox box, const HalfSpace& side, double gap) {
  const Vec3 cosines = box.axes.transpose() * side.normal;
  const double lowest = side.normal.dot(box.centre) - cosines.cwiseAbs().dot(box.half_extents);
  box.centre += (side.offset + gap - lowest) * side.normal;
  return box;
}

void check_points(const ContactSet& contact, const HalfSpace& side, const OrientedBox& box) {
  for (int i = 0; i < contact.count; ++i) {
    const ContactPoint& point = contact.points[static_cast<std::size_t>(i)];
    const Vec3 local = (box.axes.transpose() * (point.on_b - box.centre)).cwiseAbs();
    CAPTURE(i, point.on_a.transpose(), point.on_b.transpose(), point.gap, local.transpose());
    CHECK((local - box.half_extents).norm() < 1e-12);
    CHECK(std::abs(side.normal.dot(point.on_a) - side.offset) < 1e-12);
    CHECK(std::abs(contact.normal.dot(point.on_b - point.on_a) - point.gap) < 1e-12);
  }
}

}  // namespace

TEST_CASE("box_box: a box on the floor stands on the four corners of its base", "[core][box_box]") {
  const HalfSpace floor;
  const HalfSpace door{.normal = {-1.0, 0.0, 0.0}, .offset = -12.0};
  for (const double gap : {0.0, 0.0005, -0.002}) {
    for (const HalfSpace& side : {floor, door}) {
      const OrientedBox box = at_gap(box_at({11.0, 0.4, 0.3}, {0.7, 0.6, 0.3}), side, gap);
      for (const bool aligned : {true, false}) {
        const OrientedBox other = aligned ? box : as_rotated(box);
        const ContactSet contact = contact_of(side, other, kMargin);
        CAPTURE(gap, aligned, contact.count, least_gap(contact));
        REQUIRE(contact.count == 4);
        CHECK(contact.normal == side.normal);
        CHECK(least_gap(contact) == Approx(gap).margin(1e-14));
        check_points(contact, side, other);
      }
    }
  }
}

TEST_CASE("box_box: a box away from the side has no contact with it", "[core][box_box]") {
  const HalfSpace floor;
  const OrientedBox box = at_gap(box_at(Vec3::Zero(), {0.7, 0.6, 0.3}), floor, 0.0011);
  const OrientedBox tilted = at_gap(turned(box, {1.0, 2.0, 0.5}, 0.7), floor, 0.0011);
  CHECK(contact_of(floor, box, kMargin).count == 0);
  CHECK(contact_of(floor, tilted, kMargin).count == 0);
}

TEST_CASE("box_box: a box on its edge or corner on the floor, at any angle", "[core][box_box]") {
  const HalfSpace floor{.normal = Vec3::UnitZ(), .offset = 0.2};
  // 45° is a tie of two faces: either has the lowest edge.
  for (const double angle : {0.01, 0.3, kPi / 4.0, std::nextafter(kPi / 4.0, 0.0), 1.2, kPi / 2.0 + 0.1}) {
    const OrientedBox edge = at_gap(turned(box_at(Vec3::Zero(), {0.4, 0.6, 0.8}), {0.0, 1.0, 0.0}, angle), floor, 0.0);
    const OrientedBox corner = at_gap(turned(edge, {1.0, 0.0, 0.0}, 0.2), floor, 0.0);
    const ContactSet line = contact_of(floor, edge, kMargin);
    const ContactSet point = contact_of(floor, corner, kMargin);
    CAPTURE(angle, line.count, least_gap(line), point.count, least_gap(point));
    CHECK(line.count == 2);
    CHECK(std::abs(line.points[0].on_b.y() - line.points[1].on_b.y()) == Approx(0.6));
    CHECK(std::abs(least_gap(line)) < 1e-15);
    CHECK(point.count == 1);
    CHECK(std::abs(least_gap(point)) < 1e-15);
    check_points(line, floor, edge);
    check_points(point, floor, corner);
  }
}

TEST_CASE("box_box: a side of any inclination carries a box that lies on it", "[core][box_box]") {
  const OrientedBox box = turned(box_at({1.0, 2.0, 3.0}, {0.4, 0.6, 0.8}), {1.0, -2.0, 0.5}, 0.9);
  for (int axis = 0; axis < 3; ++axis) {
    const HalfSpace side{.normal = -box.axes.col(axis), .offset = 0.37};
    const OrientedBox laid = at_gap(box, side, -1e-4);
    const ContactSet contact = contact_of(side, laid, kMargin);
    CAPTURE(axis, contact.count, least_gap(contact));
    REQUIRE(contact.count == 4);
    CHECK(contact.axis.b == axis);
    CHECK(least_gap(contact) == Approx(-1e-4).margin(1e-14));
    check_points(contact, side, laid);
  }
}

}  // namespace contact_with_side_test
