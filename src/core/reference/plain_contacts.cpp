#include "core/reference/plain_contacts.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace holdfast::internal::plain {

namespace {

/// Two edges at an angle whose sine is below this are parallel: they have no common perpendicular axis.
constexpr double kParallelEdges = 1e-6;

/// An edge axis whose cosine with the normal of a face is above this is treated as that normal; about 2.5 degrees.
constexpr double kAlongFace = 0.999;

/// How far a corner may lie outside a clipping plane and still count as inside, m: rounding then adds no corners.
constexpr double kOnBorder = 1e-9;

/// A candidate separating axis of two blocks.
struct Axis {
  Vec3 normal = Vec3::Zero();                                    ///< unit, from a to b
  double separation = -std::numeric_limits<double>::infinity();  ///< m; negative: the penetration
  int of_a = -1;  ///< the axis of a whose face or edge it is; -1: a face of b
  int of_b = -1;  ///< the same for b
};

double sign_of(double x) { return x < 0.0 ? -1.0 : 1.0; }

/// Distance that the block extends from its centre along a unit direction, m.
double extent(const Block& block, const Vec3& direction) {
  return (block.axes.transpose() * direction).cwiseAbs().dot(block.half_extents);
}

Axis axis_along(const Block& a, const Block& b, const Vec3& direction, int of_a, int of_b) {
  const double distance = direction.dot(b.centre - a.centre);
  return {sign_of(distance) * direction, std::abs(distance) - extent(a, direction) - extent(b, direction), of_a, of_b};
}

std::vector<Axis> face_axes(const Block& a, const Block& b) {
  std::vector<Axis> axes;
  for (int i = 0; i < 3; ++i) axes.push_back(axis_along(a, b, a.axes.col(i), i, -1));
  for (int i = 0; i < 3; ++i) axes.push_back(axis_along(a, b, b.axes.col(i), -1, i));
  return axes;
}

std::vector<Axis> edge_axes(const Block& a, const Block& b) {
  std::vector<Axis> axes;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const Vec3 across = a.axes.col(i).cross(b.axes.col(j));
      if (across.norm() > kParallelEdges) axes.push_back(axis_along(a, b, across.normalized(), i, j));
    }
  }
  return axes;
}

/// The axis of the largest separation. A later axis must be better by a margin, so that rounding does not decide.
Axis best_of(const std::vector<Axis>& axes, Axis best) {
  for (const Axis& axis : axes)
    if (axis.separation > best.separation + kNothing) best = axis;
  return best;
}

/// The four corners of the block's face whose normal is closest to `direction`, in order around the face.
std::vector<Vec3> face_towards(const Block& block, const Vec3& direction) {
  Eigen::Index k = 0;
  const Vec3 along = block.axes.transpose() * direction;
  along.cwiseAbs().maxCoeff(&k);
  const Vec3 middle = block.centre + sign_of(along[k]) * block.half_extents[k] * block.axes.col(k);
  const Eigen::Index i = (k + 1) % 3;
  const Eigen::Index j = (k + 2) % 3;
  const Vec3 u = block.half_extents[i] * block.axes.col(i);
  const Vec3 v = block.half_extents[j] * block.axes.col(j);
  return {middle - u - v, middle + u - v, middle + u + v, middle - u + v};
}

/// The part of a convex polygon where normal · x <= offset (Sutherland and Hodgman 1974).
std::vector<Vec3> clipped(const std::vector<Vec3>& polygon, const Vec3& normal, double offset) {
  std::vector<Vec3> part;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3& from = polygon[i];
    const Vec3& to = polygon[(i + 1) % polygon.size()];
    const double from_outside = normal.dot(from) - offset;
    const double to_outside = normal.dot(to) - offset;
    if (from_outside <= kOnBorder) part.push_back(from);
    if ((from_outside <= kOnBorder) != (to_outside <= kOnBorder)) {
      const double share = std::clamp(from_outside / (from_outside - to_outside), 0.0, 1.0);
      part.emplace_back(from + share * (to - from));
    }
  }
  return part;
}

/// True when the polygon, projected along a direction, degenerates to a line or a point.
bool is_thin(const std::vector<Vec3>& polygon, const Vec3& direction) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const Vec3& corner : polygon) {
    low = std::min(low, direction.dot(corner));
    high = std::max(high, direction.dot(corner));
  }
  return !(high - low > kNothing);
}

