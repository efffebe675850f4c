#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "core/native/collision/box_box.hpp"
#include "core/native/collision/boxes.hpp"
#include "core/native/constants.hpp"
#include "random.hpp"

namespace box_box_random_test {

using namespace holdfast::internal::native;
using holdfast::internal::Random;
using holdfast::internal::Vec3;

namespace {

constexpr double kMargin = 1e-3;
constexpr ContactAxis kNoAxis{};

/// Signed distance from the box' surface of a point near it: positive outside.
double outside_of(const OrientedBox& box, const Vec3& point) {
  const Vec3 local = box.axes.transpose() * (point - box.centre);
  return (local.cwiseAbs() - box.half_extents).maxCoeff();
}

/// A box as its corners, edges and face normals.
struct Hull {
  std::vector<Vec3> corners;
  std::vector<std::pair<Vec3, Vec3>> edges;
};

Hull hull_of(const OrientedBox& box) {
  Hull hull;
  const auto corner = [&](int bits) {
    const Vec3 local((bits & 1) != 0 ? 1.0 : -1.0, (bits & 2) != 0 ? 1.0 : -1.0, (bits & 4) != 0 ? 1.0 : -1.0);
    return Vec3(box.centre + box.axes * box.half_extents.cwiseProduct(local));
  };
  for (int bits = 0; bits < 8; ++bits) {
    hull.corners.push_back(corner(bits));
    for (int flip = 1; flip < 8; flip *= 2) {
      if ((bits & flip) == 0) hull.edges.emplace_back(corner(bits), corner(bits | flip));
    }
  }
  return hull;
}

/// How far b's corners lie beyond a's along a direction: the separation along it.
double separation_along(const Vec3& direction, const Hull& a, const Hull& b) {
  double furthest = -std::numeric_limits<double>::infinity();
  double nearest = std::numeric_limits<double>::infinity();
  for (const Vec3& corner : a.corners) furthest = std::max(furthest, direction.dot(corner));
  for (const Vec3& corner : b.corners) nearest = std::min(nearest, direction.dot(corner));
  return nearest - furthest;
}

/// The greatest separation along any normal of the two boxes' Minkowski difference.
double greatest_separation(const OrientedBox& a, const OrientedBox& b) {
  const Hull hull_a = hull_of(a);
  const Hull hull_b = hull_of(b);
  std::vector<Vec3> directions;
  for (int i = 0; i < 3; ++i) {
    directions.emplace_back(a.axes.col(i));
    directions.emplace_back(b.axes.col(i));
    for (int j = 0; j < 3; ++j) {
      const Vec3 product = a.axes.col(i).cross(b.axes.col(j));
      if (product.norm() > 1e-4) directions.emplace_back(product.normalized());
    }
  }
  double greatest = -std::numeric_limits<double>::infinity();
  for (const Vec3& direction : directions) {
    greatest = std::max(
        {greatest, separation_along(direction, hull_a, hull_b), separation_along(Vec3(-direction), hull_a, hull_b)});
  }
  return greatest;
}

double distance_to_box(const OrientedBox& box, const Vec3& point) {
  const Vec3 local = box.axes.transpose() * (point - box.centre);
  return (local - local.cwiseMax(-box.half_extents).cwiseMin(box.half_extents)).norm();
}

/// Distance of two segments: the crossing of their lines if it lies in both, else from an end to the other.
double distance_of_segments(const std::pair<Vec3, Vec3>& first, const std::pair<Vec3, Vec3>& second) {
  const auto from_point = [](const Vec3& point, const std::pair<Vec3, Vec3>& segment) {
    const Vec3 along = segment.second - segment.first;
    const double part = std::clamp((point - segment.first).dot(along) / along.squaredNorm(), 0.0, 1.0);
    return (segment.first + part * along - point).norm();
  };
  double least = std::min({from_point(first.first, second), from_point(first.second, second),
                           from_point(second.first, first), from_point(second.second, first)});
  const Vec3 p = first.second - first.first;
  const Vec3 q = second.second - second.first;
  const Vec3 normal = p.cross(q);
  const double square = normal.squaredNorm();
  if (square < 1e-12 * p.squaredNorm() * q.squaredNorm()) return least;
  const Vec3 apart = second.first - first.first;
  const double s = apart.cross(q).dot(normal) / square;
  const double t = apart.cross(p).dot(normal) / square;
  if (s > 0.0 && s < 1.0 && t > 0.0 && t < 1.0)
    least = std::min(least, std::abs(apart.dot(normal)) / std::sqrt(square));
  return least;
}

/// The distance of two disjoint boxes: two corners and a box, or two edges, are nearest.
double distance_of(const OrientedBox& a, const OrientedBox& b) {
  const Hull hull_a = hull_of(a);
  const Hull hull_b = hull_of(b);
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3& corner : hull_a.corners) least = std::min(least, distance_to_box(b, corner));
  for (const Vec3& corner : hull_b.corners) least = std::min(least, distance_to_box(a, corner));
  for (const auto& edge_a : hull_a.edges) {
    for (const auto& edge_b : hull_b.edges) least = std::min(least, distance_of_segments(edge_a, edge_b));
  }
  return least;
}

/// From plates to cubes. One throw a line: arguments are evaluated in no given order.
OrientedBox any_box(Random& random, double reach, double largest_angle) {
  const Vec3 size{random.between(0.01, 1.0), random.between(0.1, 1.0), random.between(0.3, 1.0)};
  const Vec3 centre = random.vector(-reach, reach);
  const Vec3 axis = random.vector(-1.0, 1.0);
  return turned(box_at(centre, size), axis, random.between(0.0, largest_angle));
}

OrientedBox aligned_box(Random& random, double reach) {
  const Vec3 centre = random.vector(-reach, reach);
  return box_at(centre, random.vector(0.05, 1.0));
}

/// What every contact must be, whatever the boxes.
void check_consistent(const ContactSet& contact, const OrientedBox& a, const OrientedBox& b, double margin) {
  CAPTURE(contact.count, contact.normal.transpose(), contact.axis.a, contact.axis.b);
  REQUIRE(contact.count >= 0);
  REQUIRE(contact.count <= 8);
  if (contact.count == 0) return;
  CHECK(contact.axis.kind != ContactAxis::Kind::none);
  CHECK(contact.normal.norm() == Approx(1.0).epsilon(1e-12));
  CHECK(contact.normal.dot(b.centre - a.centre) > -1e-12);
  for (int i = 0; i < contact.count; ++i) {
    const ContactPoint& point = contact.points[static_cast<std::size_t>(i)];
    CAPTURE(i, point.on_a.transpose(), point.on_b.transpose(), point.gap);
    CHECK(point.gap <= margin);
    CHECK(std::abs(contact.normal.dot(point.on_b - point.on_a) - point.gap) < 1e-9);
    // The points of faces lie along the faces' normal, which those of nearly parallel edges need not be.
    const double least_cosine = contact.axis.kind == ContactAxis::Kind::edges && i > 0 ? kParallelFaces : 1.0;
    CHECK(least_cosine * (point.on_b - point.on_a).norm() < std::abs(point.gap) + 2e-5);
    CHECK(std::abs(outside_of(a, point.on_a)) < 1e-9);
    CHECK(std::abs(outside_of(b, point.on_b)) < 1e-9);
  }
}

}  // namespace

