#include "core/native/collision/separating_axis.hpp"

#include <cmath>
#include <limits>

#include "core/native/constants.hpp"

namespace holdfast::internal::native {

namespace {

/// The best axis of a group so far, and the score to beat.
struct Candidate {
  double score = std::numeric_limits<double>::lowest();
  ContactAxis axis;

  void offer(double separation, const ContactAxis& offered, const ContactAxis& previous) {
    const double offered_score = offered == previous ? separation + kAxisPreference : separation;
    if (offered_score > score) {
      score = offered_score;
      axis = offered;
    }
  }
};

double dot_of_columns(const Mat3& m, int i, const Mat3& n, int j) {
  return m(0, i) * n(0, j) + m(1, i) * n(1, j) + m(2, i) * n(2, j);
}

double dot_of_column(const Mat3& m, int i, const Vec3& v) { return m(0, i) * v[0] + m(1, i) * v[1] + m(2, i) * v[2]; }

/// Whether the axes of a and b are the same, up to order, sign and a small angle.
bool nearly_aligned(const Mat3& reach) {
  for (int j = 0; j < 3; ++j) {
    if (reach(0, j) <= kNearlyAligned && reach(1, j) <= kNearlyAligned && reach(2, j) <= kNearlyAligned) return false;
  }
  return true;
}

bool offer_faces(const OrientedBox& a, const OrientedBox& b, const RelativePose& pose, double margin,
                 const ContactAxis& previous, Candidate& of_a, Candidate& of_b) {
  const Mat3& reach = pose.abs_a_from_b;
  const Vec3& ha = a.half_extents;
  const Vec3& hb = b.half_extents;
  for (int i = 0; i < 3; ++i) {
    const double radius = hb[0] * reach(i, 0) + hb[1] * reach(i, 1) + hb[2] * reach(i, 2);
    const double separation = std::abs(pose.in_a[i]) - (ha[i] + radius);
    // Written so that a pose that is not a number is no contact.
    if (!(separation <= margin)) return false;
    of_a.offer(separation, {ContactAxis::Kind::face_of_a, i, 0}, previous);
  }
  for (int j = 0; j < 3; ++j) {
    const double radius = ha[0] * reach(0, j) + ha[1] * reach(1, j) + ha[2] * reach(2, j);
    const double separation = std::abs(pose.in_b[j]) - (hb[j] + radius);
    if (!(separation <= margin)) return false;
    of_b.offer(separation, {ContactAxis::Kind::face_of_b, 0, j}, previous);
  }
  return true;
}

bool offer_edges(const OrientedBox& a, const OrientedBox& b, const RelativePose& pose, double margin,
                 const ContactAxis& previous, Candidate& of_edges) {
  const Mat3& r = pose.a_from_b;
  const Mat3& reach = pose.abs_a_from_b;
  const Vec3& ha = a.half_extents;
  const Vec3& hb = b.half_extents;
  for (int i = 0; i < 3; ++i) {
    const int i1 = (i + 1) % 3;
    const int i2 = (i + 2) % 3;
    for (int j = 0; j < 3; ++j) {
      // The sum of the two other components: 1 - r(i, j)² would cancel where the edges are nearly parallel.
      const double square = r(i1, j) * r(i1, j) + r(i2, j) * r(i2, j);
      if (square < kRounding) continue;
      const int j1 = (j + 1) % 3;
      const int j2 = (j + 2) % 3;
      const double distance = std::abs(pose.in_a[i2] * r(i1, j) - pose.in_a[i1] * r(i2, j));
      const double radius_a = ha[i1] * reach(i2, j) + ha[i2] * reach(i1, j);
      const double radius_b = hb[j1] * reach(i, j2) + hb[j2] * reach(i, j1);
      const double apart = distance - (radius_a + radius_b);
      // An overlap grows when divided by the product's length: most pairs of edges need no square root.
      if (apart < 0.0 && apart + kAxisPreference <= of_edges.score) continue;
      const double separation = apart / std::sqrt(square);
      if (separation > margin) return false;
      of_edges.offer(separation, {ContactAxis::Kind::edges, i, j}, previous);
    }
  }
  return true;
}

double face_area(const OrientedBox& box, int axis) {
  return box.half_extents[(axis + 1) % 3] * box.half_extents[(axis + 2) % 3];
}

/// Near ties are decided by the boxes rather than by their order, so that exchanging the boxes changes nothing.
const Candidate& better_face(const OrientedBox& a, const OrientedBox& b, const Candidate& of_a, const Candidate& of_b) {
  if (std::abs(of_a.score - of_b.score) > kContactTolerance) return of_a.score > of_b.score ? of_a : of_b;
  return face_area(b, of_b.axis.b) > face_area(a, of_a.axis.a) ? of_b : of_a;
}

}  // namespace

RelativePose relative_pose(const OrientedBox& a, const OrientedBox& b) {
  const Vec3 apart = b.centre - a.centre;
  RelativePose pose;
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) {
      pose.a_from_b(i, j) = dot_of_columns(a.axes, i, b.axes, j);
      pose.abs_a_from_b(i, j) = std::abs(pose.a_from_b(i, j));
    }
    pose.in_a[j] = dot_of_column(a.axes, j, apart);
    pose.in_b[j] = dot_of_column(b.axes, j, apart);
  }
  return pose;
}

std::optional<AxisChoice> choose_axis(const OrientedBox& a, const OrientedBox& b, const RelativePose& pose,
                                      double margin, const ContactAxis& previous) {
  Candidate of_a, of_b;
  if (!offer_faces(a, b, pose, margin, previous, of_a, of_b)) return std::nullopt;
  const Candidate& of_faces = better_face(a, b, of_a, of_b);
  Candidate of_edges{.score = of_faces.score + kAxisPreference};
  if (!nearly_aligned(pose.abs_a_from_b) && !offer_edges(a, b, pose, margin, previous, of_edges)) return std::nullopt;
  const bool edges = of_edges.axis.kind == ContactAxis::Kind::edges;
  return AxisChoice{edges ? of_edges.axis : of_faces.axis, of_faces.axis};
}

}  // namespace holdfast::internal::native
