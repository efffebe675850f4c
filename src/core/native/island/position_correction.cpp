#include "core/native/island/position_correction.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/native/contact_kinematics.hpp"

namespace holdfast::internal::native {

namespace {

/// How a contact point pushes its bodies apart: what an impulse of 1 along the normal does.
struct PushedPoint {
  Vec3 lever_a, lever_b;        ///< arm × normal, m
  Vec3 response_a, response_b;  ///< rotation vector of b, and of a against it, rad
  double compliance = 0.0;      ///< how far the surfaces separate, m
};

}  // namespace

/// Lists which contacts each body has.
void PositionCorrection::find_contacts_of_bodies(const Scene& scene, const IslandView& island) {
  const Bodies& bodies = scene.bodies;
  const auto for_each_end = [&](auto&& act) {
    for (std::uint32_t c = 0; c < island.manifolds.size(); ++c) {
      const Manifold& manifold = scene.manifolds[island.manifolds[c]];
      if (!is_fixed(bodies, manifold.a)) act(at(manifold.a), c);
      if (!is_fixed(bodies, manifold.b)) act(at(manifold.b), c);
    }
  };
  // Counted one entry ahead, so that filling in moves each begin to where it belongs.
  first_of_body_.assign(bodies.count() + 2, 0);
  for_each_end([&](std::size_t body, std::uint32_t) { ++first_of_body_[body + 2]; });
  for (std::size_t i = 2; i < first_of_body_.size(); ++i) first_of_body_[i] += first_of_body_[i - 1];
  of_bodies_.resize(first_of_body_.back());
  for_each_end([&](std::size_t body, std::uint32_t c) { of_bodies_[first_of_body_[body + 1]++] = c; });
}

PositionCorrection::Displacement& PositionCorrection::displacement_of(const Bodies& bodies, std::int32_t body) {
  if (is_fixed(bodies, body)) return fixed_;
  Displacement& displacement = displacements_[at(body)];
  if (displacement.inverse_mass == 0.0) {
    displacement.inverse_mass = 1.0 / bodies.mass[at(body)];
    displacement.inverse_inertia = bodies.inertia(at(body)).inverse();
  }
  return displacement;
}

/// Displaces the two bodies of a contact until it does not overlap, or holds them apart no farther than it has to.
/// False where it need not.
bool PositionCorrection::separate(const Bodies& bodies, const Manifold& manifold, double tolerance,
                                  std::array<double, 8>& impulse) {
  const Vec3& normal = manifold.contact.normal;
  const std::span points(manifold.contact.points.data(), at(manifold.contact.count));
  Displacement& a = displacement_of(bodies, manifold.a);
  Displacement& b = displacement_of(bodies, manifold.b);
  std::array<PushedPoint, 8> pushed;
  const auto lever = [&](std::int32_t body, const Vec3& point) -> Vec3 {
    if (is_fixed(bodies, body)) return Vec3::Zero();
    return (point - bodies.state.position[at(body)]).cross(normal);
  };
  // Surfaces that touch stay in touch.
  const auto gap = [&](std::size_t i) {
    return points[i].gap + kTouch + normal.dot(b.shift - a.shift) + pushed[i].lever_b.dot(b.turn) -
           pushed[i].lever_a.dot(a.turn);
  };
  bool any = false;
  for (std::size_t i = 0; i < points.size(); ++i) {
    pushed[i].lever_a = lever(manifold.a, points[i].on_a);
    pushed[i].lever_b = lever(manifold.b, points[i].on_b);
    any = any || gap(i) < -tolerance || (impulse[i] > 0.0 && gap(i) > tolerance);
  }
  if (!any) return false;
  for (std::size_t i = 0; i < points.size(); ++i) {
    pushed[i].response_a = a.inverse_inertia * pushed[i].lever_a;
    pushed[i].response_b = b.inverse_inertia * pushed[i].lever_b;
    pushed[i].compliance = a.inverse_mass + b.inverse_mass + pushed[i].lever_a.dot(pushed[i].response_a) +
                           pushed[i].lever_b.dot(pushed[i].response_b);
  }
  for (int sweep = 0; sweep < kCorrectionSweeps; ++sweep) {
    double largest = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double change = std::max(-impulse[i], -gap(i) / pushed[i].compliance);
      impulse[i] += change;
      a.shift -= change * a.inverse_mass * normal;
      b.shift += change * b.inverse_mass * normal;
      a.turn -= change * pushed[i].response_a;
      b.turn += change * pushed[i].response_b;
      largest = std::max(largest, std::abs(change) * pushed[i].compliance);
    }
    if (largest <= tolerance) break;
  }
  return true;
}

void PositionCorrection::visit_later(std::uint32_t contact) {
  if (waits_[contact] != 0) return;
  waits_[contact] = 1;
  visits_.push_back(contact);
}

void PositionCorrection::find(const Scene& scene, const IslandView& island, double tolerance) {
  const Bodies& bodies = scene.bodies;
  const std::size_t count = island.manifolds.size();
  fixed_ = {};
  displacements_.assign(bodies.count(), {});
  impulses_.assign(count, {});
  waits_.assign(count, 0);
  visits_.clear();
  find_contacts_of_bodies(scene, island);
  for (std::uint32_t c = 0; c < count; ++c)
    if (scene.manifolds[island.manifolds[c]].nearest_gap < -tolerance) visit_later(c);
  // What is wedged between sides of the container overlaps for ever.
  const std::size_t most = kRepairRounds * count;
  for (std::size_t visit = 0; visit < std::min(visits_.size(), most); ++visit) {
    const std::uint32_t contact = visits_[visit];
    const Manifold& manifold = scene.manifolds[island.manifolds[contact]];
    waits_[contact] = 0;
    if (!separate(bodies, manifold, tolerance, impulses_[contact])) continue;
    for (const std::int32_t body : {manifold.a, manifold.b}) {
      if (is_fixed(bodies, body)) continue;
      displacements_[at(body)].moves = true;
      for (std::uint32_t i = first_of_body_[at(body)]; i < first_of_body_[at(body) + 1]; ++i)
        visit_later(of_bodies_[i]);
    }
  }
}

}  // namespace holdfast::internal::native
