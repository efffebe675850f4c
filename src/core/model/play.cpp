#include "core/model/play.hpp"

#include <algorithm>

#include "core/base/mixed_bits.hpp"

namespace holdfast::internal {

namespace {

/// Distance of two boxes along an axis; negative where their extents overlap.
double gap(const Box& a, const Box& b, int axis) {
  return std::max(b.corner_min[axis] - a.corner_max[axis], a.corner_min[axis] - b.corner_max[axis]);
}

/// Bounds the play of two boxes by their share of the gap along an axis.
void share(double gap, const Box& a, BoxPlay& play_a, const Box& b, BoxPlay& play_b, int axis) {
  const auto side = static_cast<std::size_t>(axis);
  const bool a_first = a.corner_min[axis] < b.corner_min[axis];
  double& forth = (a_first ? play_a : play_b).forth[side];
  double& back = (a_first ? play_b : play_a).back[side];
  forth = std::min(forth, gap);
  back = std::min(back, gap);
}

}  // namespace

std::vector<BoxPlay> play_of(const Layout& layout, const Settings& settings, double largest) {
  const ContainerSettings container = container_of(settings, layout);
  std::vector<BoxPlay> play(layout.boxes.size());
  std::vector<bool> fixed;
  for (const Box& box : layout.boxes) fixed.push_back(properties_of(settings, box).fixed);
  for (std::size_t i = 0; i < play.size(); ++i) {
    const Box& box = layout.boxes[i];
    if (fixed[i]) continue;
    for (const int axis : {0, 1}) {
      const auto side = static_cast<std::size_t>(axis);
      play[i].back[side] = std::clamp(box.corner_min[axis], 0.0, largest);
      play[i].forth[side] = std::clamp(container.size[axis] - box.corner_max[axis], 0.0, largest);
    }
  }
  for (std::size_t i = 0; i < play.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Box& a = layout.boxes[i];
      const Box& b = layout.boxes[j];
      const double along = gap(a, b, 0);
      const double across = gap(a, b, 1);
      const double beside = std::max(along, across);
      // Negative gaps are overlaps within the tolerance of layouts.
      const bool above_each_other = gap(a, b, 2) >= std::min(0.0, beside);
      if (above_each_other) continue;
      const double part = fixed[i] || fixed[j] ? 1.0 : 0.5;
      share(part * std::max(0.0, beside), a, play[i], b, play[j], along >= across ? 0 : 1);
    }
  }
  return play;
}

Layout shifted_layout(const Layout& layout, const std::vector<BoxPlay>& play, std::uint64_t boxes,
                      std::uint32_t number) {
  constexpr std::uint64_t kPurpose = 0x73686966742d6279ULL;  // apart from the numbers of other draws
  std::uint64_t state = mixed_bits(mixed_bits(boxes ^ kPurpose) ^ number);
  Layout shifted = layout;
  for (std::size_t i = 0; i < play.size(); ++i) {
    for (const int axis : {0, 1}) {
      const auto side = static_cast<std::size_t>(axis);
      state = mixed_bits(state);
      const double shift = unit_number(state) * (play[i].back[side] + play[i].forth[side]) - play[i].back[side];
      shifted.boxes[i].corner_min[axis] += shift;
      shifted.boxes[i].corner_max[axis] += shift;
    }
  }
  return shifted;
}

}  // namespace holdfast::internal
