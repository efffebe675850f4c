#include "core/native/solver/gauss_seidel.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/native/constants.hpp"

namespace holdfast::internal::native {

namespace {

Vec3 at_lane(const std::array<Lanes, 3>& rows, std::size_t lane) {
  return {rows[0][lane], rows[1][lane], rows[2][lane]};
}

/// Cuts the tangential part of an impulse to its disc.
void cut(double friction, Vec3& impulse) {
  const double limit = friction * impulse[0];
  const double size = impulse.tail<2>().norm();
  if (size > limit) impulse.tail<2>() *= limit / size;
}

}  // namespace

SolveResult GaussSeidel::solve(ContactProblem& problem, const PointLimits& limits) {
  begin(problem);
  SolveResult result{.residual = std::numeric_limits<double>::infinity()};
  const auto most = [&] {
    return result.residual <= limits.worst_residual ? limits.visits : limits.visits + limits.more_visits;
  };
  for (std::size_t visits = 0; !result.converged && visits < most(); visits += points_.size()) {
    result.residual = 0.0;
    for (Point& point : points_) result.residual = std::max(result.residual, visit(point));
    ++result.iterations;
    result.converged = result.residual <= limits.tolerance;
  }
  finish(problem);
  // The largest of numbers and of what is none does not show that.
  const auto is_number = [](const Velocity& velocity) { return velocity.allFinite(); };
  if (!std::all_of(velocity_.begin(), velocity_.end(), is_number)) {
    result.residual = std::numeric_limits<double>::infinity();
    result.converged = false;
  }
  return result;
}

/// Bodies with the velocities that go with the impulses that are there.
void GaussSeidel::begin(const ContactProblem& problem) {
  const std::size_t bodies = problem.bodies.size();
  velocity_.assign(bodies + 1, Velocity::Zero());
  inverse_inertia_.resize(bodies);
  for (std::size_t i = 0; i < bodies; ++i) {
    velocity_[i] << linear(problem.free_velocity[i]), angular(problem.free_velocity[i]);
    inverse_inertia_[i] = problem.bodies[i].inertia.inverse();
  }
  points_.clear();
  for (std::size_t p = 0; p < problem.constraints.size(); ++p) {
    const ContactConstraint& constraint = problem.constraints[p];
    const Arms& mid_arms = problem.mid_arms.empty() ? constraint.arms : problem.mid_arms[p];
    Mat3 directions;
    for (std::size_t d = 0; d < 3; ++d)
      for (std::size_t k = 0; k < 3; ++k)
        directions(static_cast<Eigen::Index>(d), static_cast<Eigen::Index>(k)) = constraint.directions[d][k];
    for (std::size_t lane = 0; lane < static_cast<std::size_t>(constraint.count); ++lane) {
      Point& point = points_.emplace_back();
      point.a = side(problem, constraint.a, -directions, at_lane(constraint.arms.a, lane), at_lane(mid_arms.a, lane));
      point.b = side(problem, constraint.b, directions, at_lane(constraint.arms.b, lane), at_lane(mid_arms.b, lane));
      point.bias = at_lane(constraint.velocity_bias.row, lane);
      point.impulse = at_lane(constraint.impulse.row, lane);
      point.friction = constraint.friction;
      cut(point.friction, point.impulse);
      const Mat3 response = point.a.velocity_at * point.a.response + point.b.velocity_at * point.b.response;
      point.normal_response = response.col(0);
      point.tangential_response = response(1, 1) + response(2, 2);
      velocity_[point.a.body] += point.a.response * point.impulse;
      velocity_[point.b.body] += point.b.response * point.impulse;
    }
  }
}

GaussSeidel::Side GaussSeidel::side(const ContactProblem& problem, std::int32_t body, const Mat3& directions,
                                    const Vec3& arm, const Vec3& mid_arm) const {
  Side made;
  made.body = static_cast<std::size_t>(body);
  if (made.body == problem.bodies.size()) return made;
  for (Eigen::Index d = 0; d < 3; ++d) {
    const Vec3 along = directions.row(d).transpose();
    made.velocity_at.row(d) << along.transpose(), arm.cross(along).transpose();
    made.response.col(d) << along / problem.bodies[made.body].mass, inverse_inertia_[made.body] * mid_arm.cross(along);
  }
  return made;
}

/// J v + bias of a point.
Vec3 GaussSeidel::velocity(const Point& point) const {
  return point.a.velocity_at * velocity_[point.a.body] + point.b.velocity_at * velocity_[point.b.body] + point.bias;
}

/// Takes the impulse of a point near to that of its law, along the normal first. Returns by how much its velocity would
/// change if it were taken there, m/s.
double GaussSeidel::visit(Point& point) {
  Vec3 u = velocity(point);
  Vec3 y = point.impulse;
  // Where a contact slides, friction grows with the normal impulse. Where it then lifts the body, the normal velocity
  // changes by more than by the normal impulse alone, and a step that disregards it grows from sweep to sweep. This is
  // Newton's step along the ray through the impulse. Where friction presses the body on, that step may have no sign.
  const double lifted = y[0] > 0.0 ? point.normal_response.tail<2>().dot(y.tail<2>()) / y[0] : 0.0;
  const double normal_response = point.normal_response[0] + std::max(0.0, lifted);
  y[0] = std::max(0.0, y[0] - u[0] / normal_response);
  u += (y[0] - point.impulse[0]) * point.normal_response;
  y.tail<2>() -= u.tail<2>() / point.tangential_response;
  cut(point.friction, y);
  const Vec3 missing = y - point.impulse;
  // Friction cones are convex: the impulse stays in its own.
  const Vec3 change = kGaussSeidelRelaxation * missing;
  point.impulse += change;
  velocity_[point.a.body] += point.a.response * change;
  velocity_[point.b.body] += point.b.response * change;
  return std::max(normal_response * std::abs(missing[0]), point.tangential_response * missing.tail<2>().norm());
}

/// Contact velocities are those of the bodies, which go with the impulses but for the residual.
void GaussSeidel::finish(ContactProblem& problem) const {
  for (std::size_t i = 0; i < problem.bodies.size(); ++i)
    problem.velocity[i] = body_vector(velocity_[i].head<3>(), velocity_[i].tail<3>());
  auto point = points_.begin();
  for (ContactConstraint& constraint : problem.constraints) {
    for (std::size_t lane = 0; lane < static_cast<std::size_t>(constraint.count); ++lane, ++point) {
      const Vec3 u = velocity(*point);
      for (std::size_t d = 0; d < 3; ++d) {
        constraint.impulse.row[d][lane] = point->impulse[static_cast<Eigen::Index>(d)];
        constraint.contact_velocity.row[d][lane] = u[static_cast<Eigen::Index>(d)];
      }
    }
  }
  problem.continues = false;
}

}  // namespace holdfast::internal::native
