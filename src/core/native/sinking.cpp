#include "core/native/sinking.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/native/contact_kinematics.hpp"

namespace holdfast::internal::native {

namespace {

/// Where a body is, or what there is of a side.
OrientedBox box_of(const Bodies& bodies, const std::vector<Side>& sides, std::int32_t index) {
  if (index >= 0) return bodies.shape[static_cast<std::size_t>(index)];
  return *sides[static_cast<std::size_t>(-1 - index)].block;
}

}  // namespace

bool is_narrow(const Bodies& bodies, const std::vector<Side>& sides, std::int32_t a, std::int32_t b,
               const ContactSet& contact, const ContactWidth& width) {
  if (contact.count == 0 || width.length > kNarrowWidth) return false;
  const OrientedBox of_a = box_of(bodies, sides, a);
  const OrientedBox& of_b = bodies.shape[static_cast<std::size_t>(b)];
  const int k = width.across;
  return std::abs(of_b.centre[k] - of_a.centre[k]) >
         std::abs(of_b.bounding_half_extents()[k] - of_a.bounding_half_extents()[k]);
}

bool Sinking::is_flush(const Bodies& bodies, const std::vector<Side>& sides, const std::vector<Manifold>& manifolds,
                       std::int32_t a, std::int32_t b, const ContactSet& contact) {
  return std::any_of(contact.widths.begin(), contact.widths.end(), [&](const ContactWidth& width) {
    if (!is_narrow(bodies, sides, a, b, contact, width)) return false;
    const int k = width.across;
    const bool b_above = bodies.shape[static_cast<std::size_t>(b)].centre[k] > box_of(bodies, sides, a).centre[k];
    // The width reaches from the lowest corner of the upper box to the highest one of the lower box.
    const auto [lowest, highest] = std::minmax_element(
        contact.points.begin(), contact.points.begin() + contact.count,
        [&](const ContactPoint& first, const ContactPoint& second) { return first.on_a[k] < second.on_a[k]; });
    const double of_upper = below(bodies, manifolds, k, b_above ? b : a, lowest->on_a);
    const double of_lower = below(bodies, manifolds, k, b_above ? a : b, highest->on_a);
    return width.length - (of_upper - of_lower) < kFlushWidth;
  });
}

double Sinking::below(const Bodies& bodies, const std::vector<Manifold>& manifolds, int k, std::int32_t body,
                      const Vec3& point) {
  bool& known = known_[static_cast<std::size_t>(k)];
  if (!known) find_supports(bodies, manifolds, k);
  known = true;
  constexpr double kAnyHeight = std::numeric_limits<double>::infinity();
  return sunk(bodies, k, true, body, point, kAnyHeight).value_or(0.0) -
         sunk(bodies, k, false, body, point, kAnyHeight).value_or(0.0);
}

void Sinking::find_supports(const Bodies& bodies, const std::vector<Manifold>& manifolds, int k) {
  auto& supports = supports_[static_cast<std::size_t>(k)];
  for (Supports& of_direction : supports) {
    of_direction.first.assign(bodies.count(), -1);
    of_direction.all.clear();
  }
  const auto add = [&](bool up, const ContactSet& contact, std::int32_t body, std::int32_t lower) {
    if (is_fixed(bodies, body)) return;
    Supports& of_direction = supports[up ? 1 : 0];
    std::int32_t& first = of_direction.first[static_cast<std::size_t>(body)];
    for (std::size_t i = 0; i < static_cast<std::size_t>(contact.count); ++i) {
      of_direction.all.push_back({lower, first, contact.points[i].on_a, contact.points[i].gap});
      first = static_cast<std::int32_t>(of_direction.all.size()) - 1;
    }
  };
  for (const Manifold& manifold : manifolds) {
    const double along = manifold.contact.normal[k];
    if (manifold.contact.count == 0 || std::abs(along) < kSupporting) continue;
    // A hit may lift a box by more off what it still stands on.
    if (manifold.nearest_gap > kContactTolerance && !manifold.carries()) continue;
    add(along > 0.0, manifold.contact, manifold.b, manifold.a);
    add(along < 0.0, manifold.contact, manifold.a, manifold.b);
  }
}

/// Goes down from contact to contact, each below `height` along the direction. None where this ends at nothing fixed.
std::optional<double> Sinking::sunk(const Bodies& bodies, int k, bool up, std::int32_t body, const Vec3& point,
                                    double height) const {
  if (is_fixed(bodies, body)) return 0.0;
  const Supports& supports = supports_[static_cast<std::size_t>(k)][up ? 1 : 0];
  const Support* nearest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (std::int32_t i = supports.first[static_cast<std::size_t>(body)]; i >= 0;) {
    const Support& support = supports.all[static_cast<std::size_t>(i)];
    i = support.next;
    if ((up ? support.point[k] : -support.point[k]) >= height) continue;
    Vec3 apart = support.point - point;
    apart[k] = 0.0;
    const double square = apart.squaredNorm();
    // Of equally near ones not the first that is found, but that of the first body.
    if (square > least || (nearest != nullptr && square == least && support.lower > nearest->lower)) continue;
    least = square;
    nearest = &support;
  }
  if (nearest == nullptr) return std::nullopt;
  const double at_height = up ? nearest->point[k] : -nearest->point[k];
  const std::optional<double> lower = sunk(bodies, k, up, nearest->lower, nearest->point, at_height);
  if (!lower) return std::nullopt;
  // An end that is raised counts, too: boxes of a row lean on each other, each by what all before it overlap.
  return *lower - nearest->gap;
}

}  // namespace holdfast::internal::native
