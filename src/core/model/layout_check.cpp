#include "core/model/layout_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/error_list.hpp"
#include "core/base/number_text.hpp"
#include "core/model/box_overlaps.hpp"
#include "core/model/container_panels.hpp"
#include "core/model/container_sides.hpp"
#include "core/model/setting_kinds.hpp"

namespace holdfast::internal {

namespace {

constexpr std::array kExtentNames{"length", "width", "height"};

std::string millimetres(double metres) { return rounded_text(metres * 1000.0) + " mm"; }
std::string centimetres(const Vec3& v) {
  const Vec3 cm = 100.0 * v;
  return rounded_text(cm.x()) + " x " + rounded_text(cm.y()) + " x " + rounded_text(cm.z()) + " cm";
}
std::string box_name(std::size_t index) { return "box " + std::to_string(index + 1); }

/// How errors count boxes: from 1.
long place_of(std::size_t index) { return static_cast<long>(index) + 1; }

/// Which of the seven numbers of a box that is, from 1.
long number_of(Eigen::Index axis, bool second_corner) { return static_cast<long>(axis) + (second_corner ? 4 : 1); }

/// Which of the seven numbers is the first that is not finite, from 1; 0 when all are.
long not_finite(const Box& box) {
  for (const bool second_corner : {false, true})
    for (Eigen::Index axis = 0; axis < 3; ++axis)
      if (!std::isfinite((second_corner ? box.corner_max : box.corner_min)[axis]))
        return number_of(axis, second_corner);
  return 0;
}

/// The check of one layout: first of single boxes, then of pairs of the boxes that have positive extents.
class LayoutCheck {
 public:
  LayoutCheck(const Layout& layout, const Settings& settings, const std::string& file)
      : boxes_(layout.boxes), settings_(settings), container_(container_of(settings, layout)), errors_(file) {
    for (const Box& box : boxes_) fixed_.push_back(properties_of(settings, box).fixed);
  }

  void check_boxes() {
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      if (!is_box(i)) continue;
      // What is fixed may reach through a side, as a wheel arch does, or hang outside, as a tail lift does.
      if (!is_fixed(i)) check_inside(i);
      check_centre_of_mass(i);
      check_mat(i);
      sound_.push_back({boxes_[i].corner_min, boxes_[i].corner_max, i});
    }
  }

  void check_pairs() {
    for_each_overlap(sound_, [&](const BoxExtents& a, const BoxExtents& b) {
      check_pair(std::min(a.index, b.index), std::max(a.index, b.index), depths_of(a, b).minCoeff());
    });
  }

  std::vector<Error> take_errors() { return errors_.take(); }

  void warn(const std::string& file, std::vector<Error>& warnings) const {
    warn_of_boxes_beyond(file, warnings);
    if (tolerated_ == 0) return;
    warnings.push_back({.file = file,
                        .what = "overlaps and protrusions within the tolerance are ignored",
                        .value = std::to_string(tolerated_) + ", the largest " + millimetres(largest_tolerated_),
                        .accepted = "up to " + millimetres(kLayoutTolerance) + " is taken as rounding"});
  }

 private:
  /// Boxes that have neither floor nor wall beneath them: what stands on an overhang is meant, what lies outside is a
  /// mistake.
  void warn_of_boxes_beyond(const std::string& file, std::vector<Error>& warnings) const {
    std::size_t count = 0;
    std::size_t first = boxes_.size();
    // The floor reaches under the walls, on which a box may stand.
    const Panel panel = container_panels(container_, kWallThickness).front();
    const BoxExtents floor{panel.low(), panel.high()};
    for (const BoxExtents& box : sound_) {
      const bool above_floor = depths_of(box, floor).head<2>().minCoeff() > kExactLength;
      if (above_floor || is_fixed(box.index) || is_above_fixed(box)) continue;
      ++count;
      first = std::min(first, box.index);
    }
    if (count == 0) return;
    warnings.push_back({.file = file,
                        .what = "boxes are wholly beyond the floor",
                        .value = std::to_string(count) + ", the first is " + box_name(first),
                        .accepted = "such a box falls unless others carry it"});
  }

  bool is_above_fixed(const BoxExtents& box) const {
    return std::any_of(sound_.begin(), sound_.end(), [&](const BoxExtents& other) {
      const double beside = std::min(box.max.y(), other.max.y()) - std::max(box.min.y(), other.min.y());
      return is_fixed(other.index) && other.max.z() <= box.min.z() + kLayoutTolerance && beside > kExactLength &&
             depths_of(box, other).x() > kExactLength;
    });
  }

