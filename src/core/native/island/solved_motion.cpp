#include "core/native/island/solved_motion.hpp"

#include "core/native/rotation_step.hpp"

namespace holdfast::internal::native {

/// Whether a body has its new velocity from the start of the step: in a step of implicit Euler, or because an impact
/// too slow to be located makes it jump there. With the old one bodies would overlap.
bool SolvedMotion::jumps(const Bodies& bodies, std::uint32_t body, const StepTerms& terms, double step) const {
  if (terms.implicit) return true;
  if (!solved_.has_late_impact()) return false;
  if (solved_.has_late_impact(body)) return true;
  // Where the effective gravity has just changed, every velocity jumps: only bodies at a late impact count.
  if (terms.reset_warm_start) return false;
  const BodyVector& end = solved_.solution(body);
  const Vec3 change = linear(end) - bodies.state.velocity[body] - step * bodies.last_step[body].acceleration;
  const Vec3 turn =
      angular(end) - bodies.state.angular_velocity[body] - step * bodies.last_step[body].angular_acceleration;
  return change.norm() + bodies.radius[body] * turn.norm() > kNoticeable * terms.velocity_unit;
}

void SolvedMotion::find(const Bodies& bodies, const IslandView& island, const StepTerms& terms, double step) {
  mean_velocity_.resize(bodies.count());
  jumps_.resize(bodies.count());
  for (const std::uint32_t body : island.bodies) {
    const Vec3 v = linear(solved_.solution(body));
    const Vec3 w = angular(solved_.solution(body));
    jumps_[body] = jumps(bodies, body, terms, step) ? 1 : 0;
    // The trapezoid is exact under constant forces.
    mean_velocity_[body] = jumps_[body] != 0 ? body_vector(v, w)
                                             : body_vector(0.5 * (bodies.state.velocity[body] + v),
                                                           0.5 * (bodies.state.angular_velocity[body] + w));
  }
}

Twist SolvedMotion::at_end(const Bodies& bodies, std::int32_t body) const {
  if (stays(bodies, body)) return {};
  const BodyVector& v = solved_.solution(static_cast<std::uint32_t>(body));
  return {bodies.state.position[at(body)], linear(v), angular(v)};
}

Twist SolvedMotion::mean(const Bodies& bodies, std::int32_t body) const {
  if (stays(bodies, body)) return {};
  const BodyVector& v = mean_velocity_[at(body)];
  return {bodies.state.position[at(body)], linear(v), angular(v)};
}

Vec3 SolvedMotion::end_velocity(const Bodies& bodies, const Manifold& manifold, const ContactPoint& point) const {
  return at_end(bodies, manifold.b).at_point(point.on_b) - at_end(bodies, manifold.a).at_point(point.on_a);
}

double SolvedMotion::end_normal_velocity(const Bodies& bodies, const Manifold& manifold,
                                         const ContactPoint& point) const {
  return manifold.contact.normal.dot(end_velocity(bodies, manifold, point));
}

void SolvedMotion::move(Bodies& bodies, const IslandView& island, double step, double share) const {
  const double time = share * step;
  for (const std::uint32_t body : island.bodies) {
    Vec3& v = bodies.state.velocity[body];
    Vec3& w = bodies.state.angular_velocity[body];
    const Vec3 v_end = linear(solved_.solution(body));
    const Vec3 w_end = angular(solved_.solution(body));
    const bool whole = share == 1.0;
    const bool jump = whole && jumps_[body] != 0;
    const Vec3 v_new = whole ? v_end : Vec3(v + share * (v_end - v));
    Vec3 w_new = whole ? w_end : Vec3(w + share * (w_end - w));
    const Vec3 v_mean = whole ? linear(mean_velocity_[body]) : Vec3(0.5 * (v + v_new));
    const Vec3 w_mean = whole ? angular(mean_velocity_[body]) : Vec3(0.5 * (w + w_new));
    LastStep& last = bodies.last_step[body];
    last.acceleration = jump ? Vec3::Zero() : Vec3((v_end - v) / step);
    last.angular_acceleration = jump ? Vec3::Zero() : Vec3((w_end - w) / step);
    const BodyVector& missing = solved_.missing_velocity(body);
    last.missing_velocity += share * (linear(missing) - last.missing_velocity);
    last.missing_angular_velocity += share * (angular(missing) - last.missing_angular_velocity);
    bodies.state.position[body] += time * v_mean;
    rotate(bodies.state.orientation[body], time * w_mean);
    bodies.update_shape(body);
    if (whole && solved_.turns(body))
      w_new = bodies.inertia(body).inverse() * (solved_.problem.bodies[solved_.row(body)].inertia * w_end);
    v = v_new;
    w = w_new;
  }
}

}  // namespace holdfast::internal::native
