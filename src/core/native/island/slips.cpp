#include "core/native/island/slips.hpp"

#include <algorithm>
#include <cmath>

#include "core/native/contact_kinematics.hpp"

namespace holdfast::internal::native {

namespace {

/// The part of a velocity that is along the contact's surfaces.
Vec3 tangential(const Manifold& manifold, const Vec3& velocity) {
  return velocity - manifold.contact.normal * manifold.contact.normal.dot(velocity);
}

/// The largest slip of a contact's points that carry, m/s. A corner that is lifted moves sideways too, and slips on
/// nothing.
/// @param carries `bool(int)`: whether a point counts
/// @param velocity_of `Vec3(const ContactPoint&)`: of b's surface relative to a's, m/s
template <class Carries, class VelocityOf>
double largest_slip(const Manifold& manifold, Carries carries, VelocityOf velocity_of) {
  double largest = 0.0;
  for (int i = 0; i < manifold.contact.count; ++i)
    if (carries(i))
      largest = std::max(largest, tangential(manifold, velocity_of(manifold.contact.points[at(i)])).norm());
  return largest;
}

/// Slip from which friction is kinetic, m/s.
double kinetic_slip(const StepTerms& terms, const Effort& effort) {
  return std::max(kSmall, effort.mean_residual) * terms.velocity_unit;
}

/// Slip from which friction becomes kinetic within a step, m/s: what does not stick slips, however slowly. All that the
/// solve may leave of it does not count.
/// @param residual of the solve that the slip is from, m/s
double beginning_slip(const StepTerms& terms, const Effort& effort, double residual) {
  return std::min(kinetic_slip(terms, effort),
                  kResidualSlip * std::max(effort.reset_tolerance * terms.velocity_unit, residual));
}

/// The time of an event, or the whole step where a cut right at its start or its end would change nothing.
double worth_a_cut(const StepTerms& terms, double time, double step) {
  return time > kLeastCut * terms.step && time < step - kLeastCut * terms.step ? time : step;
}

}  // namespace

void find_sliding(Scene& scene, const IslandView& island, const StepTerms& terms, const Effort& effort) {
  for (const std::uint32_t index : island.manifolds) {
    Manifold& manifold = scene.manifolds[index];
    if (manifold.kinetic_friction == manifold.friction) continue;
    const double slow = manifold.slides ? kNegligible * terms.velocity_unit : kinetic_slip(terms, effort);
    const auto carries = [&](int i) {
      const ContactPoint& point = manifold.contact.points[at(i)];
      return manifold.carries(i) || point.gap + terms.step * normal_velocity(scene.bodies, manifold, point) <= 0.0;
    };
    manifold.slides = largest_slip(manifold, carries, [&](const ContactPoint& point) {
                        return relative_velocity(scene.bodies, manifold, point);
                      }) > slow;
  }
}

void Slips::find_ended(Scene& scene, const IslandView& island, const StepTerms& terms, double residual) const {
  const double slow = std::max(kNegligible * terms.velocity_unit, kResidualSlip * residual);
  for (const std::uint32_t index : island.manifolds) {
    Manifold& manifold = scene.manifolds[index];
    const auto carries = [&](int i) { return manifold.carries(i); };
    manifold.slides = manifold.slides && largest_slip(manifold, carries, [&](const ContactPoint& point) {
                                           return motion_.end_velocity(scene.bodies, manifold, point);
                                         }) > slow;
  }
}

bool Slips::find_begun(Scene& scene, const StepTerms& terms, const Effort& effort, double residual) const {
  const double slow = beginning_slip(terms, effort, residual);
  bool any = false;
  for (std::size_t p = 0; p < solved_.sources.size(); ++p) {
    Manifold& manifold = scene.manifolds[solved_.sources[p].manifold];
    if (manifold.slides || manifold.kinetic_friction == manifold.friction) continue;
    const ContactConstraint& constraint = solved_.problem.constraints[p];
    const auto& y = constraint.impulse.row;
    const auto& u = constraint.contact_velocity.row;
    for (std::size_t lane = 0; lane < static_cast<std::size_t>(constraint.count) && !manifold.slides; ++lane) {
      const double most = kSlidingShare * constraint.friction * y[0][lane];
      if (!(y[0][lane] > 0.0) || y[1][lane] * y[1][lane] + y[2][lane] * y[2][lane] < most * most) continue;
      // As the solve has it: the arms of a body that turns differ at the end of the step, and so does its slip.
      manifold.slides = std::hypot(u[1][lane], u[2][lane]) > slow;
    }
    any = any || manifold.slides;
  }
  return any;
}

template <class Visit>
void Slips::for_each_slip(const Scene& scene, const StepTerms& terms, double residual, Visit visit) const {
  for (std::size_t p = 0; p < solved_.sources.size(); ++p) {
    const Manifold& manifold = scene.manifolds[solved_.sources[p].manifold];
    if (manifold.friction == 0.0) continue;
    for (std::size_t lane = 0; lane < static_cast<std::size_t>(solved_.problem.constraints[p].count); ++lane) {
      if (!(solved_.problem.constraints[p].impulse.row[0][lane] > 0.0)) continue;
      const ContactPoint& point = manifold.contact.points[solved_.sources[p].point[lane]];
      const Vec3 slip = tangential(manifold, relative_velocity(scene.bodies, manifold, point));
      if (slip.norm() <= kNegligible * terms.velocity_unit) continue;
      const Vec3 end = tangential(manifold, motion_.end_velocity(scene.bodies, manifold, point));
      visit(manifold, point, slip, end.norm() > kResidualSlip * residual ? end : Vec3(Vec3::Zero()));
    }
  }
}

/// How a slip changes at the beginning of the part, m/s²: as in the last step. Where the effective gravity has changed
/// since, on something fixed, as of a block that slides there alone; elsewhere what does not stand gains the change,
/// and friction what it presses more.
/// @param changed the effective gravity has
Vec3 Slips::rate(const Scene& scene, const StepTerms& terms, bool changed, const Manifold& manifold,
                 const ContactPoint& point, const Vec3& slip) const {
  const Bodies& bodies = scene.bodies;
  const Vec3& g = terms.effective_gravity;
  const auto friction_under = [&](const Vec3& gravity) -> Vec3 {
    return manifold.friction_now() * std::max(0.0, -gravity.dot(manifold.contact.normal)) * slip.normalized();
  };
  if (changed && is_fixed(bodies, manifold.a)) return tangential(manifold, g) - friction_under(g);
  const Vec3 gained = changed ? terms.gravity_change : Vec3(Vec3::Zero());
  const auto of = [&](std::int32_t body, const Vec3& at_body) -> Vec3 {
    if (stays(bodies, body)) return Vec3::Zero();
    const LastStep& last = bodies.last_step[at(body)];
    const Vec3 before = last.acceleration + last.angular_acceleration.cross(at_body - bodies.state.position[at(body)]);
    const bool stands = bodies.largest_speed(at(body)) <= kNegligible * terms.velocity_unit;
    return stands ? before : before + gained;
  };
  const Vec3 friction_gained = friction_under(g) - friction_under(g - gained);
  return tangential(manifold, of(manifold.b, point.on_b) - of(manifold.a, point.on_a)) - friction_gained;
}

double Slips::first_change(const Scene& scene, const StepTerms& terms, double residual, bool uncut, bool turns,
                           double step) const {
  const bool changed = terms.reset_warm_start && uncut;
  double first = step;
  for_each_slip(scene, terms, residual,
                [&](const Manifold& manifold, const ContactPoint& point, const Vec3& slip, const Vec3& end) {
                  const double speed = slip.norm();
                  Vec3 turned = end;
                  // A slip that keeps some speed in its direction goes on.
                  if (end.dot(slip) <= kNegligible * speed * speed) {
                    const Vec3 change = rate(scene, terms, changed, manifold, point, slip);
                    const double slowing = -slip.dot(change) / speed;
                    if (slowing > 0.0) {
                      first = std::min(first, speed / slowing);
                      // Until it ends it turns towards this.
                      turned = change;
                    }
                  }
                  if (turns && slip.cross(turned).norm() > kSmall * speed * turned.norm())
                    first = std::min(first, (1.0 - kSlack) * speed / terms.lasting_slip(1.0));
                });
  return worth_a_cut(terms, first, step);
}

}  // namespace holdfast::internal::native