/// Corners of the part of the other block's face (the incident face) that lies over face `k` of the reference block.
/// @param outward unit normal of the reference face, towards the other block
/// @param normal  of the contact: `outward` or its opposite
std::vector<ContactPoint> points_over_face(const Block& reference, int k, const Vec3& outward, const Block& other,
                                           const Vec3& normal, double margin) {
  std::vector<Vec3> polygon = face_towards(other, -outward);
  for (const int side : {(k + 1) % 3, (k + 2) % 3}) {
    const Vec3 across = reference.axes.col(side);
    const double middle = across.dot(reference.centre);
    polygon = clipped(polygon, across, middle + reference.half_extents[side]);
    polygon = clipped(polygon, -across, -middle + reference.half_extents[side]);
  }
  if (is_thin(polygon, reference.axes.col((k + 1) % 3)) || is_thin(polygon, reference.axes.col((k + 2) % 3))) return {};

  const double surface = outward.dot(reference.centre) + reference.half_extents[k];
  std::vector<ContactPoint> points;
  for (const Vec3& corner : polygon) {
    const double gap = outward.dot(corner) - surface;
    if (gap <= margin) points.push_back({corner - 0.5 * gap * outward, normal, gap});
  }
  return points;
}

/// Middle of that edge of the block, parallel to its axis `k`, that is farthest along `direction`.
Vec3 edge_towards(const Block& block, int k, const Vec3& direction) {
  Vec3 middle = block.centre;
  for (const int side : {(k + 1) % 3, (k + 2) % 3}) {
    const Vec3 across = block.axes.col(side);
    middle += sign_of(across.dot(direction)) * block.half_extents[side] * across;
  }
  return middle;
}

/// The point halfway between two edges where they are closest, from the closest points of the lines.
ContactPoint point_of_edges(const Block& a, const Block& b, const Axis& axis) {
  const Vec3 p = edge_towards(a, axis.of_a, axis.normal);
  const Vec3 q = edge_towards(b, axis.of_b, -axis.normal);
  const Vec3 u = a.axes.col(axis.of_a);
  const Vec3 v = b.axes.col(axis.of_b);
  // Nearest points p + s u and q + t v: their difference is perpendicular to both u and v.
  const double uv = u.dot(v);
  const double along_u = u.dot(q - p);
  const double along_v = v.dot(q - p);
  const double sine_squared = u.cross(v).squaredNorm();
  const double s = (along_u - uv * along_v) / sine_squared;
  const double t = (uv * along_u - along_v) / sine_squared;
  // The point is limited to the ends of the edge; this does not change it along the normal, which is perpendicular to
  // both edges.
  const Vec3 on_a = p + std::clamp(s, -a.half_extents[axis.of_a], a.half_extents[axis.of_a]) * u;
  const Vec3 on_b = q + std::clamp(t, -b.half_extents[axis.of_b], b.half_extents[axis.of_b]) * v;
  return {0.5 * (on_a + on_b), axis.normal, axis.separation};
}

}  // namespace

std::vector<ContactPoint> contact_points(const HalfSpace& side, const Block& block, double margin) {
  std::vector<ContactPoint> points;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 signs((corner & 1) != 0 ? 1.0 : -1.0, (corner & 2) != 0 ? 1.0 : -1.0, (corner & 4) != 0 ? 1.0 : -1.0);
    const Vec3 position = block.centre + block.axes * signs.cwiseProduct(block.half_extents);
    const double gap = side.normal.dot(position) - side.offset;
    if (gap <= margin) points.push_back({position - 0.5 * gap * side.normal, side.normal, gap});
  }
  return points;
}

std::vector<ContactPoint> contact_points(const Block& a, const Block& b, double margin) {
  const std::vector<Axis> faces = face_axes(a, b);
  const Axis face = best_of(faces, {});
  Axis axis = best_of(edge_axes(a, b), face);
  if (axis.separation > margin) return {};
  if (axis.of_a >= 0 && axis.of_b >= 0) {
    // If the edges cross almost in the plane of a face, the face gives the same point, and all others within the
    // margin.
    const auto along = std::find_if(faces.begin(), faces.end(), [&](const Axis& candidate) {
      return candidate.normal.dot(axis.normal) > kAlongFace;
    });
    if (along == faces.end()) return {point_of_edges(a, b, axis)};
    axis = *along;
  }
  if (axis.of_a >= 0) return points_over_face(a, axis.of_a, axis.normal, b, axis.normal, margin);
  return points_over_face(b, axis.of_b, -axis.normal, a, axis.normal, margin);
}

}  // namespace holdfast::internal::plain
