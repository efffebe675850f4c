#include "core/native/manifold.hpp"

#include <algorithm>
#include <cmath>

namespace holdfast::native {

namespace {

/// A point moves less than this within a step as long as it is the same point, m.
constexpr double kSamePoint = 0.02;

/// Square of the nearer of the distances on either body: a point may slide over one of the two.
double square_distance(const ContactPoint& p, const ContactPoint& q) {
  return std::min((p.on_a - q.on_a).squaredNorm(), (p.on_b - q.on_b).squaredNorm());
}

}  // namespace

std::array<Vec3, 3> directions_of(const Vec3& normal) {
  // The first tangent lies in the plane of the axes to which the normal leans least.
  const bool along_x = std::abs(normal.x()) > std::max(std::abs(normal.y()), std::abs(normal.z()));
  const Vec3 other = along_x ? Vec3(Vec3::UnitY()) : Vec3(Vec3::UnitX());
  const Vec3 first = (other - normal * normal.dot(other)).normalized();
  return {normal, first, normal.cross(first)};
}

void renew_contact(Manifold& manifold, const ContactSet& contact) {
  const ContactSet old = manifold.contact;
  const std::array<PointMemory, 8> memory = manifold.memory;
  manifold.contact = contact;
  for (int i = 0; i < contact.count; ++i) {
    const auto& point = contact.points[static_cast<std::size_t>(i)];
    double nearest = kSamePoint * kSamePoint;
    PointMemory& now = manifold.memory[static_cast<std::size_t>(i)];
    now = PointMemory{};
    for (int j = 0; j < old.count; ++j) {
      const double d = square_distance(point, old.points[static_cast<std::size_t>(j)]);
      if (d >= nearest) continue;
      nearest = d;
      now = memory[static_cast<std::size_t>(j)];
    }
  }
}

ContactSet contact_now(const Bodies& bodies, const std::vector<Side>& sides, std::int32_t a, std::int32_t b,
                       double margin, const ContactAxis& previous) {
  const OrientedBox& box = bodies.shape[static_cast<std::size_t>(b)];
  if (a < 0) return contact_of(sides[static_cast<std::size_t>(-1 - a)].space, box, margin);
  return contact_of(bodies.shape[static_cast<std::size_t>(a)], box, margin, previous);
}

}  // namespace holdfast::native
