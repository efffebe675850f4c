#include "core/native/sinking.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/native/constants.hpp"

namespace holdfast::internal::native {

namespace {

/// Where a body is, or what there is of a side.
OrientedBox box_of(const Bodies& bodies, const std::vector<Side>& sides, std::int32_t index) {
  if (index >= 0) return bodies.shape[static_cast<std::size_t>(index)];
  return *sides[static_cast<std::size_t>(-1 - index)].block;
}

}  // namespace

bool is_narrow(const Bodies& bodies, const std::vector<Side>& sides, std::int32_t a, std::int32_t b,
               const ContactSet& contact) {
  if (contact.count == 0 || contact.width > kNarrowWidth) return false;
  const OrientedBox of_a = box_of(bodies, sides, a);
  const OrientedBox& of_b = bodies.shape[static_cast<std::size_t>(b)];
  const int k = contact.across;
  return std::abs(of_b.centre[k] - of_a.centre[k]) >
         std::abs(of_b.bounding_half_extents()[k] - of_a.bounding_half_extents()[k]);
}

bool Sinking::is_flush(const Bodies& bodies, const std::vector<Side>& sides, const std::vector<Manifold>& manifolds,
                       std::int32_t a, std::int32_t b, const ContactSet& contact) {
  if (!is_narrow(bodies, sides, a, b, contact)) return false;
  const auto j = static_cast<std::size_t>(b);
  const int k = contact.across;
  const bool b_above = bodies.shape[j].centre[k] > box_of(bodies, sides, a).centre[k];
  double sunk = below(bodies, manifolds, k, j);
  if (a >= 0) sunk -= below(bodies, manifolds, k, static_cast<std::size_t>(a));
  return contact.width - (b_above ? sunk : -sunk) < kFlushWidth;
}

double Sinking::below(const Bodies& bodies, const std::vector<Manifold>& manifolds, int k, std::size_t body) {
  const auto axis = static_cast<std::size_t>(k);
  if (!known_[axis]) {
    known_[axis] = true;
    below_[axis].assign(bodies.count(), 0.0);
    for (const double up : {1.0, -1.0}) add_up(bodies, manifolds, k, up);
  }
  return below_[axis][body];
}

/// Adds up overlaps, contact by contact in the direction `up` of the axis, from what is fixed on.
void Sinking::add_up(const Bodies& bodies, const std::vector<Manifold>& manifolds, int k, double up) {
  from_below_.clear();
  for (const Manifold& manifold : manifolds) {
    const ContactSet& contact = manifold.contact;
    if (contact.count == 0 || manifold.nearest_gap > kContactTolerance) continue;
    if (std::abs(contact.normal[k]) < kSupporting) continue;
    from_below_.emplace_back(up * contact.points[0].on_a[k], &manifold);
  }
  std::sort(from_below_.begin(), from_below_.end(), [](const auto& first, const auto& second) {
    const auto key = [](const auto& one) { return std::tuple(one.first, one.second->a, one.second->b); };
    return key(first) < key(second);
  });
  sum_.assign(bodies.count(), -1.0);
  for (std::size_t i = 0; i < bodies.count(); ++i)
    if (bodies.fixed[i] != 0) sum_[i] = 0.0;
  for (const auto& [height, manifold] : from_below_) {
    const bool b_above = up * manifold->contact.normal[k] > 0.0;
    const std::int32_t lower = b_above ? manifold->a : manifold->b;
    const std::int32_t upper = b_above ? manifold->b : manifold->a;
    if (upper < 0 || bodies.fixed[static_cast<std::size_t>(upper)] != 0) continue;
    const double below_lower = lower < 0 ? 0.0 : sum_[static_cast<std::size_t>(lower)];
    if (below_lower < 0.0) continue;
    double& sum = sum_[static_cast<std::size_t>(upper)];
    sum = std::max(sum, below_lower + std::max(0.0, -manifold->nearest_gap));
  }
  std::vector<double>& below = below_[static_cast<std::size_t>(k)];
  for (std::size_t i = 0; i < bodies.count(); ++i) below[i] += up * std::max(0.0, sum_[i]);
}

}  // namespace holdfast::internal::native
