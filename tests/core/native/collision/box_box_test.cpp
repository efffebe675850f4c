#include "core/native/collision/box_box.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/native/collision/boxes.hpp"

namespace box_box_test {

using namespace holdfast::internal::native;
using holdfast::internal::Vec3;

namespace {

constexpr double kMargin = 1e-3;
constexpr double kPi = 3.14159265358979323846;
constexpr ContactAxis kNoAxis{};

bool has_point(const ContactSet& contact, const Vec3& on_b, double tolerance) {
  const auto end = contact.points.begin() + contact.count;
  return std::any_of(contact.points.begin(), end,
                     [&](const ContactPoint& point) { return (point.on_b - on_b).norm() <= tolerance; });
}

int count_of(const OrientedBox& a, const OrientedBox& b) { return contact_of(a, b, kMargin, kNoAxis).count; }

}  // namespace

TEST_CASE("box_box: stacked boxes touch at the four corners of the upper one's base", "[core][box_box]") {
  // Coordinates that binary fractions cannot hold: the touching faces are still one coordinate to rounding.
  const OrientedBox a = box_at({0.35, 0.3, 0.15}, {0.7, 0.6, 0.3});
  const OrientedBox b = box_at({0.35, 0.3, 0.4}, {0.5, 0.4, 0.2});
  for (const bool aligned : {true, false}) {
    const ContactSet contact = contact_of(a, aligned ? b : as_rotated(b), kMargin, kNoAxis);
    CAPTURE(aligned, contact.count, contact.normal.transpose(), least_gap(contact));
    REQUIRE(contact.count == 4);
    CHECK(contact.normal == Vec3(0.0, 0.0, 1.0));
    CHECK(contact.axis == ContactAxis{ContactAxis::Kind::face_of_a, 2, 0});
    CHECK(std::abs(least_gap(contact)) < 1e-15);
    for (const double x : {0.1, 0.6}) {
      for (const double y : {0.1, 0.5}) CHECK(has_point(contact, {x, y, 0.3}, 1e-15));
    }
  }
}

TEST_CASE("box_box: faces that overlap in part touch at the corners of the overlap", "[core][box_box]") {
  const OrientedBox a = box_at({0.0, 0.0, 0.5}, {1.0, 1.0, 1.0});
  const OrientedBox b = box_at({1.0, 0.25, 0.75}, {1.0, 1.0, 1.0});
  for (const bool aligned : {true, false}) {
    const ContactSet contact = contact_of(a, aligned ? b : as_rotated(b), kMargin, kNoAxis);
    CAPTURE(aligned, contact.count, contact.normal.transpose(), least_gap(contact));
    REQUIRE(contact.count == 4);
    CHECK(contact.normal == Vec3(1.0, 0.0, 0.0));
    for (const double y : {-0.25, 0.5}) {
      for (const double z : {0.25, 1.0}) CHECK(has_point(contact, {0.5, y, z}, 0.0));
    }
  }
}

TEST_CASE("box_box: an edge or a corner alone is no contact", "[core][box_box]") {
  const OrientedBox a = box_at({0.0, 0.0, 0.5}, {1.0, 1.0, 1.0});
  for (const double slip : {0.0, 5e-6, -5e-6}) {
    for (const bool aligned : {true, false}) {
      const auto other = [&](const Vec3& centre) {
        const OrientedBox b = box_at(centre, {1.0, 1.0, 1.0});
        return aligned ? b : turned(b, {1.0, 2.0, 3.0}, 1e-7);
      };
      CAPTURE(slip, aligned);
      CHECK(count_of(a, other({1.0 + slip, 0.0, 1.5 - slip})) == 0);
      CHECK(count_of(a, other({1.0 + slip, 0.3, 1.5})) == 0);
      CHECK(count_of(a, other({0.2, -1.0 + slip, -0.5 - slip})) == 0);
      CHECK(count_of(a, other({1.0 + slip, 1.0, 1.5 - slip})) == 0);
    }
  }
  // A ledge of a tenth of a millimetre does carry.
  CHECK(count_of(a, box_at({0.9999, 0.0, 1.5}, {1.0, 1.0, 1.0})) == 4);
}

TEST_CASE("box_box: a turned box beside the corner of another is no contact", "[core][box_box]") {
  // Yawed by 45°, its side passes just by a's corner, on whose top it would stand.
  const OrientedBox a = box_at({0.0, 0.0, 0.5}, {1.0, 1.0, 1.0});
  const double corner_distance = std::sqrt(0.5) + 0.5;
  const auto beside = [&](double along) {
    const double s = (corner_distance + along) * std::sqrt(0.5);
    return turned(box_at({s, s, 1.5}, {1.0, 1.0, 1.0}), {0.0, 0.0, 1.0}, kPi / 4.0);
  };
  CHECK(count_of(a, beside(0.0)) == 0);
  CHECK(count_of(a, beside(-5e-6)) == 0);
  CHECK(count_of(a, beside(-1e-3)) == 3);
}

TEST_CASE("box_box: a gap within the margin is a contact, a wider one none", "[core][box_box]") {
  const OrientedBox a = box_at({0.0, 0.0, 0.5}, {1.0, 1.0, 1.0});
  for (const bool aligned : {true, false}) {
    const auto above = [&](double gap) {
      const OrientedBox b = box_at({0.0, 0.0, 1.25 + gap}, {0.5, 0.5, 0.5});
      return aligned ? b : as_rotated(b);
    };
    const ContactSet near = contact_of(a, above(0.0009), kMargin, kNoAxis);
    CAPTURE(aligned, near.count, least_gap(near));
    CHECK(near.count == 4);
    CHECK(least_gap(near) == Approx(0.0009).margin(1e-15));
    CHECK(count_of(a, above(0.0011)) == 0);
    const ContactSet deep = contact_of(a, above(-0.01), kMargin, kNoAxis);
    CAPTURE(deep.count, least_gap(deep));
    CHECK(deep.count == 4);
    CHECK(least_gap(deep) == Approx(-0.01).margin(1e-15));
  }
}

TEST_CASE("box_box: a box on its edge touches at two points, on its corner at one", "[core][box_box]") {
  const OrientedBox floor = box_at({0.0, 0.0, -0.5}, {4.0, 4.0, 1.0});
  for (const double angle : {0.01, 0.3, kPi / 4.0, 1.2}) {
    OrientedBox edge = turned(box_at(Vec3::Zero(), {0.4, 0.6, 0.8}), {0.0, 1.0, 0.0}, angle);
    edge.centre.z() = edge.axes.row(2).cwiseAbs().dot(edge.half_extents);
    OrientedBox corner = turned(edge, {1.0, 0.0, 0.0}, 0.2);
    corner.centre.z() = corner.axes.row(2).cwiseAbs().dot(corner.half_extents);
    const ContactSet line = contact_of(floor, edge, kMargin, kNoAxis);
    const ContactSet point = contact_of(floor, corner, kMargin, kNoAxis);
    CAPTURE(angle, line.count, least_gap(line), point.count, least_gap(point));
    CHECK(line.count == 2);
    CHECK((line.points[0].on_a - line.points[1].on_a).norm() == Approx(0.6));
    CHECK(std::abs(least_gap(line)) < 1e-15);
    CHECK(point.count == 1);
    CHECK(std::abs(least_gap(point)) < 1e-15);
    CHECK((point.normal - Vec3::UnitZ()).norm() < 1e-15);
  }
}

TEST_CASE("box_box: a box yawed by 45° on a like one touches at eight points", "[core][box_box]") {
  const OrientedBox a = box_at({0.0, 0.0, 0.5}, {1.0, 1.0, 1.0});
  const OrientedBox b = turned(box_at({0.0, 0.0, 1.5}, {1.0, 1.0, 1.0}), {0.0, 0.0, 1.0}, kPi / 4.0);
  const ContactSet contact = contact_of(a, b, kMargin, kNoAxis);
  CAPTURE(contact.count, least_gap(contact));
  REQUIRE(contact.count == 8);
  const double cut = std::sqrt(0.5) - 0.5;
  for (const double x : {-0.5, 0.5}) {
    for (const double y : {-0.5, 0.5}) {
      const double sx = x > 0.0 ? 1.0 : -1.0;
      const double sy = y > 0.0 ? 1.0 : -1.0;
      CHECK(has_point(contact, {x, sy * cut, 1.0}, 1e-12));
      CHECK(has_point(contact, {sx * cut, y, 1.0}, 1e-12));
    }
  }
  // A small one lies on it with its own four corners.
  const OrientedBox small = turned(box_at({0.0, 0.0, 1.25}, {0.5, 0.5, 0.5}), {0.0, 0.0, 1.0}, kPi / 4.0);
  CHECK(count_of(a, small) == 4);
}

TEST_CASE("box_box: a box hardly turned on a like one keeps four distinct points", "[core][box_box]") {
  const OrientedBox a = box_at({0.0, 0.0, 0.5}, {1.0, 1.0, 1.0});
  const OrientedBox b = turned(box_at({0.0, 0.0, 1.5}, {1.0, 1.0, 1.0}), {1.0, 2.0, 3.0}, 1e-9);
  const ContactSet contact = contact_of(a, b, kMargin, kNoAxis);
  CAPTURE(contact.count, least_gap(contact));
  REQUIRE(contact.count == 4);
  for (const double x : {-0.5, 0.5}) {
    for (const double y : {-0.5, 0.5}) CHECK(has_point(contact, {x, y, 1.0}, 2e-9));
  }
}

TEST_CASE("box_box: the points span the whole overlap, however little a box is turned", "[core][box_box]") {
  const OrientedBox a = box_at({0.0, 0.0, 0.5}, {1.0, 1.0, 1.0});
  for (double angle = 1e-12; angle < 0.7; angle *= 1.7) {
    const OrientedBox b = turned(box_at({0.0, 0.0, 1.5}, {1.0, 1.0, 1.0}), {0.0, 0.0, 1.0}, angle);
    const ContactSet contact = contact_of(a, b, kMargin, kNoAxis);
    double area = 0.0;
    for (int i = 0; i < contact.count; ++i) {
      const Vec3& here = contact.points[static_cast<std::size_t>(i)].on_a;
      const Vec3& next = contact.points[static_cast<std::size_t>((i + 1) % contact.count)].on_a;
      area += 0.5 * (here.x() * next.y() - here.y() * next.x());
    }
    CAPTURE(angle, contact.count, area);
    CHECK(contact.count >= 4);
    CHECK(area == Approx(2.0 / (1.0 + std::sin(angle) + std::cos(angle))).epsilon(4e-7));
  }
}

TEST_CASE("box_box: edge-edge normal points from a to b", "[core][box_box]") {
  // Two roofs across each other: their ridges cross at right angles, over the middle of both.
  const double ridge = std::sqrt(0.5);
  const OrientedBox a = turned(box_at(Vec3::Zero(), {1.0, 1.0, 1.0}), {1.0, 0.0, 0.0}, kPi / 4.0);
  for (const double gap : {-0.01, 0.0, 0.0005}) {
    const OrientedBox b = turned(box_at({0.1, 0.2, 2.0 * ridge + gap}, {1.0, 1.0, 1.0}), {0.0, 1.0, 0.0}, kPi / 4.0);
    const ContactSet contact = contact_of(a, b, kMargin, kNoAxis);
    CAPTURE(gap, contact.count, contact.normal.transpose(), least_gap(contact));
    REQUIRE(contact.count == 1);
    CHECK(contact.axis == ContactAxis{ContactAxis::Kind::edges, 0, 1});
    CHECK((contact.normal - Vec3::UnitZ()).norm() < 1e-14);
    CHECK(contact.points[0].gap == Approx(gap).margin(1e-14));
    CHECK((contact.points[0].on_a - Vec3(0.1, 0.0, ridge)).norm() < 1e-12);
    CHECK((contact.points[0].on_b - Vec3(0.1, 0.0, ridge + gap)).norm() < 1e-12);
    const ContactSet reverse = contact_of(b, a, kMargin, kNoAxis);
    CHECK((reverse.normal + Vec3::UnitZ()).norm() < 1e-14);
  }
}

TEST_CASE("box_box: edges between nearly parallel faces have the points of the faces too", "[core][box_box]") {
  // The right face of a, yawed, and the left face of b, pitched: two edges that lead cross 1 mm apart.
  const auto contact_at = [](double angle) {
    const OrientedBox a = turned(box_at({0, 0, 0}, {1, 1, 1}), Vec3::UnitZ(), -angle);
    const double apart = std::cos(angle) + std::sin(angle) + 1e-3;
    const OrientedBox b = turned(box_at({apart, 0.1, 0.1}, {1, 1, 1}), Vec3::UnitY(), angle);
    return contact_of(a, b, 0.2, {});
  };
  const ContactSet slight = contact_at(0.05);
  CHECK(slight.axis.kind == ContactAxis::Kind::edges);
  REQUIRE(slight.count == 4);
  for (std::size_t i = 1; i < 4; ++i) {
    CHECK(slight.points[i].gap > slight.points[0].gap);
    CHECK(slight.points[i].gap < 0.15);
    CHECK((slight.points[i].on_a - slight.points[0].on_a).norm() > 0.5);
  }
  const ContactSet far = contact_at(0.5);
  CHECK(far.axis.kind == ContactAxis::Kind::edges);
  CHECK(far.count == 1);
}

TEST_CASE("box_box: a box that has sunk into the edge it lies on is held at both ends of it", "[core][box_box]") {
  // A box hangs over the edge of a wider one, leans over it, and has sunk into it a little deeper at one end: less
  // along the product of that edge and one of its own than along its face, as the edge goes on beyond its sides.
  const OrientedBox a = box_at({0.0, 0.0, 0.5}, {1.0, 2.0, 1.0});
  for (const double lean : {0.01, 0.03}) {
    for (const double roll : {-2e-3, 1e-3, 4e-3}) {
      const OrientedBox flat = box_at({0.6, 0.0, 1.099 - 0.1 * lean}, {0.6, 0.6, 0.2});
      const OrientedBox rolled = turned(flat, {1.0, 0.0, 0.0}, roll);
      const OrientedBox b = turned(rolled, {0.0, 1.0, 0.0}, lean);
      for (const ContactSet& contact : {contact_of(a, b, kMargin, kNoAxis), contact_of(b, a, kMargin, kNoAxis)}) {
        CAPTURE(lean, roll, contact.count, contact.normal.transpose());
        double low = 0.0, high = 0.0;
        for (int i = 0; i < contact.count; ++i) {
          low = std::min(low, contact.points[static_cast<std::size_t>(i)].on_b.y());
          high = std::max(high, contact.points[static_cast<std::size_t>(i)].on_b.y());
        }
        CHECK(low == Approx(-0.3).margin(2e-3));
        CHECK(high == Approx(0.3).margin(2e-3));
      }
    }
  }
}

TEST_CASE("box_box: the axis of the step before wins near ties", "[core][box_box]") {
  // Overlaps of 1.000 mm in x and 1.015 mm in z: x is better, though not by enough to change.
  const OrientedBox a = box_at({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0});
  const OrientedBox b = box_at({0.999, 0.0, 0.998985}, {1.0, 1.0, 1.0});
  for (const bool aligned : {true, false}) {
    const OrientedBox other = aligned ? b : as_rotated(b);
    CAPTURE(aligned);
    CHECK(contact_of(a, other, kMargin, kNoAxis).normal == Vec3(1.0, 0.0, 0.0));
    const ContactAxis up{ContactAxis::Kind::face_of_a, 2, 0};
    const ContactSet kept = contact_of(a, other, kMargin, up);
    CHECK(kept.normal == Vec3(0.0, 0.0, 1.0));
    CHECK(kept.axis == up);
  }
}

TEST_CASE("box_box: plates of a millimetre and boxes of a hundred metres", "[core][box_box]") {
  for (const double angle : {0.0, 0.3}) {
    const auto laid = [&](const OrientedBox& box) { return angle == 0.0 ? box : turned(box, {0.0, 0.0, 1.0}, angle); };
    const OrientedBox plate = box_at({0.0, 0.0, 0.0005}, {1.2, 0.8, 0.001});
    const ContactSet plates = contact_of(plate, laid(box_at({0.0, 0.0, 0.0015}, {0.2, 0.1, 0.001})), 1e-4, kNoAxis);
    const OrientedBox giant = box_at({50.0, 50.0, 50.0}, {100.0, 100.0, 100.0});
    const ContactSet grain =
        contact_of(giant, laid(box_at({70.0, 30.0, 100.0005}, Vec3::Constant(0.001))), 1e-4, kNoAxis);
    const ContactSet giants = contact_of(giant, laid(box_at({50.0, 50.0, 150.0}, {60.0, 60.0, 100.0})), 1e-4, kNoAxis);
    CAPTURE(angle, plates.count, least_gap(plates), grain.count, least_gap(grain), giants.count, least_gap(giants));
    for (const ContactSet* contact : {&plates, &grain, &giants}) {
      CHECK(contact->count == 4);
      CHECK((contact->normal - Vec3::UnitZ()).norm() < 1e-15);
      CHECK(std::abs(least_gap(*contact)) < 1e-13);
    }
  }
}

TEST_CASE("box_box: a pose that is not a number has no contact", "[core][box_box]") {
  const OrientedBox a = box_at(Vec3::Zero(), {1.0, 1.0, 1.0});
  const OrientedBox lost = box_at({0.0, std::nan(""), 0.0}, {1.0, 1.0, 1.0});
  OrientedBox crooked = as_rotated(a);
  crooked.axes(1, 2) = std::nan("");
  CHECK(count_of(a, lost) == 0);
  CHECK(count_of(a, as_rotated(lost)) == 0);
  CHECK(count_of(a, crooked) == 0);
  CHECK(count_of(crooked, a) == 0);
  CHECK(contact_of(HalfSpace{.normal = Vec3::UnitY()}, lost, kMargin).count == 0);
  CHECK(contact_of(HalfSpace{}, crooked, kMargin).count == 0);
}

TEST_CASE("box_box: a mirrored scene has the mirrored contact, to the bit", "[core][box_box]") {
  const OrientedBox a = box_at({0.37, -0.21, 0.13}, {0.71, 0.59, 0.3});
  const OrientedBox b = box_at({0.83, 0.11, 0.41}, {0.53, 0.47, 0.26001});
  const HalfSpace side{.normal = {-1.0, 0.0, 0.0}, .offset = -1.0951};
  for (const int axis : {0, 1}) {
    const auto mirrored = [&](Vec3 v) {
      v[axis] = -v[axis];
      return v;
    };
    const auto check = [&](const ContactSet& contact, const ContactSet& image) {
      REQUIRE(contact.count == 4);
      REQUIRE(image.count == 4);
      CHECK(image.normal == mirrored(contact.normal));
      for (const ContactPoint& point : contact.points) {
        CHECK(std::any_of(image.points.begin(), image.points.end(), [&](const ContactPoint& other) {
          return other.on_a == mirrored(point.on_a) && other.on_b == mirrored(point.on_b) && other.gap == point.gap;
        }));
      }
    };
    OrientedBox image_a = a;
    OrientedBox image_b = b;
    image_a.centre = mirrored(a.centre);
    image_b.centre = mirrored(b.centre);
    check(contact_of(a, b, kMargin, kNoAxis), contact_of(image_a, image_b, kMargin, kNoAxis));
    check(contact_of(side, b, kMargin), contact_of(HalfSpace{mirrored(side.normal), side.offset}, image_b, kMargin));
  }
}

}  // namespace box_box_test
