#include "analyses/indicators/indicators.hpp"

#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "core/model/container_panels.hpp"

namespace holdfast::internal {

namespace {

/// Which of front, rear, left, right is supported.
using SideSet = std::bitset<4>;

/// Length that two boxes have in common along an axis, m; negative: the gap between them.
double overlap(const Box& a, const Box& b, Eigen::Index axis) {
  return std::min(a.corner_max[axis], b.corner_max[axis]) - std::max(a.corner_min[axis], b.corner_min[axis]);
}

/// Finds what each box stands on and leans on.
class Contacts {
 public:
  Contacts(const Layout& layout, const ContainerSettings& container)
      : boxes_(layout.boxes), supported_area_(boxes_.size(), 0.0), sides_(boxes_.size()) {
    for (const Panel& panel : container_panels(container, kWallThickness)) {
      const Box side{.corner_min = panel.low(), .corner_max = panel.high()};
      for (std::size_t i = 0; i < boxes_.size(); ++i) meet(i, side);
    }
    // Boxes in their order along x, so that only near ones are compared.
    std::vector<std::size_t> order(boxes_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return boxes_[a].corner_min.x() < boxes_[b].corner_min.x(); });
    for (std::size_t i = 0; i < order.size(); ++i)
      for (std::size_t j = i + 1; j < order.size(); ++j) {
        if (boxes_[order[j]].corner_min.x() > boxes_[order[i]].corner_max.x() + kSideGap) break;
        meet(order[i], boxes_[order[j]]);
        meet(order[j], boxes_[order[i]]);
      }
  }

  double base_support(std::size_t i) const {
    const Vec3 size = boxes_[i].corner_max - boxes_[i].corner_min;
    return std::min(1.0, supported_area_[i] / (size.x() * size.y()));
  }
  std::size_t supported_sides(std::size_t i) const { return sides_[i].count(); }

 private:
  /// What another box, or a side of the container, does for a box.
  void meet(std::size_t i, const Box& it) {
    const Box& box = boxes_[i];
    const double x = overlap(box, it, 0);
    const double y = overlap(box, it, 1);
    const double z = overlap(box, it, 2);
    if (x > 0 && y > 0 && std::abs(box.corner_min.z() - it.corner_max.z()) <= kBaseGap) supported_area_[i] += x * y;
    if (z < kLeastOverlap) return;
    // Overlaps of boxes that only touch are 0 up to rounding, and the negative gap where there is one.
    if (y >= kLeastOverlap && std::abs(x) <= kSideGap)
      sides_[i].set(side_of(0, it.corner_min.x() > box.corner_min.x()));
    if (x >= kLeastOverlap && std::abs(y) <= kSideGap)
      sides_[i].set(side_of(1, it.corner_min.y() > box.corner_min.y()));
  }

  static std::size_t side_of(int axis, bool far) { return 2 * static_cast<std::size_t>(axis) + (far ? 1 : 0); }

  const std::vector<Box>& boxes_;
  std::vector<double> supported_area_;  ///< m²
  std::vector<SideSet> sides_;
};

}  // namespace

LayoutIndicators find_indicators(const Layout& layout, const Settings& settings) {
  LayoutIndicators found;
  double load_volume = 0.0;
  double load_mass = 0.0;
  Vec3 moment = Vec3::Zero();
  for (const Box& box : layout.boxes) {
    const BoxProperties properties = properties_of(settings, box);
    if (properties.fixed) continue;
    load_volume += (box.corner_max - box.corner_min).prod();
    load_mass += properties.mass;
    moment += properties.mass * (0.5 * (box.corner_min + box.corner_max) + properties.centre_of_mass);
  }
  const ContainerSettings container = container_of(settings, layout);
  const Contacts contacts(layout, container);
  std::size_t badly_based = 0;
  std::size_t badly_braced = 0;
  std::size_t loaded = 0;
  for (std::size_t i = 0; i < layout.boxes.size(); ++i) {
    const double base = contacts.base_support(i);
    const std::size_t sides = contacts.supported_sides(i);
    found.base_support.push_back(static_cast<float>(base));
    found.supported_sides.push_back(static_cast<std::uint8_t>(sides));
    if (properties_of(settings, layout.boxes[i]).fixed) continue;
    ++loaded;
    badly_based += base < kGoodBase ? 1U : 0U;
    badly_braced += sides < kGoodBracing ? 1U : 0U;
  }
  if (loaded == 0) return found;
  found.centre_of_gravity = moment / load_mass;
  found.centre_offset = found.centre_of_gravity.cwiseQuotient(container.size) - Vec3(0.5, 0.5, 0.5);
  found.fill = load_volume / container.size.prod();
  const auto count = static_cast<double>(loaded);
  found.badly_based = static_cast<double>(badly_based) / count;
  found.badly_braced = static_cast<double>(badly_braced) / count;
  return found;
}

}  // namespace holdfast::internal
