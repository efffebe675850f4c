#include "core/native/collision/box_box.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/native/collision/clipping.hpp"
#include "core/native/collision/separating_axis.hpp"
#include "core/native/constants.hpp"

namespace holdfast::internal::native {

namespace {

/// Signs of the corners of a rectangle, around it.
constexpr std::array<std::array<double, 2>, 4> kAround = {{{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}};

double lower(const OrientedBox& box, int k) { return box.centre[k] - box.half_extents[k]; }
double upper(const OrientedBox& box, int k) { return box.centre[k] + box.half_extents[k]; }

/// Distance of two faces along axis k, by their coordinates: boxes that share a coordinate touch exactly.
double aligned_gap(const OrientedBox& a, const OrientedBox& b, int k) {
  return b.centre[k] >= a.centre[k] ? lower(b, k) - upper(a, k) : lower(a, k) - upper(b, k);
}

/// The axis of a face, of either box: the faces of aligned boxes are parallel.
int face_axis(const ContactAxis& axis) {
  if (axis.kind == ContactAxis::Kind::face_of_a) return axis.a;
  return axis.kind == ContactAxis::Kind::face_of_b ? axis.b : -1;
}

ContactSet aligned_contact(const OrientedBox& a, const OrientedBox& b, double margin, const ContactAxis& previous) {
  ContactSet contact;
  const Vec3 gap(aligned_gap(a, b, 0), aligned_gap(a, b, 1), aligned_gap(a, b, 2));
  // Written so that a position that is not a number is no contact.
  if (!(gap[0] <= margin && gap[1] <= margin && gap[2] <= margin)) return contact;

  Vec3 score = gap;
  if (const int kept = face_axis(previous); kept >= 0) score[kept] += kAxisPreference;
  int k = score[1] > score[0] ? 1 : 0;
  if (score[2] > score[k]) k = 2;

  const int u = (k + 1) % 3;
  const int v = (k + 2) % 3;
  const double low_u = std::max(lower(a, u), lower(b, u));
  const double high_u = std::min(upper(a, u), upper(b, u));
  const double low_v = std::max(lower(a, v), lower(b, v));
  const double high_v = std::min(upper(a, v), upper(b, v));
  if (high_u - low_u < kContactTolerance || high_v - low_v < kContactTolerance) return contact;

  contact.widths = {{{high_u - low_u, u}, {high_v - low_v, v}}};
  const bool b_above = b.centre[k] >= a.centre[k];
  contact.normal[k] = b_above ? 1.0 : -1.0;
  contact.axis = {ContactAxis::Kind::face_of_a, k, 0};
  contact.count = 4;
  for (std::size_t i = 0; i < 4; ++i) {
    ContactPoint& point = contact.points[i];
    point.on_a[u] = point.on_b[u] = kAround[i][0] < 0.0 ? low_u : high_u;
    point.on_a[v] = point.on_b[v] = kAround[i][1] < 0.0 ? low_v : high_v;
    point.on_a[k] = b_above ? upper(a, k) : lower(a, k);
    point.on_b[k] = b_above ? lower(b, k) : upper(b, k);
    point.gap = gap[k];
  }
  return contact;
}

/// The axis of the container that a normal is exactly along, or -1.
int container_axis(const Vec3& normal) {
  for (int k = 0; k < 3; ++k) {
    if (std::abs(normal[k]) == 1.0) return k;
  }
  return -1;
}

/// A side across axis k with an aligned box: the coordinates are those of the box, and only the gap is rounded.
ContactSet aligned_contact(const HalfSpace& a, const OrientedBox& b, int k, double margin) {
  ContactSet contact;
  const double inward = a.normal[k];
  const double face = inward > 0.0 ? lower(b, k) : upper(b, k);
  const double gap = inward * face - a.offset;
  if (!(gap <= margin)) return contact;
  const int u = (k + 1) % 3;
  const int v = (k + 2) % 3;
  contact.normal = a.normal;
  contact.axis = {ContactAxis::Kind::face_of_a, 0, k};
  contact.count = 4;
  for (std::size_t i = 0; i < 4; ++i) {
    ContactPoint& point = contact.points[i];
    point.on_a[u] = point.on_b[u] = kAround[i][0] < 0.0 ? lower(b, u) : upper(b, u);
    point.on_a[v] = point.on_b[v] = kAround[i][1] < 0.0 ? lower(b, v) : upper(b, v);
    point.on_a[k] = inward * a.offset;
    point.on_b[k] = face;
    point.gap = gap;
  }
  return contact;
}

/// Whether two points are near enough to be one.
bool are_one(const ContactPoint& first, const ContactPoint& second) {
  return (first.on_a - second.on_a).squaredNorm() + (first.on_b - second.on_b).squaredNorm() <= kSamePoint * kSamePoint;
}

/// Whether the point of two edges is one of several points of the faces' contact. The faces' separation counts overlap
/// beyond each other's sides, which is no part of the contact, and so two edges may seem better. A box that has sunk a
/// little into the edge that it lies on has that edge in its face, and needs both of its ends: with the one point of
/// two edges it would be held at one end, sink at the other, and so on from step to step. Points farther away do not
/// count, since the margin for which contacts are found must not decide.
bool has_point_of(const ContactSet& faces, const ContactSet& edges) {
  const ContactPoint& wanted = edges.points[0];
  const auto end = faces.points.begin() + faces.count;
  const auto is_beside = [&](const ContactPoint& point) { return point.gap <= std::max(0.0, wanted.gap) + kSamePoint; };
  return std::count_if(faces.points.begin(), end, is_beside) > 1 &&
         std::any_of(faces.points.begin(), end, [&](const ContactPoint& point) {
           return std::abs(point.gap - wanted.gap) <= kAxisPreference && are_one(point, wanted);
         });
}

/// Adds the points of the faces' contact to that of two edges. Between faces that are nearly parallel the edges hold
/// the boxes at one point only: in a step they may turn about it until other corners overlap.
void add_points_of(const ContactSet& faces, double margin, ContactSet& edges) {
  if (faces.count == 0 || edges.normal.dot(faces.normal) < kParallelFaces) return;
  const ContactPoint edge = edges.points[0];
  for (std::size_t i = 0; i < static_cast<std::size_t>(faces.count); ++i) {
    ContactPoint point = faces.points[i];
    point.gap = edges.normal.dot(point.on_b - point.on_a);
    // What overlaps more than the edges is the faces' overlap, which is not the least.
    if (edges.count == static_cast<int>(edges.points.size()) || point.gap > margin || point.gap < edge.gap - kTouch ||
        are_one(point, edge))
      continue;
    edges.points[static_cast<std::size_t>(edges.count++)] = point;
  }
}

}  // namespace

double ContactSet::nearest_gap() const {
  double nearest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < count; ++i) nearest = std::min(nearest, points[static_cast<std::size_t>(i)].gap);
  return nearest;
}

ContactSet contact_of(const OrientedBox& a, const OrientedBox& b, double margin, const ContactAxis& previous) {
  if (a.aligned && b.aligned) return aligned_contact(a, b, margin, previous);
  const RelativePose pose = relative_pose(a, b);
  const std::optional<AxisChoice> choice = choose_axis(a, b, pose, margin, previous);
  if (!choice) return {};
  const ContactSet faces = face_contact(a, b, pose, choice->face, margin);
  if (choice->axis.kind != ContactAxis::Kind::edges) return faces;
  ContactSet edges = edge_contact(a, b, pose, choice->axis);
  if (edges.count == 0 || has_point_of(faces, edges)) return faces;
  add_points_of(faces, margin, edges);
  return edges;
}

ContactSet contact_of(const HalfSpace& a, const OrientedBox& b, double margin) {
  if (b.aligned) {
    if (const int k = container_axis(a.normal); k >= 0) return aligned_contact(a, b, k, margin);
  }
  ContactSet contact;
  const Vec3& n = a.normal;
  // How much each half axis of the box rises from the side.
  Vec3 rise;
  Vec3 cosine;
  for (int j = 0; j < 3; ++j) {
    cosine[j] = n[0] * b.axes(0, j) + n[1] * b.axes(1, j) + n[2] * b.axes(2, j);
    rise[j] = b.half_extents[j] * cosine[j];
  }
  const double height = (n[0] * b.centre[0] + n[1] * b.centre[1] + n[2] * b.centre[2]) - a.offset;
  if (!(height - (std::abs(rise[0]) + std::abs(rise[1]) + std::abs(rise[2])) <= margin)) return contact;

  // Of equally inclined faces the first one: they share their lowest corners.
  int m = std::abs(cosine[1]) > std::abs(cosine[0]) ? 1 : 0;
  if (std::abs(cosine[2]) > std::abs(cosine[m])) m = 2;
  const int p = (m + 1) % 3;
  const int q = (m + 2) % 3;
  const double side = cosine[m] > 0.0 ? -1.0 : 1.0;
  const Vec3 face = b.centre + side * b.half_extents[m] * b.axes.col(m);
  const Vec3 along_p = b.half_extents[p] * b.axes.col(p);
  const Vec3 along_q = b.half_extents[q] * b.axes.col(q);
  contact.normal = n;
  contact.axis = {ContactAxis::Kind::face_of_a, 0, m};
  for (const auto& [sp, sq] : kAround) {
    const double gap = height + side * rise[m] + (sp * rise[p] + sq * rise[q]);
    if (!(gap <= margin)) continue;
    ContactPoint& point = contact.points[static_cast<std::size_t>(contact.count++)];
    point.on_b = face + (sp * along_p + sq * along_q);
    point.on_a = point.on_b - gap * n;
    point.gap = gap;
  }
  return contact;
}

}  // namespace holdfast::internal::native