  bool is_box(std::size_t i) {
    const Box& box = boxes_[i];
    if (const long number = not_finite(box)) {
      errors_.add({.line = box.line,
                   .what = box_name(i) + " has a corner that is not finite",
                   .box = place_of(i),
                   .box_number = number});
      return false;
    }
    const Vec3 extents = box.corner_max - box.corner_min;
    bool positive = true;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      if (extents[axis] > kLayoutTolerance) continue;
      positive = false;
      const std::string kind = extents[axis] < 0.0 ? " has a negative " : " has no ";
      errors_.add({.line = box.line,
                   .what = box_name(i) + kind + kExtentNames[static_cast<std::size_t>(axis)],
                   .value = rounded_text(extents[axis] * 100.0) + " cm",
                   .accepted = "the second corner must be beyond the first along every axis, by more than " +
                               millimetres(kLayoutTolerance),
                   .box = place_of(i),
                   .box_number = number_of(axis, true)});
    }
    return positive;
  }

  void check_inside(std::size_t i) {
    const Box& box = boxes_[i];
    for (const ContainerSide& side : kContainerSides) {
      const double depth =
          side.far ? box.corner_max[side.axis] - container_.size[side.axis] : -box.corner_min[side.axis];
      check_side(i, side, depth);
    }
  }

  void check_side(std::size_t i, const ContainerSide& side, double depth) {
    if (depth <= kExactLength || is_open(container_, side) ||
        is_above_drop_side(container_, side, boxes_[i].corner_min.z() + kLayoutTolerance) || tolerates(depth))
      return;
    if (errors_.full()) return errors_.count_more();
    errors_.add({.line = boxes_[i].line,
                 .what = box_name(i) + " is outside the container at the " + std::string(side.name),
                 .value = millimetres(depth),
                 .accepted = "the container is " + centimetres(container_.size),
                 .box = place_of(i),
                 .box_number = number_of(side.axis, side.far)});
  }

  void check_mat(std::size_t i) {
    const Box& box = boxes_[i];
    if (!box.mat || setting_kinds::CoefficientRange::holds(*box.mat)) return;
    errors_.add({.line = box.line,
                 .what = "the friction of the mat of " + box_name(i) + " is not possible",
                 .value = rounded_text(*box.mat),
                 .accepted = std::string(setting_kinds::CoefficientRange::kAccepted),
                 .box = place_of(i)});
  }

  void check_centre_of_mass(std::size_t i) {
    const Box& box = boxes_[i];
    const Vec3 offset = properties_of(settings_, box).centre_of_mass;
    const Vec3 most = 0.5 * (box.corner_max - box.corner_min) + Vec3::Constant(kExactLength);
    if ((offset.cwiseAbs().array() <= most.array()).all()) return;
    errors_.add({.line = box.line,
                 .what = box_name(i) + " has its centre of mass outside" +
                         (box.centre_of_mass ? "" : ", by CentreOfMass of [Material " + box.material.text() + ']'),
                 .value = setting_kinds::CentimetreVector::text(offset) + " cm",
                 .accepted = "at most half of the box to either side, " + centimetres(most),
                 .box = place_of(i),
                 .box_number = kMaterialNumber});
  }

  /// Two boxes that are in each other.
  void check_pair(std::size_t a, std::size_t b, double depth) {
    if ((is_fixed(a) && is_fixed(b)) || tolerates(depth)) return;
    if (errors_.full()) return errors_.count_more();
    errors_.add({.line = boxes_[b].line,
                 .what = box_name(b) + " overlaps " + box_name(a) +
                         (boxes_[a].line != boxes_[b].line ? " of line " + std::to_string(boxes_[a].line) : ""),
                 .value = millimetres(depth) + " deep",
                 .accepted = "boxes may touch; up to " + millimetres(kLayoutTolerance) + " is taken as rounding",
                 .box = place_of(b)});
  }

  bool is_fixed(std::size_t i) const { return fixed_[i]; }

  bool tolerates(double depth) {
    if (depth > kLayoutTolerance + kExactLength) return false;
    ++tolerated_;
    largest_tolerated_ = std::max(largest_tolerated_, depth);
    return true;
  }

  const std::vector<Box>& boxes_;
  const Settings& settings_;
  const ContainerSettings container_;
  std::vector<bool> fixed_;
  ErrorList errors_;
  std::vector<BoxExtents> sound_;  ///< in check_pairs by where they begin along x
  std::size_t tolerated_ = 0;
  double largest_tolerated_ = 0.0;  ///< m
};

}  // namespace

std::vector<Error> check_layout(const Layout& layout, const Settings& settings, const std::string& file,
                                std::vector<Error>& warnings) {
  LayoutCheck check(layout, settings, file);
  check.check_boxes();
  check.check_pairs();
  check.warn(file, warnings);
  return check.take_errors();
}

}  // namespace holdfast::internal
