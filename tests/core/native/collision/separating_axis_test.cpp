#include "core/native/collision/separating_axis.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "core/native/collision/boxes.hpp"
#include "core/native/constants.hpp"
#include "random.hpp"

namespace separating_axis_test {

using namespace holdfast::internal;
using namespace holdfast::internal::native;

namespace {

OrientedBox random_box(Random& random, const Vec3& centre) {
  OrientedBox box = box_at(centre, {random.between(0.1, 1), random.between(0.1, 1), random.between(0.1, 1)});
  box.axes = random.rotation().toRotationMatrix();
  box.aligned = false;
  return box;
}

std::optional<AxisChoice> choose(const OrientedBox& a, const OrientedBox& b, double margin,
                                 const ContactAxis& previous = {}) {
  return choose_axis(a, b, relative_pose(a, b), margin, previous);
}

/// Separation along a direction, from the corners of both boxes.
double separation_along(const OrientedBox& a, const OrientedBox& b, const Vec3& direction) {
  double highest_a = -std::numeric_limits<double>::infinity(), lowest_a = -highest_a;
  double highest_b = highest_a, lowest_b = lowest_a;
  for (int bits = 0; bits < 8; ++bits) {
    const Vec3 corner((bits & 1) != 0 ? 1 : -1, (bits & 2) != 0 ? 1 : -1, (bits & 4) != 0 ? 1 : -1);
    const double of_a = direction.dot(Vec3(a.centre + a.axes * a.half_extents.cwiseProduct(corner)));
    const double of_b = direction.dot(Vec3(b.centre + b.axes * b.half_extents.cwiseProduct(corner)));
    highest_a = std::max(highest_a, of_a), lowest_a = std::min(lowest_a, of_a);
    highest_b = std::max(highest_b, of_b), lowest_b = std::min(lowest_b, of_b);
  }
  return std::max(lowest_b - highest_a, lowest_a - highest_b);
}

Vec3 direction_of(const OrientedBox& a, const OrientedBox& b, const ContactAxis& axis) {
  if (axis.kind == ContactAxis::Kind::face_of_a) return a.axes.col(axis.a);
  if (axis.kind == ContactAxis::Kind::face_of_b) return b.axes.col(axis.b);
  return Vec3(a.axes.col(axis.a)).cross(Vec3(b.axes.col(axis.b))).normalized();
}

}  // namespace

TEST_CASE("separating_axis: the relative pose is that of the frames", "[core][separating_axis]") {
  Random random(5);
  const OrientedBox a = random_box(random, {0.2, -0.1, 0.4});
  const OrientedBox b = random_box(random, {0.5, 0.3, -0.2});
  const RelativePose pose = relative_pose(a, b);
  CHECK((pose.a_from_b - a.axes.transpose() * b.axes).norm() < 1e-15);
  CHECK((pose.in_a - a.axes.transpose() * (b.centre - a.centre)).norm() < 1e-15);
  CHECK((pose.in_b - b.axes.transpose() * (b.centre - a.centre)).norm() < 1e-15);
  CHECK(pose.abs_a_from_b == pose.a_from_b.cwiseAbs());
}

// The independent reference: all 15 axes, each by the corners of both boxes.
TEST_CASE("separating_axis: no axis separates better than the one that is chosen", "[core][separating_axis]") {
  Random random(9);
  constexpr double kMargin = 0.01;
  int apart = 0, faces = 0, edges = 0;
  for (int i = 0; i < 3000; ++i) {
    const OrientedBox a = random_box(random, Vec3::Zero());
    const OrientedBox b =
        random_box(random, {random.between(-0.7, 0.7), random.between(-0.7, 0.7), random.between(-0.7, 0.7)});
    double best_face = -std::numeric_limits<double>::infinity(), best = best_face;
    for (int k = 0; k < 3; ++k) {
      best_face = std::max({best_face, separation_along(a, b, a.axes.col(k)), separation_along(a, b, b.axes.col(k))});
      for (int j = 0; j < 3; ++j)
        best = std::max(best, separation_along(a, b, direction_of(a, b, {ContactAxis::Kind::edges, k, j})));
    }
    best = std::max(best, best_face);
    const std::optional<AxisChoice> choice = choose(a, b, kMargin);
    CAPTURE(i, best, best_face);
    if (std::abs(best - kMargin) > 1e-12) REQUIRE(choice.has_value() == (best <= kMargin));
    if (!choice) {
      ++apart;
      continue;
    }
    const bool is_edge = choice->axis.kind == ContactAxis::Kind::edges;
    ++(is_edge ? edges : faces);
    REQUIRE(separation_along(a, b, direction_of(a, b, choice->face)) >= best_face - kContactTolerance - 1e-12);
    const double chosen = separation_along(a, b, direction_of(a, b, choice->axis));
    REQUIRE(chosen >= best - kAxisPreference - kContactTolerance - 1e-12);
    if (is_edge) REQUIRE(chosen >= best_face + kAxisPreference - kContactTolerance - 1e-12);
  }
  CAPTURE(apart, faces, edges);
  CHECK(std::min({apart, faces, edges}) > 100);
}

TEST_CASE("separating_axis: the axis of the step before wins by the hysteresis, and no more",
          "[core][separating_axis]") {
  const OrientedBox a = as_rotated(box_at({0, 0, 0}, {1, 1, 1}));
  const ContactAxis along_x{ContactAxis::Kind::face_of_a, 0, 0};
  for (const auto& [better, wins] : {std::pair(0.5 * kAxisPreference, true), std::pair(2.0 * kAxisPreference, false)}) {
    // The boxes overlap by 1 mm along x, and by less along y.
    const OrientedBox b = as_rotated(box_at({0.999, 0.999 + better, 0}, {1, 1, 1}));
    CAPTURE(better);
    const std::optional<AxisChoice> choice = choose(a, b, 0.0, along_x);
    REQUIRE(choice);
    CHECK((choice->axis == along_x) == wins);
  }
}

TEST_CASE("separating_axis: of parallel faces the larger one is the reference, whichever box comes first",
          "[core][separating_axis]") {
  const OrientedBox large = as_rotated(box_at({0, 0, 0}, {2, 2, 1}));
  const OrientedBox small = as_rotated(box_at({0.1, 0.2, 0.75}, {0.5, 0.5, 0.5}));
  CHECK(choose(large, small, 1e-3)->axis.kind == ContactAxis::Kind::face_of_a);
  CHECK(choose(small, large, 1e-3)->axis.kind == ContactAxis::Kind::face_of_b);
}

}  // namespace separating_axis_test
