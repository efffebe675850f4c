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
  const int k = contact.across;
  const Vec3& point = contact.points[0].on_a;
  const bool b_above = bodies.shape[static_cast<std::size_t>(b)].centre[k] > box_of(bodies, sides, a).centre[k];
  const double sunk = below(bodies, manifolds, k, b, point) - below(bodies, manifolds, k, a, point);
  return contact.width - (b_above ? sunk : -sunk) < kFlushWidth;
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
  for (auto& of_direction : supports) of_direction.clear();
  std::vector<ContactSet>& contacts = contacts_[static_cast<std::size_t>(k)];
  contacts.clear();
  const auto add = [&](bool up, std::int32_t body, std::int32_t lower) {
    if (is_fixed(bodies, body)) return;
    supports[up ? 1 : 0].push_back({body, lower, contacts.size() - 1});
  };
  for (const Manifold& manifold : manifolds) {
    const double along = manifold.contact.normal[k];
    if (manifold.contact.count == 0 || manifold.nearest_gap > kContactTolerance) continue;
    if (std::abs(along) < kSupporting) continue;
    contacts.push_back(manifold.contact);
    add(along > 0.0, manifold.b, manifold.a);
    add(along < 0.0, manifold.a, manifold.b);
  }
  for (auto& of_direction : supports)
    std::sort(of_direction.begin(), of_direction.end(), [](const Support& first, const Support& second) {
      return first.body < second.body || (first.body == second.body && first.lower < second.lower);
    });
}

/// Goes down from contact to contact, each below `height` along the direction. None where this ends at nothing fixed.
std::optional<double> Sinking::sunk(const Bodies& bodies, int k, bool up, std::int32_t body, const Vec3& point,
                                    double height) const {
  if (is_fixed(bodies, body)) return 0.0;
  const std::vector<Support>& supports = supports_[static_cast<std::size_t>(k)][up ? 1 : 0];
  const auto before = [](const Support& support, std::int32_t of) { return support.body < of; };
  const Support* nearest = nullptr;
  const ContactPoint* carried = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (auto it = std::lower_bound(supports.begin(), supports.end(), body, before);
       it != supports.end() && it->body == body; ++it) {
    const ContactSet& contact = contacts_[static_cast<std::size_t>(k)][it->contact];
    for (std::size_t i = 0; i < static_cast<std::size_t>(contact.count); ++i) {
      const ContactPoint& at = contact.points[i];
      if ((up ? at.on_a[k] : -at.on_a[k]) >= height) continue;
      Vec3 apart = at.on_a - point;
      apart[k] = 0.0;
      if (apart.squaredNorm() >= least) continue;
      least = apart.squaredNorm();
      nearest = &*it;
      carried = &at;
    }
  }
  if (nearest == nullptr) return std::nullopt;
  const double at_height = up ? carried->on_a[k] : -carried->on_a[k];
  const std::optional<double> lower = sunk(bodies, k, up, nearest->lower, carried->on_a, at_height);
  if (!lower) return std::nullopt;
  // An end that is raised counts, too: boxes of a row lean on each other, each by what all before it overlap.
  return *lower - carried->gap;
}

}  // namespace holdfast::internal::native
