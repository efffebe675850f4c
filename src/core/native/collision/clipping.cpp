#include "core/native/collision/clipping.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "core/native/constants.hpp"

namespace holdfast::internal::native {

namespace {

/// The reference face, its box, and the other box in the frame of that box.
struct Reference {
  const OrientedBox& box;
  const OrientedBox& other;
  Mat3 axes;       ///< of the other box, in this box's frame
  Vec3 centre;     ///< of the other box, in this box's frame, m
  int k, u, v;     ///< axes of the box: the face's normal and its two sides
  double outward;  ///< ±1: the side of the box that the face is on
};

/// A corner of the incident face in the frame of the reference face.
struct Corner {
  double u, v, gap;
};

/// A convex polygon: 4 corners, and at most one more for each of the 4 lines that it is cut by.
struct Polygon {
  std::array<Corner, 8> corners;
  std::size_t count = 0;

  // Rounding may bend an edge that lies in a clipping line by the last bit, and cut it twice.
  void add(const Corner& corner) {
    if (count < corners.size()) corners[count++] = corner;
  }
};

Reference reference_of(const OrientedBox& a, const OrientedBox& b, const RelativePose& pose, const ContactAxis& axis) {
  const bool of_a = axis.kind == ContactAxis::Kind::face_of_a;
  const int k = of_a ? axis.a : axis.b;
  const int u = (k + 1) % 3;
  const int v = (k + 2) % 3;
  // Centres that coincide count as b above a, whichever box the face belongs to.
  if (of_a) return {a, b, pose.a_from_b, pose.in_a, k, u, v, pose.in_a[k] >= 0.0 ? 1.0 : -1.0};
  return {b, a, pose.a_from_b.transpose(), -pose.in_b, k, u, v, pose.in_b[k] >= 0.0 ? -1.0 : 1.0};
}

/// Whether the boxes' projections on the reference plane overlap by a width. The outlines are a rectangle and a
/// hexagon, so that the separating axes in the plane are the normals of their edges.
bool projections_overlap(const Reference& ref) {
  const Vec3& h = ref.box.half_extents;
  const Vec3& g = ref.other.half_extents;
  const Mat3& r = ref.axes;
  for (const int side : {ref.u, ref.v}) {
    const double radius = g[0] * std::abs(r(side, 0)) + g[1] * std::abs(r(side, 1)) + g[2] * std::abs(r(side, 2));
    if (h[side] + radius - std::abs(ref.centre[side]) < kContactTolerance) return false;
  }
  for (int j = 0; j < 3; ++j) {
    const double along_u = r(ref.u, j);
    const double along_v = r(ref.v, j);
    const double square = along_u * along_u + along_v * along_v;
    // The axis points at the plane, and gives the outline no edge.
    if (square < kRounding) continue;
    const int j1 = (j + 1) % 3;
    const int j2 = (j + 2) % 3;
    const double radius = h[ref.u] * std::abs(along_v) + h[ref.v] * std::abs(along_u);
    const double other_radius = g[j1] * std::abs(r(ref.k, j2)) + g[j2] * std::abs(r(ref.k, j1));
    const double distance = std::abs(ref.centre[ref.v] * along_u - ref.centre[ref.u] * along_v);
    const double overlap = radius + other_radius - distance;
    // No projected axis is longer than 1: a large overlap needs no square root.
    if (overlap < kContactTolerance && overlap < kContactTolerance * std::sqrt(square)) return false;
  }
  return true;
}

/// The incident face: the one of the other box that is turned most against the reference face. Of equal ones the first,
/// whose lowest edge or corner is also that of the others.
Polygon incident_face(const Reference& ref) {
  const Mat3& r = ref.axes;
  int m = 0;
  for (int j = 1; j < 3; ++j) {
    if (std::abs(r(ref.k, j)) > std::abs(r(ref.k, m))) m = j;
  }
  const double side = ref.outward * r(ref.k, m) > 0.0 ? -1.0 : 1.0;
  const int p = (m + 1) % 3;
  const int q = (m + 2) % 3;
  const Vec3& h = ref.other.half_extents;
  const Vec3 centre = ref.centre + side * h[m] * r.col(m);
  const Vec3 along_p = h[p] * r.col(p);
  const Vec3 along_q = h[q] * r.col(q);
  Polygon face;
  const auto add = [&](double sp, double sq) {
    const Vec3 corner = centre + (sp * along_p + sq * along_q);
    face.add({corner[ref.u], corner[ref.v], ref.outward * corner[ref.k] - ref.box.half_extents[ref.k]});
  };
  add(-1.0, -1.0);
  add(1.0, -1.0);
  add(1.0, 1.0);
  add(-1.0, 1.0);
  return face;
}

/// Where the edge from `inside` to `outside` meets the line `axis` = `bound`.
template <double Corner::*axis>
Corner crossing(const Corner& inside, const Corner& outside, double bound) {
  const double part = (bound - inside.*axis) / (outside.*axis - inside.*axis);
  Corner point{inside.u + part * (outside.u - inside.u), inside.v + part * (outside.v - inside.v),
               inside.gap + part * (outside.gap - inside.gap)};
  // Exactly on the line: supports end where boxes end.
  point.*axis = bound;
  return point;
}

/// Cuts off what lies beyond the line: one step of Sutherland and Hodgman.
template <double Corner::*axis>
void clip(Polygon& polygon, double sign, double bound) {
  const auto is_outside = [&](const Corner& corner) { return sign * (corner.*axis) > bound; };
  const auto end = polygon.corners.begin() + static_cast<std::ptrdiff_t>(polygon.count);
  if (std::none_of(polygon.corners.begin(), end, is_outside)) return;
  Polygon cut;
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const Corner& from = polygon.corners[i];
    const Corner& to = polygon.corners[i + 1 < polygon.count ? i + 1 : 0];
    const bool from_outside = is_outside(from);
    const bool to_outside = is_outside(to);
    if (!from_outside) cut.add(from);
    // Always from the inside, so that an edge is cut at the same bits in both directions.
    if (from_outside != to_outside)
      cut.add(from_outside ? crossing<axis>(to, from, sign * bound) : crossing<axis>(from, to, sign * bound));
  }
  polygon = cut;
}

/// Whether a corner is one of its two neighbours, or on the line between them.
bool is_between(const Corner& corner, const Corner& before, const Corner& after) {
  const double along_u = after.u - before.u;
  const double along_v = after.v - before.v;
  const double to_u = corner.u - before.u;
  const double to_v = corner.v - before.v;
  const double square = along_u * along_u + along_v * along_v;
  // Most corners are far from the line, which needs no division.
  const double product = along_u * to_v - along_v * to_u;
  if (product * product > (1.0 + kRounding) * kTouch * kTouch * square) return false;
  const double part = square > 0.0 ? std::clamp((to_u * along_u + to_v * along_v) / square, 0.0, 1.0) : 0.0;
  const double off_u = to_u - part * along_u;
  const double off_v = to_v - part * along_v;
  return off_u * off_u + off_v * off_v < kTouch * kTouch;
}

/// Drops the corners beyond the margin.
void keep_near(Polygon& polygon, double margin) {
  const std::size_t count = std::exchange(polygon.count, 0);
  for (std::size_t i = 0; i < count; ++i) {
    if (polygon.corners[i].gap <= margin) polygon.add(polygon.corners[i]);
  }
}

/// Drops corners that add nothing to the outline: where a box is hardly turned on an equal one, the sides cross half
/// way along them.
void keep_distinct(Polygon& polygon) {
  const std::size_t count = std::exchange(polygon.count, 0);
  for (std::size_t i = 0; i < count; ++i) {
    // The kept corners are at the front, each at its old index or before it.
    const bool first = polygon.count == 0;
    const bool last = i + 1 == count;
    const Corner& before = polygon.corners[first ? count - 1 : polygon.count - 1];
    const Corner& after = polygon.corners[last ? 0 : i + 1];
    const bool alone = first && last;
    if (alone || !is_between(polygon.corners[i], before, after)) polygon.add(polygon.corners[i]);
  }
}

/// Measures by how much the faces overlap along the sides of the reference face: the outlines of the whole boxes may
/// overlap by more, where one is turned a little.
void set_width(const Reference& ref, const Polygon& polygon, ContactSet& contact) {
  double low_u = std::numeric_limits<double>::infinity(), low_v = low_u, high_u = -low_u, high_v = -low_u;
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const Corner& corner = polygon.corners[i];
    low_u = std::min(low_u, corner.u);
    high_u = std::max(high_u, corner.u);
    low_v = std::min(low_v, corner.v);
    high_v = std::max(high_v, corner.v);
  }
  contact.widths[0].length = high_u - low_u;
  contact.widths[1].length = high_v - low_v;
  ref.box.axes.col(ref.u).cwiseAbs().maxCoeff(&contact.widths[0].across);
  ref.box.axes.col(ref.v).cwiseAbs().maxCoeff(&contact.widths[1].across);
}

