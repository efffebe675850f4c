#include "core/model/overlap_trim.hpp"

#include <vector>

#include "core/model/box_overlaps.hpp"
#include "core/model/layout_check.hpp"

namespace holdfast::internal {

namespace {

std::vector<BoxExtents> extents_of(const Layout& layout) {
  std::vector<BoxExtents> extents;
  for (std::size_t i = 0; i < layout.boxes.size(); ++i) {
    const Box& box = layout.boxes[i];
    const bool is_sound = box.corner_min.allFinite() && box.corner_max.allFinite() &&
                          (box.corner_max - box.corner_min).minCoeff() > kLayoutTolerance;
    if (is_sound) extents.push_back({box.corner_min, box.corner_max, i});
  }
  return extents;
}

/// The mass of a box as it was before it is trimmed.
void keep_mass(Box& box, const Settings& settings) { box.mass = properties_of(settings, box).mass; }

void note(Trimmed& trimmed, double depth, std::size_t a, std::size_t b) {
  ++trimmed.pairs;
  if (depth <= trimmed.largest) return;
  trimmed.largest = depth;
  trimmed.first = std::min(a, b);
  trimmed.second = std::max(a, b);
}

}  // namespace

Trimmed trim_overlaps(Layout& layout, const Settings& settings, double tolerance) {
  Trimmed trimmed;
  std::vector<BoxExtents> extents = extents_of(layout);
  for_each_overlap(extents, [&](const BoxExtents& first, const BoxExtents& second) {
    Box& a = layout.boxes[first.index];
    Box& b = layout.boxes[second.index];
    // As they are after other pairs have been trimmed.
    const Vec3 depths = depths_of({a.corner_min, a.corner_max}, {b.corner_min, b.corner_max});
    Eigen::Index axis = 0;
    const double depth = depths.minCoeff(&axis);
    if (depth <= kLayoutTolerance + kExactLength || depth > tolerance + kExactLength) return;
    const bool a_fixed = properties_of(settings, a).fixed;
    const bool b_fixed = properties_of(settings, b).fixed;
    if (a_fixed && b_fixed) return;
    note(trimmed, depth, first.index, second.index);
    const double share_of_a = a_fixed ? 0.0 : b_fixed ? 1.0 : 0.5;
    if (!a_fixed) keep_mass(a, settings);
    if (!b_fixed) keep_mass(b, settings);
    Box& low = a.corner_min[axis] <= b.corner_min[axis] ? a : b;
    Box& high = &low == &a ? b : a;
    const double share_of_low = &low == &a ? share_of_a : 1.0 - share_of_a;
    const double face = low.corner_max[axis] - share_of_low * depth;
    low.corner_max[axis] = face;
    high.corner_min[axis] = face;
  });
  return trimmed;
}

Trimmed nest_boxes(Layout& layout, std::span<const double> nesting, const Settings& settings) {
  Trimmed trimmed;
  std::vector<BoxExtents> extents = extents_of(layout);
  for_each_overlap(extents, [&](const BoxExtents& first, const BoxExtents& second) {
    const bool first_is_lower = layout.boxes[first.index].corner_min.z() <= layout.boxes[second.index].corner_min.z();
    const std::size_t lower = first_is_lower ? first.index : second.index;
    const std::size_t upper = first_is_lower ? second.index : first.index;
    Box& box = layout.boxes[lower];
    const double depth = box.corner_max.z() - layout.boxes[upper].corner_min.z();
    if (depth <= kExactLength || depth > nesting[upper] + kLayoutTolerance) return;
    note(trimmed, depth, lower, upper);
    keep_mass(box, settings);
    box.corner_max.z() = layout.boxes[upper].corner_min.z();
  });
  return trimmed;
}

}  // namespace holdfast::internal
