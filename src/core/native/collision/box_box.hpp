#pragma once

#include <array>
#include <limits>

#include "core/native/collision/oriented_box.hpp"

namespace holdfast::internal::native {

/// Where two surfaces face each other at one point.
struct ContactPoint {
  Vec3 on_a = Vec3::Zero();  ///< on the surface of body a, container frame, m
  Vec3 on_b = Vec3::Zero();  ///< on the surface of body b, m
  double gap = 0.0;          ///< normal · (on_b − on_a), m; negative where they overlap
};

/// The separating axis of a contact, kept from step to step so that near ties do not alternate.
struct ContactAxis {
  enum class Kind { none, face_of_a, face_of_b, edges };
  Kind kind = Kind::none;
  int a = 0;  ///< axis of a: of the face, or of the edge
  int b = 0;  ///< axis of b, likewise
  friend bool operator==(const ContactAxis&, const ContactAxis&) = default;
};

/// By how much two faces overlap along an axis of theirs; infinite for edges and sides.
struct ContactWidth {
  double length = std::numeric_limits<double>::infinity();  ///< m
  int across = 0;                                           ///< the container's axis that it is along, or nearly
};

/// The contact of two bodies: points with a common normal.
struct ContactSet {
  Vec3 normal = Vec3::Zero();  ///< unit, from a to b
  ContactAxis axis;
  int count = 0;                       ///< of the points that are used
  std::array<ContactWidth, 2> widths;  ///< as seen along the normal
  std::array<ContactPoint, 8> points;

  /// Least gap of the points, m; infinite without any.
  double nearest_gap() const;
};

/// Contact of two boxes: the points whose gap is at most `margin`, m.
///
/// Faces: the incident face clipped by the side planes of the reference face (Sutherland and Hodgman 1974), up to
/// 8 points, in order around the overlap; edges: first the closest points of the two edges, then those of the faces'
/// contact where its normal is within 11° of that of the edges. The axis is the one of least overlap (separating axis
/// test, Gottschalk et al. 1996); `previous` wins near ties. A contact along an edge or a corner alone, where the boxes
/// as seen along the normal overlap by less than 10 µm, is none: boxes of a packing must slide past each other's edges.
/// A box that stands on its edge or corner on a face has 2 points or 1.
///
/// Aligned boxes take a path of their own, whose numbers are the boxes' own coordinates: boxes that share a face's
/// coordinate have a gap of rounding only, and mirroring the scene or exchanging the boxes changes signs, not bits.
/// A pose that is not a number has no contact.
ContactSet contact_of(const OrientedBox& a, const OrientedBox& b, double margin, const ContactAxis& previous);

/// Contact of a side of the container, as body a, with a box as body b: the corners of the face that looks most
/// towards the side whose gap is at most `margin`, m; up to 4 points. Its axis is a face of a; `axis.b` is the normal's
/// axis of the box' face.
ContactSet contact_of(const HalfSpace& a, const OrientedBox& b, double margin);

}  // namespace holdfast::internal::native