void write_points(const Reference& ref, const Polygon& polygon, bool of_a, ContactSet& contact) {
  const Vec3 outward = ref.outward * ref.box.axes.col(ref.k);
  const Vec3 face = ref.box.centre + ref.box.half_extents[ref.k] * outward;
  contact.normal = of_a ? outward : Vec3(-outward);
  contact.count = static_cast<int>(polygon.count);
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const Corner& corner = polygon.corners[i];
    const Vec3 on_face = face + (corner.u * ref.box.axes.col(ref.u) + corner.v * ref.box.axes.col(ref.v));
    const Vec3 on_other = on_face + corner.gap * outward;
    ContactPoint& point = contact.points[i];
    point.on_a = of_a ? on_face : on_other;
    point.on_b = of_a ? on_other : on_face;
    point.gap = corner.gap;
  }
}

/// An edge of a box: its middle and direction in the frame of a.
struct Edge {
  Vec3 middle;
  Vec3 direction;
  double half_length;
};

double dot(const Vec3& x, const Vec3& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }

/// The edge of a box along its axis `along` that lies furthest in the direction `way`.
Edge supporting_edge(const Vec3& centre, const Mat3& axes, const Vec3& half_extents, int along, const Vec3& way) {
  Edge edge{centre, axes.col(along), half_extents[along]};
  for (const int k : {(along + 1) % 3, (along + 2) % 3}) {
    const Vec3 axis = axes.col(k);
    edge.middle += (dot(way, axis) >= 0.0 ? half_extents[k] : -half_extents[k]) * axis;
  }
  return edge;
}

