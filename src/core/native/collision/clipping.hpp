#pragma once

#include "core/native/collision/box_box.hpp"
#include "core/native/collision/oriented_box.hpp"
#include "core/native/collision/separating_axis.hpp"

namespace holdfast::internal::native {

/// The contact along an axis of a face: the face of the other box that looks most against it, clipped by the side
/// planes of the first (Sutherland and Hodgman 1974). Up to 8 points; none where the boxes' projections on the face
/// overlap by less than kContactTolerance.
ContactSet face_contact(const OrientedBox& a, const OrientedBox& b, const RelativePose& pose, const ContactAxis& axis,
                        double margin);

/// The contact of two edges: their closest points (Ericson 2005, 5.1.9). None where the edges do not cross as seen
/// along the axis: the boxes are then nearest elsewhere.
ContactSet edge_contact(const OrientedBox& a, const OrientedBox& b, const RelativePose& pose, const ContactAxis& axis);

}  // namespace holdfast::internal::native