TEST_CASE("box_box: points lie on both surfaces, and exchanging the boxes turns the contact round", "[core][box_box]") {
  Random random(1);
  int contacts = 0;
  for (int round = 0; round < 20000; ++round) {
    const OrientedBox a = any_box(random, 0.5, 1.5);
    const OrientedBox b = any_box(random, 0.5, 1.5);
    CAPTURE(round, a.centre.transpose(), b.centre.transpose(), a.half_extents.transpose(), b.half_extents.transpose());
    const ContactSet contact = contact_of(a, b, kMargin, kNoAxis);
    check_consistent(contact, a, b, kMargin);
    const ContactSet reverse = contact_of(b, a, kMargin, kNoAxis);
    check_consistent(reverse, b, a, kMargin);
    REQUIRE(reverse.count == contact.count);
    if (contact.count == 0) continue;
    ++contacts;
    CAPTURE(contact.normal.transpose(), reverse.normal.transpose(), least_gap(contact), least_gap(reverse));
    CHECK((contact.normal + reverse.normal).norm() < 1e-12);
    for (int i = 0; i < contact.count; ++i) {
      const ContactPoint& point = contact.points[static_cast<std::size_t>(i)];
      const auto same = [&](const ContactPoint& other) {
        return (other.on_a - point.on_b).norm() < 1e-9 && (other.on_b - point.on_a).norm() < 1e-9;
      };
      CAPTURE(i, point.on_a.transpose());
      CHECK(std::any_of(reverse.points.begin(), reverse.points.begin() + reverse.count, same));
    }
  }
  CAPTURE(contacts);
  CHECK(contacts > 5000);
}

TEST_CASE("box_box: how far contacts are looked for does not decide along what", "[core][box_box]") {
  Random random(7);
  int edges = 0;
  for (int round = 0; round < 20000; ++round) {
    const OrientedBox a = any_box(random, 0.5, 1.5);
    const OrientedBox b = any_box(random, 0.5, 1.5);
    const ContactSet near = contact_of(a, b, 0.01, kNoAxis);
    const double gap = least_gap(near);
    if (near.count == 0 || std::abs(gap) > 5e-3) continue;
    CAPTURE(round, gap);
    CHECK(contact_of(a, b, 0.3, kNoAxis).normal == near.normal);
    edges += near.axis.kind == ContactAxis::Kind::edges ? 1 : 0;
  }
  CHECK(edges > 20);
}

