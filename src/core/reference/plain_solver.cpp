#include "core/reference/plain_solver.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace holdfast::internal::plain {

namespace {

/// The velocity at the point at `arm` that a unit impulse there gives a body: one column per direction of the impulse.
Eigen::Matrix3d response_of(const Mover& mover, const Vec3& arm) {
  Eigen::Matrix3d response;
  for (int i = 0; i < 3; ++i) {
    const Vec3 impulse = Vec3::Unit(i);
    const Vec3 spin = mover.inverse_inertia * arm.cross(impulse);
    response.col(i) = mover.inverse_mass * impulse + spin.cross(arm);
  }
  return response;
}

void push(Mover& mover, const Vec3& arm, const Vec3& impulse) {
  mover.velocity += mover.inverse_mass * impulse;
  mover.angular_velocity += mover.inverse_inertia * arm.cross(impulse);
}

/// One contact point with everything that the solver needs for it.
class Point {
 public:
  Point(const std::vector<Mover>& movers, const PointLaw& law) : law_(law) {
    const Eigen::Matrix3d response = response_of(movers[law.a], law.arm_a) + response_of(movers[law.b], law.arm_b);
    Eigen::Index least_aligned = 0;
    law.normal.cwiseAbs().minCoeff(&least_aligned);
    first_tangent_ = law.normal.cross(Vec3::Unit(least_aligned)).normalized();
    second_tangent_ = law.normal.cross(first_tangent_);
    normal_response_ = law.normal.dot(response * law.normal);
    // Largest eigenvalue of the two tangential rows: dividing u_t by it gives a step of y_t that never overshoots.
    const double first = first_tangent_.dot(response * first_tangent_);
    const double second = second_tangent_.dot(response * second_tangent_);
    const double coupling = first_tangent_.dot(response * second_tangent_);
    tangential_response_ = 0.5 * (first + second) + std::hypot(0.5 * (first - second), coupling);
  }

  const Vec3& impulse() const { return impulse_; }

  /// Solves the law of this point with the other impulses fixed. Returns the change of the point's velocity, m/s.
  double visit(std::vector<Mover>& movers) {
    if (normal_response_ <= 0.0) return 0.0;
    const double normal_change = normal_response_ * press(movers);
    const double tangential_change = tangential_response_ * rub(movers);
    return std::max(normal_change, tangential_change);
  }

 private:
  /// Returns the size of the change of the normal impulse, N s.
  double press(std::vector<Mover>& movers) {
    const double velocity = law_.normal.dot(relative_velocity(movers, law_));
    const double pressure = std::max(0.0, pressure_ - (velocity - law_.least) / normal_response_);
    const double change = pressure - pressure_;
    pressure_ = pressure;
    apply(movers, change * law_.normal);
    return std::abs(change);
  }

  /// Returns the size of the change of the tangential impulse, N s.
  double rub(std::vector<Mover>& movers) {
    const Vec3 velocity = relative_velocity(movers, law_);
    const Eigen::Vector2d slip(first_tangent_.dot(velocity), second_tangent_.dot(velocity));
    Eigen::Vector2d rubbing = rubbing_ - slip / tangential_response_;
    const double limit = law_.friction * pressure_;
    const double size = rubbing.norm();
    if (size > limit) rubbing *= limit / size;
    const Eigen::Vector2d change = rubbing - rubbing_;
    rubbing_ = rubbing;
    apply(movers, change.x() * first_tangent_ + change.y() * second_tangent_);
    return change.norm();
  }

  void apply(std::vector<Mover>& movers, const Vec3& change) {
    push(movers[law_.a], law_.arm_a, -change);
    push(movers[law_.b], law_.arm_b, change);
    impulse_ += change;
  }

  const PointLaw& law_;
  Vec3 first_tangent_, second_tangent_;
  double normal_response_ = 0.0;                       ///< 1/kg
  double tangential_response_ = 0.0;                   ///< 1/kg
  double pressure_ = 0.0;                              ///< y_n, N s
  Eigen::Vector2d rubbing_ = Eigen::Vector2d::Zero();  ///< y_t along the two tangents, N s
  Vec3 impulse_ = Vec3::Zero();
};

}  // namespace

Vec3 relative_velocity(const std::vector<Mover>& movers, const PointLaw& law) {
  const Mover& a = movers[law.a];
  const Mover& b = movers[law.b];
  return b.velocity + b.angular_velocity.cross(law.arm_b) - a.velocity - a.angular_velocity.cross(law.arm_a);
}

Solution solve(std::vector<Mover>& movers, const std::vector<PointLaw>& laws, double tolerance,
               std::uint64_t most_sweeps) {
  std::vector<Point> points;
  points.reserve(laws.size());
  for (const PointLaw& law : laws) points.emplace_back(movers, law);

  Solution solution;
  while (!points.empty() && solution.sweeps < most_sweeps) {
    solution.residual = 0.0;
    for (Point& point : points) solution.residual = std::max(solution.residual, point.visit(movers));
    ++solution.sweeps;
    if (solution.residual <= tolerance) break;
  }
  for (const Point& point : points) solution.impulses.push_back(point.impulse());
  return solution;
}

}  // namespace holdfast::internal::plain
