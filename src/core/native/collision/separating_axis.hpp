#pragma once

#include <optional>

#include "core/native/collision/box_box.hpp"
#include "core/native/collision/oriented_box.hpp"

namespace holdfast::internal::native {

/// Box b as seen from box a, and the other way round.
struct RelativePose {
  Mat3 a_from_b;      ///< its columns are the axes of b in the axes of a
  Mat3 abs_a_from_b;  ///< the absolute values of a_from_b
  Vec3 in_a;          ///< from the centre of a to that of b, in the axes of a, m
  Vec3 in_b;          ///< the same in the axes of b, m
};

/// The relative pose of two boxes.
RelativePose relative_pose(const OrientedBox& a, const OrientedBox& b);

/// The axes along which two boxes are in contact.
struct AxisChoice {
  ContactAxis axis;  ///< the one to use: of a face or of two edges
  ContactAxis face;  ///< the best of the faces, where edges were chosen and turn out not to cross
};

/// The axis of greatest separation (least overlap) among the 6 face normals and the 9 products of edges (Gottschalk,
/// Lin and Manocha 1996); none where an axis separates the boxes by more than `margin`, m. Near ties go to `previous`,
/// then to faces before edges, then to the larger face.
std::optional<AxisChoice> choose_axis(const OrientedBox& a, const OrientedBox& b, const RelativePose& pose,
                                      double margin, const ContactAxis& previous);

}  // namespace holdfast::internal::native