TEST_CASE("box_box: boxes further apart than the margin have no contact", "[core][box_box]") {
  constexpr double kWide = 0.05;
  Random random(2);
  int apart = 0;
  int within = 0;
  for (int round = 0; round < 20000; ++round) {
    const OrientedBox a = any_box(random, 0.6, 1.5);
    const OrientedBox b = any_box(random, 0.6, 1.5);
    if (greatest_separation(a, b) <= 0.0) continue;
    const double distance = distance_of(a, b);
    const ContactSet contact = contact_of(a, b, kWide, kNoAxis);
    CAPTURE(round, distance, contact.count, contact.normal.transpose(), least_gap(contact));
    check_consistent(contact, a, b, kWide);
    if (distance > kWide) {
      ++apart;
      CHECK(contact.count == 0);
    } else if (contact.count > 0) {
      ++within;
      // A gap is measured along the normal: at least the separation along it, at most the way between the points.
      CHECK(least_gap(contact) >= separation_along(contact.normal, hull_of(a), hull_of(b)) - 1e-9);
      CHECK(least_gap(contact) >= distance - 2e-5);
    }
  }
  CAPTURE(apart, within);
  CHECK(apart > 3000);
  CHECK(within > 300);
}

TEST_CASE("box_box: boxes that overlap are parted along the axis of least overlap", "[core][box_box]") {
  // Handicap of edges, hysteresis and ties together: the axis may be worse than the best by this.
  constexpr double kTolerated = 90e-6;
  Random random(3);
  int overlapping = 0;
  for (int round = 0; round < 20000; ++round) {
    // Every other pair is nearly aligned.
    const double angle = round % 2 == 0 ? 1.5 : 0.004;
    const OrientedBox a = any_box(random, 0.4, angle);
    const OrientedBox b = any_box(random, 0.4, angle);
    const double separation = greatest_separation(a, b);
    if (separation > -1e-4) continue;
    ++overlapping;
    const ContactSet contact = contact_of(a, b, kMargin, kNoAxis);
    CAPTURE(round, separation, contact.count, contact.normal.transpose(), least_gap(contact));
    check_consistent(contact, a, b, kMargin);
    REQUIRE(contact.count > 0);
    // Edges of nearly aligned boxes are left out: their faces then overlap by an angle's worth more.
    CHECK(least_gap(contact) > separation - (angle < 0.01 ? 5e-3 : kTolerated));
    CHECK(least_gap(contact) >= separation_along(contact.normal, hull_of(a), hull_of(b)) - 1e-9);
    CHECK(least_gap(contact) < 0.0);
    // What faces overlap beyond each other's sides needs no separation.
    OrientedBox parted = b;
    parted.centre -= least_gap(contact) * contact.normal;
    CHECK(greatest_separation(a, parted) > -kTolerated);
  }
  CAPTURE(overlapping);
  CHECK(overlapping > 5000);
}

TEST_CASE("box_box: a contact moves with its boxes", "[core][box_box]") {
  Random random(4);
  for (int round = 0; round < 2000; ++round) {
    OrientedBox a = any_box(random, 0.4, 1.5);
    OrientedBox b = any_box(random, 0.4, 1.5);
    const ContactSet here = contact_of(a, b, kMargin, kNoAxis);
    const Vec3 shift = random.vector(-20.0, 20.0);
    a.centre += shift;
    b.centre += shift;
    const ContactSet there = contact_of(a, b, kMargin, kNoAxis);
    CAPTURE(round, shift.transpose(), here.count, there.count);
    REQUIRE(here.count == there.count);
    CHECK((here.normal - there.normal).norm() < 1e-9);
    for (std::size_t i = 0; i < static_cast<std::size_t>(here.count); ++i) {
      CHECK((here.points[i].on_a + shift - there.points[i].on_a).norm() < 1e-9);
      CHECK(std::abs(here.points[i].gap - there.points[i].gap) < 1e-9);
    }
  }
}

TEST_CASE("box_box: the path of aligned boxes agrees with that of rotated ones", "[core][box_box]") {
  Random random(5);
  int contacts = 0;
  for (int round = 0; round < 5000; ++round) {
    const OrientedBox a = aligned_box(random, 0.4);
    const OrientedBox b = aligned_box(random, 0.4);
    OrientedBox rotated = b;
    rotated.aligned = false;
    const ContactSet aligned = contact_of(a, b, kMargin, kNoAxis);
    const ContactSet general = contact_of(a, rotated, kMargin, kNoAxis);
    CAPTURE(round, aligned.count, general.count, aligned.normal.transpose(), general.normal.transpose());
    REQUIRE(aligned.count == general.count);
    if (aligned.count == 0) continue;
    ++contacts;
    CHECK(aligned.normal == general.normal);
    const ContactSet reverse = contact_of(b, a, kMargin, kNoAxis);
    CHECK(reverse.normal == -aligned.normal);
    CHECK(reverse.points[0].gap == aligned.points[0].gap);
    CHECK(reverse.points[0].on_b == aligned.points[0].on_a);
    CHECK(least_gap(aligned) == Approx(least_gap(general)).margin(1e-15));
    for (std::size_t i = 0; i < 4; ++i) {
      const auto same = [&](const ContactPoint& other) { return (other.on_a - aligned.points[i].on_a).norm() < 1e-14; };
      CHECK(std::any_of(general.points.begin(), general.points.begin() + 4, same));
    }
  }
  CAPTURE(contacts);
  CHECK(contacts > 1000);
}

}  // namespace box_box_random_test
