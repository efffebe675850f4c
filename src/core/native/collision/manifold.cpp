#include "core/native/collision/manifold.hpp"

#include <algorithm>
#include <cmath>

#include "core/native/constants.hpp"

namespace holdfast::internal::native {

namespace {

/// Where a point of the body is now.
Vec3 carried(const OrientedBox& then, const OrientedBox& now, const Vec3& point) {
  const Vec3 arm = point - then.centre;
  if (then.aligned && now.aligned) return now.centre + arm;
  return now.centre + now.axes * (then.axes.transpose() * arm);
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
  return {a < 0 ? OrientedBox{} : bodies.shape[static_cast<std::size_t>(a)], bodies.shape[static_cast<std::size_t>(b)]};
}

ContactSet carried_along(const ContactSet& contact, const std::array<OrientedBox, 2>& then,
                         const std::array<OrientedBox, 2>& now) {
  ContactSet moved = contact;
  for (std::size_t i = 0; i < static_cast<std::size_t>(contact.count); ++i) {
    ContactPoint& point = moved.points[i];
    point.on_a = carried(then[0], now[0], point.on_a);
    point.on_b = carried(then[1], now[1], point.on_b);
    point.gap = contact.normal.dot(point.on_b - point.on_a);
  }
  return moved;
}

void update_contact(Manifold& manifold, const ContactSet& contact, const Bodies& bodies) {
  const std::array<OrientedBox, 2> now = poses_of(bodies, manifold.a, manifold.b);
  const auto old_count = static_cast<std::size_t>(manifold.contact.count);
  const auto count = static_cast<std::size_t>(contact.count);
  std::array<ContactPoint, 8> old;
  for (std::size_t j = 0; j < old_count; ++j) {
    old[j].on_a = carried(manifold.found_at[0], now[0], manifold.contact.points[j].on_a);
    old[j].on_b = carried(manifold.found_at[1], now[1], manifold.contact.points[j].on_b);
  }
  // A point may slide over one of the two bodies.
  const auto square = [&](std::size_t i, std::size_t j) {
    return std::min((contact.points[i].on_a - old[j].on_a).squaredNorm(),
                    (contact.points[i].on_b - old[j].on_b).squaredNorm());
  };
  bool same = count == old_count && contact.axis == manifold.contact.axis;
  for (std::size_t i = 0; same && i < count; ++i) same = square(i, i) < kMatchDistanceInOrder * kMatchDistanceInOrder;
  if (!same) {
    std::array<CachedImpulse, 8> cached;
    for (std::size_t i = 0; i < count; ++i) {
      double nearest = kMatchDistance * kMatchDistance;
      for (std::size_t j = 0; j < old_count; ++j) {
        if (square(i, j) >= nearest) continue;
        nearest = square(i, j);
        cached[i] = manifold.cached[j];
      }
    }
    manifold.cached = cached;
  }
  manifold.contact = contact;
  manifold.found_at = now;
}

ContactSet contact_now(const Bodies& bodies, const std::vector<Side>& sides, std::int32_t a, std::int32_t b,
                       double margin, const ContactAxis& previous) {
  const OrientedBox& box = bodies.shape[static_cast<std::size_t>(b)];
  if (a < 0) {
    const Side& side = sides[static_cast<std::size_t>(-1 - a)];
    return contact_of({side.space.normal, side.space.offset - side.play[static_cast<std::size_t>(b)]}, box, margin);
  }
  return contact_of(bodies.shape[static_cast<std::size_t>(a)], box, margin, previous);
}

}  // namespace holdfast::internal::native
