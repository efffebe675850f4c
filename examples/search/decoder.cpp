#include "decoder.hpp"

#include <algorithm>
#include <numeric>

namespace {

/// Rows of a block grow along the first axis, and stand beside or on each other along the second.
constexpr std::array<std::array<std::size_t, 2>, 6> kGrowth = {{{0, 1}, {0, 2}, {1, 0}, {1, 2}, {2, 0}, {2, 1}}};

std::vector<Extents> orientations_of(const BoxType& type) {
  std::vector<Extents> orientations;
  for (std::size_t up = 0; up < 3; ++up) {
    if (!type.may_be_upright[up]) continue;
    const int a = type.edges[(up + 1) % 3], b = type.edges[(up + 2) % 3], c = type.edges[up];
    orientations.push_back({a, b, c});
    if (a != b) orientations.push_back({b, a, c});
  }
  return orientations;
}

Cuboid moved(Cuboid cuboid, std::size_t axis, int distance) {
  cuboid.low[axis] += distance;
  cuboid.high[axis] += distance;
  return cuboid;
}

/// Corners are filled from the front wall on, in a wall from below, and then from the left.
Extents in_order(const Extents& corner) { return {corner[0], corner[2], corner[1]}; }

/// A container that is being loaded.
class Container {
 public:
  Container(const Extents& extents, int smallest_edge) : spaces_(extents, smallest_edge) {}

  /// The first space in whose corner a box of these extents has room and support; nullptr when there is none.
  const Cuboid* find_space(const Extents& extents) const {
    const Cuboid* best = nullptr;
    for (const Cuboid& space : spaces_.all()) {
      if (best != nullptr && in_order(best->low) <= in_order(space.low)) continue;
      const Cuboid place = at(space.low, extents);
      if (space.contains(place) && supported(place)) best = &space;
    }
    return best;
  }

  /// Fills the space from its corner with whole rows of boxes, at most `most` boxes in all.
  /// @return how many boxes
  int put_block(Cuboid space, const Extents& extents, const std::array<std::size_t, 2>& growth, int most, int type) {
    const std::size_t along = growth[0], across = growth[1];
    const Cuboid first = at(space.low, extents);
    const auto place_of = [&](int i, int j) {
      return moved(moved(first, along, i * extents[along]), across, j * extents[across]);
    };
    const auto fits = [&](int i, int j) {
      const Cuboid place = place_of(i, j);
      // A box that is not in the lowest row stands on the one below.
      return space.contains(place) && (place.low[2] > first.low[2] || supported(place));
    };
    int row = 1, rows = 1;
    while (row < most && fits(row, 0)) ++row;
    const auto row_fits = [&](int j) {
      for (int i = 0; i < row; ++i)
        if (!fits(i, j)) return false;
      return true;
    };
    while (row * (rows + 1) <= most && row_fits(rows)) ++rows;

    for (int j = 0; j < rows; ++j)
      for (int i = 0; i < row; ++i) boxes_.push_back({place_of(i, j), type});
    spaces_.occupy({first.low, place_of(row - 1, rows - 1).high});
    return row * rows;
  }

  std::vector<PlacedBox>& boxes() { return boxes_; }

 private:
  static Cuboid at(const Extents& corner, const Extents& extents) {
    return {corner, {corner[0] + extents[0], corner[1] + extents[1], corner[2] + extents[2]}};
  }

  bool supported(const Cuboid& place) const {
    if (place.low[2] == 0) return true;
    const auto overlap = [](const Cuboid& a, const Cuboid& b, std::size_t axis) {
      return std::max(0, std::min(a.high[axis], b.high[axis]) - std::max(a.low[axis], b.low[axis]));
    };
    int area = 0;
    for (const PlacedBox& below : boxes_)
      if (below.place.high[2] == place.low[2]) area += overlap(place, below.place, 0) * overlap(place, below.place, 1);
    const int base = (place.high[0] - place.low[0]) * (place.high[1] - place.low[1]);
    return area >= Decoder::kLeastSupport * base;
  }

  FreeSpaces spaces_;
  std::vector<PlacedBox> boxes_;
};

}  // namespace

Decoder::Decoder(Instance instance) : instance_(std::move(instance)) {
  smallest_edge_ = *std::max_element(instance_.container.begin(), instance_.container.end());
  for (const BoxType& type : instance_.types) {
    turns_.insert(turns_.end(), static_cast<std::size_t>(type.count), static_cast<int>(orientations_.size()));
    orientations_.push_back(orientations_of(type));
    smallest_edge_ = std::min(smallest_edge_, *std::min_element(type.edges.begin(), type.edges.end()));
  }
}

Loading Decoder::decode(std::span<const double> keys) const {
  const std::size_t turns = turns_.size();
  std::vector<std::size_t> order(turns);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return keys[a] < keys[b]; });

  std::vector<int> left;
  for (const BoxType& type : instance_.types) left.push_back(type.count);
  Container container(instance_.container, smallest_edge_);
  for (const std::size_t turn : order) {
    const int type = turns_[turn];
    int& of_type = left[static_cast<std::size_t>(type)];
    if (of_type == 0) continue;
    const std::vector<Extents>& orientations = orientations_[static_cast<std::size_t>(type)];
    // The key chooses one of the ways to stand; where there is no room for that one, the next has its turn.
    const std::size_t ways = orientations.size() * kGrowth.size();
    const auto way = static_cast<std::size_t>(keys[turns + turn] * static_cast<double>(ways));
    for (std::size_t i = 0; i < orientations.size(); ++i) {
      const Extents& extents = orientations[(way / kGrowth.size() + i) % orientations.size()];
      if (const Cuboid* space = container.find_space(extents)) {
        of_type -= container.put_block(*space, extents, kGrowth[way % kGrowth.size()], of_type, type);
        break;
      }
    }
  }

  Loading loading{std::move(container.boxes())};
  double volume = 0;
  for (const PlacedBox& box : loading.boxes) volume += box.place.volume();
  loading.fill = volume / Cuboid{{0, 0, 0}, instance_.container}.volume();
  return loading;
}
