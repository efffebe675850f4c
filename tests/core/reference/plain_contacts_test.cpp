#include "core/reference/plain_contacts.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <tuple>

namespace plain_contacts_test {

using namespace holdfast::internal;
using namespace holdfast::internal::plain;

namespace {

constexpr double kMargin = 1e-3;  ///< m

Block block_at(const Vec3& centre, const Vec3& size) { return {centre, 0.5 * size}; }

Block turned(Block block, double degrees, const Vec3& about) {
  block.axes = Eigen::AngleAxisd(degrees * 0.017453292519943295, about.normalized()).toRotationMatrix() * block.axes;
  return block;
}

/// Points sorted by their coordinates, so that a test can refer to them by index.
std::vector<ContactPoint> sorted(std::vector<ContactPoint> points) {
  const auto key = [](const ContactPoint& point) {
    const Vec3 rounded = (point.position * 1e6).array().round();
    return std::make_tuple(rounded.x(), rounded.y(), rounded.z());
  };
  std::sort(points.begin(), points.end(), [&](const auto& p, const auto& q) { return key(p) < key(q); });
  return points;
}

void check_point(const ContactPoint& point, const Vec3& position, const Vec3& normal, double gap) {
  CAPTURE(point.position.transpose(), point.normal.transpose(), point.gap);
  CHECK((point.position - position).norm() < 1e-12);
  CHECK((point.normal - normal).norm() < 1e-12);
  CHECK(point.gap == Approx(gap).margin(1e-12));
}

}  // namespace

TEST_CASE("plain_contacts: a block on the floor touches at its four lower corners", "[core][plain_contacts]") {
  const Block block = block_at({2, 3, 0.5 - 4e-6}, {1, 2, 1});
  const auto points = sorted(contact_points(HalfSpace{}, block, kMargin));
  REQUIRE(points.size() == 4);
  check_point(points[0], {1.5, 2, -2e-6}, Vec3::UnitZ(), -4e-6);
  check_point(points[3], {2.5, 4, -2e-6}, Vec3::UnitZ(), -4e-6);
  CHECK(contact_points(HalfSpace{}, block_at({2, 3, 0.6}, {1, 2, 1}), kMargin).empty());
}

TEST_CASE("plain_contacts: a block on its edge touches at two corners, on its corner at one",
          "[core][plain_contacts]") {
  const double half_diagonal = std::sqrt(0.5);
  const Block on_edge = turned(block_at({0, 0, half_diagonal}, {1, 1, 1}), 45, Vec3::UnitY());
  const auto two = sorted(contact_points(HalfSpace{}, on_edge, kMargin));
  REQUIRE(two.size() == 2);
  check_point(two[0], {0, -0.5, 0}, Vec3::UnitZ(), 0);
  check_point(two[1], {0, 0.5, 0}, Vec3::UnitZ(), 0);

  // The axis (−1, 1, 0) brings the corner (½, ½, −½) under the middle.
  const Block on_corner = turned(block_at({0, 0, std::sqrt(0.75)}, {1, 1, 1}),
                                 90 - std::asin(std::sqrt(1.0 / 3)) / 0.017453292519943295, Vec3(-1, 1, 0));
  const auto one = contact_points(HalfSpace{}, on_corner, kMargin);
  REQUIRE(one.size() == 1);
  check_point(one[0], {0, 0, 0}, Vec3::UnitZ(), 0);
}

TEST_CASE("plain_contacts: two stacked blocks touch at the corners of their common rectangle",
          "[core][plain_contacts]") {
  const Block lower = block_at({0, 0, 0.5}, {2, 2, 1});
  const Block upper = block_at({0.75, 0.5, 1.5005}, {1, 2, 1});
  const auto points = sorted(contact_points(lower, upper, kMargin));
  REQUIRE(points.size() == 4);
  check_point(points[0], {0.25, -0.5, 1.00025}, Vec3::UnitZ(), 5e-4);
  check_point(points[1], {0.25, 1, 1.00025}, Vec3::UnitZ(), 5e-4);
  check_point(points[2], {1, -0.5, 1.00025}, Vec3::UnitZ(), 5e-4);
  check_point(points[3], {1, 1, 1.00025}, Vec3::UnitZ(), 5e-4);
  // Swapping the blocks gives the same points and the opposite normal.
  const auto swapped = sorted(contact_points(upper, lower, kMargin));
  REQUIRE(swapped.size() == 4);
  for (std::size_t i = 0; i < 4; ++i) check_point(swapped[i], points[i].position, -Vec3::UnitZ(), 5e-4);
  CHECK(contact_points(lower, upper, 4e-4).empty());
}

TEST_CASE("plain_contacts: two squares at 45 degrees touch at the corners of an octagon", "[core][plain_contacts]") {
  const Block lower = block_at({0, 0, 0.5}, {2, 2, 1});
  const Block upper = turned(block_at({0, 0, 1.5}, {2, 2, 1}), 45, Vec3::UnitZ());
  const auto points = sorted(contact_points(lower, upper, kMargin));
  REQUIRE(points.size() == 8);
  const double short_leg = std::sqrt(2.0) - 1;
  check_point(points[0], {-1, -short_leg, 1}, Vec3::UnitZ(), 0);
  check_point(points[7], {1, short_leg, 1}, Vec3::UnitZ(), 0);
}

TEST_CASE("plain_contacts: a tilted block touches another with its edge", "[core][plain_contacts]") {
  const Block lower = block_at({0, 0, 0.5}, {2, 2, 1});
  const Block upper = turned(block_at({0, 0, 1 + std::sqrt(0.5)}, {1, 1, 1}), 45, Vec3::UnitY());
  const auto points = sorted(contact_points(lower, upper, kMargin));
  REQUIRE(points.size() == 2);
  check_point(points[0], {0, -0.5, 1}, Vec3::UnitZ(), 0);
  check_point(points[1], {0, 0.5, 1}, Vec3::UnitZ(), 0);
}

TEST_CASE("plain_contacts: crossing edges touch in one point", "[core][plain_contacts]") {
  // Two bars standing on an edge, one along x and one along y on top of it: the normal is z, which is no face normal of
  // either.
  const double half_diagonal = std::sqrt(0.5);
  const Block lower = turned(block_at({0, 0, 0}, {4, 1, 1}), 45, Vec3::UnitX());
  const Block upper = turned(block_at({0.25, 0.5, 2 * half_diagonal + 2e-4}, {1, 4, 1}), 45, Vec3::UnitY());
  const auto points = contact_points(lower, upper, kMargin);
  REQUIRE(points.size() == 1);
  check_point(points[0], {0.25, 0, half_diagonal + 1e-4}, Vec3::UnitZ(), 2e-4);
  const auto swapped = contact_points(upper, lower, kMargin);
  REQUIRE(swapped.size() == 1);
  check_point(swapped[0], {0.25, 0, half_diagonal + 1e-4}, -Vec3::UnitZ(), 2e-4);
}

TEST_CASE("plain_contacts: edges that cross almost in a face's plane give that face's points",
          "[core][plain_contacts]") {
  // The upper block leans by half a degree about a diagonal. Its lowest corner is outside the lower block, so that
  // edges touch edges. No point penetrates, and none is farther than the margin.
  const Block lower = block_at({0, 0, 0.5}, {1, 1, 1});
  Block upper = turned(block_at({0.1, 0.1, 1.6}, {1, 1, 1}), 0.5, Vec3(-1, 1, 0));
  upper = turned(upper, 7, Vec3::UnitZ());
  // Lower it until it touches.
  double lowest = 1.0;
  for (const ContactPoint& point : contact_points(lower, upper, 1.0)) lowest = std::min(lowest, point.gap);
  upper.centre.z() -= lowest;
  const auto points = contact_points(lower, upper, kMargin);
  REQUIRE_FALSE(points.empty());
  for (const ContactPoint& point : points) {
    CAPTURE(point.position.transpose(), point.gap);
    CHECK(point.gap > -1e-12);
    CHECK(point.normal.z() > 0.9999);
    CHECK(point.position.head<2>().cwiseAbs().maxCoeff() < 0.5 + 1e-4);
  }
}

TEST_CASE("plain_contacts: blocks that share an edge or a corner do not touch", "[core][plain_contacts]") {
  const Block block = block_at({0, 0, 0}, {1, 1, 1});
  for (const double overlap : {-5e-6, 0.0, 5e-6}) {
    const double across = 1 - overlap;
    CAPTURE(overlap);
    CHECK(contact_points(block, block_at({across, 0, 1}, {1, 1, 1}), kMargin).empty());
    CHECK(contact_points(block, block_at({across, 0.3, across}, {1, 1, 1}), kMargin).empty());
    CHECK(contact_points(block, block_at({across, across, across}, {1, 1, 1}), kMargin).empty());
  }
  // With a larger common part of a face they touch.
  CHECK(contact_points(block, block_at({1 - 1e-3, 0, 1}, {1, 1, 1}), kMargin).size() == 4);
}

TEST_CASE("plain_contacts: contacts of two blocks do not depend on their common pose", "[core][plain_contacts]") {
  const Block lower = block_at({0, 0, 0.5}, {2, 2, 1});
  const Block upper = turned(block_at({0.7, 0.5, 1.5}, {1, 2, 1}), 20, Vec3::UnitZ());
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const auto moved = [&](const Block& block) {
    return Block{turn * block.centre + Vec3(4, 5, 6), block.half_extents, turn * block.axes};
  };
  const auto here = contact_points(lower, upper, kMargin);
  const auto there = contact_points(moved(lower), moved(upper), kMargin);
  REQUIRE(here.size() >= 4);
  REQUIRE(there.size() == here.size());
  for (std::size_t i = 0; i < here.size(); ++i)
    check_point(there[i], turn * here[i].position + Vec3(4, 5, 6), turn * here[i].normal, here[i].gap);
}

}  // namespace plain_contacts_test
