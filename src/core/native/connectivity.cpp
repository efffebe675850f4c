#include "core/native/connectivity.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "core/native/contact_kinematics.hpp"

namespace holdfast::internal::native {

void Connectivity::find(const Bodies& bodies, const std::vector<Manifold>& manifolds) {
  const std::size_t count = bodies.count();
  root_.resize(count);
  std::iota(root_.begin(), root_.end(), 0U);
  const auto find = [&](std::uint32_t i) {
    while (root_[i] != i) i = root_[i] = root_[root_[i]];
    return i;
  };
  const auto free = [&](std::int32_t body) { return !stays(bodies, body); };
  // Manifolds are large: each is looked at once.
  ends_.clear();
  for (const Manifold& manifold : manifolds) {
    ends_.emplace_back(manifold.a, manifold.b);
    if (!manifold.active || !free(manifold.a) || !free(manifold.b)) continue;
    const std::uint32_t of_a = find(static_cast<std::uint32_t>(manifold.a));
    const std::uint32_t of_b = find(static_cast<std::uint32_t>(manifold.b));
    root_[std::max(of_a, of_b)] = std::min(of_a, of_b);
  }
  // Connectivity by their first body, bodies and manifolds in their own order.
  island_of_.assign(count, kNone);
  ranges_.clear();
  for (std::uint32_t i = 0; i < count; ++i) {
    if (!free(static_cast<std::int32_t>(i))) continue;
    const std::uint32_t first = find(i);
    if (first == i) {
      island_of_[i] = static_cast<std::uint32_t>(ranges_.size());
      ranges_.emplace_back();
    } else {
      island_of_[i] = island_of_[first];
    }
    ++ranges_[island_of_[i]].body_end;
  }
  // What belongs to no island is counted and sorted like the rest, into a range of its own at the end: which manifolds
  // these are, no processor could predict.
  static_assert(kNone == std::numeric_limits<std::uint32_t>::max());
  const auto none = static_cast<std::uint32_t>(ranges_.size());
  ranges_.emplace_back();
  island_of_manifold_.resize(ends_.size());
  for (std::size_t m = 0; m < ends_.size(); ++m) {
    const std::uint32_t of_a = ends_[m].first < 0 ? kNone : island_of_[at(ends_[m].first)];
    const std::uint32_t of_b = island_of_[at(ends_[m].second)];
    const std::uint32_t least = std::min(of_a, of_b);
    const bool inside = of_a == of_b || std::max(of_a, of_b) == kNone;
    island_of_manifold_[m] = std::min(inside ? least : kNone, none);
    ++ranges_[island_of_manifold_[m]].manifold_end;
  }
  std::size_t bodies_before = 0, manifolds_before = 0;
  for (Range& island : ranges_) {
    island.body_begin = bodies_before;
    island.manifold_begin = manifolds_before;
    bodies_before += std::exchange(island.body_end, bodies_before);
    manifolds_before += std::exchange(island.manifold_end, manifolds_before);
  }
  members_.resize(bodies_before);
  inside_.resize(manifolds_before);
  for (std::uint32_t i = 0; i < count; ++i)
    if (island_of_[i] != kNone) members_[ranges_[island_of_[i]].body_end++] = i;
  for (std::uint32_t m = 0; m < ends_.size(); ++m) inside_[ranges_[island_of_manifold_[m]].manifold_end++] = m;
  ranges_.pop_back();
}

bool Connectivity::is_in_large_island(std::int32_t body) const {
  const std::uint32_t island = body < 0 ? kNone : of(at(body));
  return island != kNone && (*this)[island].bodies.size() > kSmallIslandBodies;
}

IslandView Connectivity::operator[](std::size_t island) const {
  const Range& range = ranges_[island];
  return {std::span(members_).subspan(range.body_begin, range.body_end - range.body_begin),
          std::span(inside_).subspan(range.manifold_begin, range.manifold_end - range.manifold_begin)};
}

}  // namespace holdfast::internal::native
