#include "io/loads/load_parts.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>

#include "core/model/layout_check.hpp"

namespace holdfast::internal {

namespace {

/// Whether two boxes share a part of the container, and not merely an overlap that rounding or measuring leaves.
bool share_space(const Box& a, const Box& b) {
  constexpr double kShare = 0.1;
  const Vec3 common = a.corner_max.cwiseMin(b.corner_max) - a.corner_min.cwiseMax(b.corner_min);
  const Vec3 smaller = (a.corner_max - a.corner_min).cwiseMin(b.corner_max - b.corner_min);
  return (common.array() > kShare * smaller.array()).all();
}

/// Whether loads are different ones: of their boxes, every second at least is where one of another load is. A single
/// one is a mistake.
bool are_different(const std::vector<ReadLoad>& loads) {
  constexpr std::size_t kLookedAt = 200;  // boxes, evenly chosen
  std::vector<std::pair<std::size_t, const Box*>> boxes;
  for (std::size_t i = 0; i < loads.size(); ++i)
    for (const Box& box : loads[i].layout.boxes) boxes.emplace_back(i, &box);
  const std::size_t count = std::min(kLookedAt, boxes.size());
  std::size_t shared = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const auto& chosen = boxes[k * boxes.size() / count];
    shared += std::any_of(boxes.begin(), boxes.end(), [&](const auto& other) {
      return other.first != chosen.first && share_space(*other.second, *chosen.second);
    });
  }
  return 2 * shared >= count;
}

}  // namespace

void join_parts(std::vector<ReadLoad>& loads, const std::string& name) {
  if (loads.size() < 2) return;
  const auto& container = loads.front().layout.container;
  for (const ReadLoad& load : loads) {
    const auto& own = load.layout.container;
    const bool is_same = own && container ? own->type == container->type && own->size == container->size
                                          : own.has_value() == container.has_value();
    if (!load.errors.empty() || !is_same) return;
  }
  std::size_t boxes = 0;
  for (const ReadLoad& load : loads) boxes += load.layout.boxes.size();
  if (boxes > kMostBoxes || are_different(loads)) return;
  ReadLoad joined = std::move(loads.front());
  for (std::size_t i = 1; i < loads.size(); ++i) {
    std::move(loads[i].layout.boxes.begin(), loads[i].layout.boxes.end(), std::back_inserter(joined.layout.boxes));
    std::move(loads[i].box_pointers.begin(), loads[i].box_pointers.end(), std::back_inserter(joined.box_pointers));
    std::move(loads[i].warnings.begin(), loads[i].warnings.end(), std::back_inserter(joined.warnings));
  }
  // In JSON, where boxes have pointers, they have no lines, and stay in their order.
  std::stable_sort(joined.layout.boxes.begin(), joined.layout.boxes.end(),
                   [](const Box& a, const Box& b) { return a.line < b.line; });
  joined.layout.name = name;
  loads.clear();
  loads.push_back(std::move(joined));
}

}  // namespace holdfast::internal