/// From a to b along the product of two edges, in the frame of a; unit.
Vec3 edge_normal(const RelativePose& pose, const ContactAxis& axis) {
  const int i1 = (axis.a + 1) % 3;
  const int i2 = (axis.a + 2) % 3;
  const double c1 = -pose.a_from_b(i2, axis.b);
  const double c2 = pose.a_from_b(i1, axis.b);
  const double length = std::sqrt(c1 * c1 + c2 * c2);
  const double towards = c1 * pose.in_a[i1] + c2 * pose.in_a[i2] >= 0.0 ? 1.0 : -1.0;
  Vec3 normal = Vec3::Zero();
  normal[i1] = towards * c1 / length;
  normal[i2] = towards * c2 / length;
  return normal;
}

}  // namespace

ContactSet face_contact(const OrientedBox& a, const OrientedBox& b, const RelativePose& pose, const ContactAxis& axis,
                        double margin) {
  ContactSet contact;
  const Reference ref = reference_of(a, b, pose, axis);
  if (!projections_overlap(ref)) return contact;
  Polygon polygon = incident_face(ref);
  const Vec3& h = ref.box.half_extents;
  clip<&Corner::u>(polygon, 1.0, h[ref.u]);
  clip<&Corner::u>(polygon, -1.0, h[ref.u]);
  clip<&Corner::v>(polygon, 1.0, h[ref.v]);
  clip<&Corner::v>(polygon, -1.0, h[ref.v]);
  set_width(ref, polygon, contact);
  keep_near(polygon, margin);
  keep_distinct(polygon);
  if (polygon.count == 0) return contact;
  contact.axis = axis;
  write_points(ref, polygon, axis.kind == ContactAxis::Kind::face_of_a, contact);
  return contact;
}

ContactSet edge_contact(const OrientedBox& a, const OrientedBox& b, const RelativePose& pose, const ContactAxis& axis) {
  ContactSet contact;
  const Vec3 normal = edge_normal(pose, axis);
  const Edge of_a = supporting_edge(Vec3::Zero(), Mat3::Identity(), a.half_extents, axis.a, normal);
  const Edge of_b = supporting_edge(pose.in_a, pose.a_from_b, b.half_extents, axis.b, -normal);
  const Vec3 apart = of_b.middle - of_a.middle;
  const double along_a = dot(apart, of_a.direction);
  const double along_b = dot(apart, of_b.direction);
  const double cosine = dot(of_a.direction, of_b.direction);
  const Vec3 product = of_a.direction.cross(of_b.direction);
  const auto on_edge = [](double s, const Edge& edge) { return std::clamp(s, -edge.half_length, edge.half_length); };
  const double at_b = on_edge((cosine * along_a - along_b) / dot(product, product), of_b);
  const double at_a = on_edge(along_a + at_b * cosine, of_a);
  const Vec3 on_a = of_a.middle + at_a * of_a.direction;
  const Vec3 on_b = of_b.middle + at_b * of_b.direction;
  const Vec3 between = on_b - on_a;
  const double gap = dot(normal, between);
  const Vec3 across = between - gap * normal;
  if (dot(across, across) > kContactTolerance * kContactTolerance) return contact;
  contact.normal = a.axes * normal;
  contact.axis = axis;
  contact.count = 1;
  contact.points[0] = {a.centre + a.axes * on_a, a.centre + a.axes * on_b, gap};
  return contact;
}

}  // namespace holdfast::internal::native
