#include "core/native/collision/manifold.hpp"

#include <algorithm>
#include <cmath>

#include "core/native/constants.hpp"

namespace holdfast::internal::native {

namespace {

/// How a body has moved from one pose to another.
class Motion {
 public:
  Motion(const OrientedBox& then, const OrientedBox& now)
      : from_(then.centre), to_(now.centre), turns_(!then.aligned || !now.aligned) {
    if (turns_) turn_ = now.axes * then.axes.transpose();
  }

  /// Where a point of the body is now.
  Vec3 operator()(const Vec3& point) const {
    const Vec3 arm = point - from_;
    return turns_ ? Vec3(to_ + turn_ * arm) : Vec3(to_ + arm);
  }

 private:
  Vec3 from_, to_;
  Mat3 turn_;
  bool turns_;
};

/// Carries each point's cached impulse over from the old point that, as part of one of the bodies, has come nearest.
/// @param now_a,now_b poses of the bodies, where the new contact was found
void match_points(Manifold& manifold, const ContactSet& contact, const OrientedBox& now_a, const OrientedBox& now_b) {
  const ContactSet& old = manifold.contact;
  const Motion of_a(manifold.found_at[0], now_a);
  const Motion of_b(manifold.found_at[1], now_b);
  // A point may slide over one of the two bodies.
  const auto square_on_a = [&](std::size_t i, std::size_t j) {
    return (contact.points[i].on_a - of_a(old.points[j].on_a)).squaredNorm();
  };
  const auto square_on_b = [&](std::size_t i, std::size_t j) {
    return (contact.points[i].on_b - of_b(old.points[j].on_b)).squaredNorm();
  };
  const auto count = static_cast<std::size_t>(contact.count);
  bool same = contact.count == old.count && contact.axis == old.axis;
  constexpr double kNear = kSamePoint * kSamePoint;
  for (std::size_t i = 0; same && i < count; ++i) same = square_on_b(i, i) < kNear || square_on_a(i, i) < kNear;
  if (same) return;
  std::array<CachedImpulse, 8> cached;
  for (std::size_t i = 0; i < count; ++i) {
    double nearest = kMatchDistance * kMatchDistance;
    for (std::size_t j = 0; j < static_cast<std::size_t>(old.count); ++j) {
      const double square = std::min(square_on_a(i, j), square_on_b(i, j));
      if (square >= nearest) continue;
      nearest = square;
      cached[i] = manifold.cached[j];
    }
  }
  manifold.cached = cached;
}

/// The side's block as it is for a body: moved back by its play.
OrientedBox block_for(const Side& side, std::int32_t body) {
  OrientedBox block = *side.block;
  block.centre -= side.play[static_cast<std::size_t>(body)] * side.space.normal;
  return block;
}

/// Where a body is; a side stays where it is.
const OrientedBox& pose_of(const Bodies& bodies, std::int32_t body) {
  static const OrientedBox kSide;
  return body < 0 ? kSide : bodies.shape[static_cast<std::size_t>(body)];
}

}  // namespace

std::array<Vec3, 3> directions_of(const Vec3& normal) {
  // The first tangent is along y where the normal is mostly along x, else along x, as far as it is across the normal.
  const bool along_x = std::abs(normal.x()) > std::max(std::abs(normal.y()), std::abs(normal.z()));
  const Vec3 other = along_x ? Vec3(Vec3::UnitY()) : Vec3(Vec3::UnitX());
  const Vec3 first = (other - normal * normal.dot(other)).normalized();
  return {normal, first, normal.cross(first)};
}

std::array<OrientedBox, 2> poses_of(const Bodies& bodies, std::int32_t a, std::int32_t b) {
  return {pose_of(bodies, a), pose_of(bodies, b)};
}

ContactSet carried_along(const ContactSet& contact, const std::array<OrientedBox, 2>& then,
                         const std::array<OrientedBox, 2>& now) {
  ContactSet moved = contact;
  const Motion of_a(then[0], now[0]);
  const Motion of_b(then[1], now[1]);
  for (std::size_t i = 0; i < static_cast<std::size_t>(contact.count); ++i) {
    ContactPoint& point = moved.points[i];
    point.on_a = of_a(point.on_a);
    point.on_b = of_b(point.on_b);
    point.gap = contact.normal.dot(point.on_b - point.on_a);
  }
  return moved;
}

void update_contact(Manifold& manifold, const ContactSet& contact, const Bodies& bodies) {
  const OrientedBox& now_a = pose_of(bodies, manifold.a);
  const OrientedBox& now_b = pose_of(bodies, manifold.b);
  if (manifold.active) match_points(manifold, contact, now_a, now_b);
  manifold.contact = contact;
  manifold.nearest_gap = contact.nearest_gap();
  manifold.found_at = {now_a, now_b};
}

ContactSet contact_now(const Bodies& bodies, const std::vector<Side>& sides, std::int32_t a, std::int32_t b,
                       double margin, const ContactAxis& previous) {
  const OrientedBox& box = bodies.shape[static_cast<std::size_t>(b)];
  if (a < 0) {
    const Side& side = sides[static_cast<std::size_t>(-1 - a)];
    if (side.block) return contact_of(block_for(side, b), box, margin, previous);
    return contact_of({side.space.normal, side.space.offset - side.play[static_cast<std::size_t>(b)]}, box, margin);
  }
  return contact_of(bodies.shape[static_cast<std::size_t>(a)], box, margin, previous);
}

}  // namespace holdfast::internal::native
