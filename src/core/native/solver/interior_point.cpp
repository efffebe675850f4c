#include "core/native/solver/interior_point.hpp"

#include <cmath>
#include <limits>

#include "core/native/constants.hpp"
#include "core/native/solver/contact_kernels.hpp"

namespace holdfast::internal::native {

namespace {

Vec3 at_lane(const ConstraintVector& vector, std::uint32_t lane) {
  return {vector.row[0][lane], vector.row[1][lane], vector.row[2][lane]};
}

void set_lane(ConstraintVector& vector, std::uint32_t lane, const Vec3& value) {
  for (std::size_t d = 0; d < 3; ++d) vector.row[d][lane] = value[static_cast<Eigen::Index>(d)];
}

/// Shorter steps lead nowhere: rounding has the better of them.
constexpr double kLeastStep = 1e-6;

/// Bounds of no more than this share of the carried weight leave no inside.
constexpr double kLeastBound = 1e-12;

/// The largest α with x + α d ≥ 0.
double longest_step(double x, double d) { return d >= 0.0 ? std::numeric_limits<double>::infinity() : -x / d; }

/// The smaller of two steps; not a number where one of them is none.
double shorter(double a, double b) { return a <= b || std::isnan(a) ? a : b; }

}  // namespace

void InteriorPoint::start(ContactProblem& problem, double velocity_unit) {
  ldlt_.analyse(problem.bodies.size(), problem.pairs);
  points_.clear();
  pairs_ = 0.0;
  resistance_.assign(problem.constraints.size(), ConstraintMatrix{});
  u_.resize(problem.constraints.size());
  change_.resize(problem.constraints.size());
  for (std::uint32_t p = 0; p < problem.constraints.size(); ++p)
    for (std::uint32_t lane = 0; lane < static_cast<std::uint32_t>(problem.constraints[p].count); ++lane)
      add_point(problem, p, lane, velocity_unit);
  for (ContactConstraint& constraint : problem.constraints) constraint.impulse = ConstraintVector{};
  std::fill(problem.velocity.begin(), problem.velocity.end(), BodyVector{});
  write(problem);
}

/// Adds a point of the problem, in the middle of its cones. One whose bound is 0 has no part in the method.
void InteriorPoint::add_point(const ContactProblem& problem, std::uint32_t constraint, std::uint32_t lane,
                              double velocity_unit) {
  const ContactConstraint& contact = problem.constraints[constraint];
  const double carried = contact.effective_mass * velocity_unit;
  Point point{.constraint = constraint, .lane = lane};
  if (contact.friction > 0.0)
    point.friction = contact.friction;
  else
    point.tangential = 0.0;
  double normal = std::max(contact.impulse.row[0][lane], carried);
  const double speed = kInteriorStartSpeed * velocity_unit;
  if (!problem.normal_bounds.empty() && std::isfinite(problem.normal_bounds[constraint].lane[lane])) {
    point.bounded = true;
    point.bound = problem.normal_bounds[constraint].lane[lane];
    if (point.bound <= kLeastBound * carried) return;
    normal = std::min(normal, 0.5 * point.bound);
    point.p = point.bound - normal;
    point.l = speed * std::min(1.0, normal / point.p);
    pairs_ += 1.0;
  }
  point.y = point.friction * normal * Vec3::UnitX();
  point.s = speed / point.friction * Vec3::UnitX();
  pairs_ += 1.0;
  points_.push_back(point);
}

bool InteriorPoint::iterate(ContactProblem& problem) {
  double mean = 0.0;
  for (const Point& point : points_) mean += point.complementarity();
  mean /= pairs_;
  factorise(problem);
  find_contact_velocities(problem.constraints, problem.velocity, u_);
  const double affine = 1.0 - std::min(1.0, find_direction(problem, 0.0, false));
  const double centring = std::max(kInteriorLeastCentring, affine * affine * affine);
  const double step = shorter(1.0, kInteriorStep * find_direction(problem, centring * mean, true));
  const bool usable = step > kLeastStep;
  if (usable) {
    for (Point& point : points_) {
      point.y += step * point.dy;
      point.s += step * point.ds;
      point.p += step * point.dp;
      point.l += step * point.dl;
    }
    for (std::size_t i = 0; i < problem.bodies.size(); ++i)
      for (int k = 0; k < kBodyRows; ++k) problem.velocity[i].row[k] += step * dv_[i].row[k];
  }
  write(problem);
  return usable;
}

/// Finds R of every point, and the factor of M + Jᵀ R J.
void InteriorPoint::factorise(const ContactProblem& problem) {
  for (Point& point : points_) {
    find_resistance(point);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        resistance_[point.constraint].entry[i][j][point.lane] =
            point.resistance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
  }
  ldlt_.clear();
  ldlt_.add(problem.bodies);
  ldlt_.add(problem.constraints, resistance_, problem.constraint_pair);
  ldlt_.factorise();
}

/// R = (D W² D + λ/p n nᵀ)⁻¹, D from Lorentz coordinates of velocities to those of the constraint.
void InteriorPoint::find_resistance(Point& point) const {
  point.scaling = lorentz::Scaling(point.y, point.s);
  const Vec3 d(1.0 / point.friction, point.tangential, point.tangential);
  Mat3 inverse = point.scaling.inverse_square();
  if (point.bounded) {
    // (W² + k e eᵀ)⁻¹ by Sherman and Morrison, each minor of W⁻² without a difference of large numbers: R W⁻² may be
    // larger than R by all digits.
    const Vec3& w = point.scaling.w;
    const double k = point.l / (point.p * point.friction * point.friction);
    const double minor = k / (point.scaling.square * point.scaling.square);
    const double shrink = 1.0 / (1.0 + k * inverse(0, 0));
    inverse(1, 1) += minor * (1.0 + 2.0 * w[2] * w[2]);
    inverse(2, 2) += minor * (1.0 + 2.0 * w[1] * w[1]);
    inverse(1, 2) -= minor * 2.0 * w[1] * w[2];
    inverse(2, 1) = inverse(1, 2);
    inverse *= shrink;
  }
  point.resistance = d.asDiagonal() * inverse * d.asDiagonal();
}

/// Finds the Newton step to where all products of complementary variables are `target`, kg m²/s². Returns the largest
/// share of it that stays within all cones.
/// @param corrects takes account of what the products of the last direction's changes add
double InteriorPoint::find_direction(ContactProblem& problem, double target, bool corrects) {
  for (Point& point : points_) {
    find_drive(point, target, corrects);
    set_lane(problem.constraints[point.constraint].impulse, point.lane,
             point.impulse() + point.resistance * point.drive);
  }
  // (M + Jᵀ R J) Δv = M (v* − v) + Jᵀ (y + R g).
  wrench_.assign(problem.bodies.size() + 1, LaneWrench{});
  add_impulses(problem.constraints, {}, wrench_);
  momentum_residual(problem, wrench_, false, dv_);
  ldlt_.solve(dv_);
  dv_.emplace_back();
  find_contact_velocities(problem.constraints, dv_, change_);
  double longest = std::numeric_limits<double>::infinity();
  for (Point& point : points_) {
    longest = shorter(longest, step_at(point, target, corrects, at_lane(change_[point.constraint], point.lane)));
  }
  return longest;
}

/// g = D W̄ (ℓ⁻¹ ∘ c) + s − J v − λ n − n (c_λ + λ r_p) / p, with ℓ = W̄ y and the right-hand sides c and c_λ of the
/// products' Newton equations.
void InteriorPoint::find_drive(Point& point, double target, bool corrects) const {
  const Vec3 middle = point.scaling.scaled(point.y);
  Vec3 c = target * Vec3::UnitX() - point.scaling.square * lorentz::product(middle, middle);
  if (corrects) c -= lorentz::product(point.scaling.scaled(point.dy), point.scaling.unscaled(point.ds));
  const Vec3 centred = point.scaling.scaled(lorentz::quotient(c, middle));
  point.drive = Vec3(point.friction * centred[0], centred[1], centred[2]) + point.velocity() -
                at_lane(u_[point.constraint], point.lane);
  if (!point.bounded) return;
  const double c_bound = point.bound_change(target, corrects);
  point.drive[0] -= point.l + (c_bound + point.l * point.bound_residual()) / point.p;
}

/// Finds the changes of a point's variables that go with the change J Δv. Returns the largest share of them that stays
/// within the cones.
double InteriorPoint::step_at(Point& point, double target, bool corrects, const Vec3& change) const {
  const Vec3 impulse = point.resistance * (point.drive - change);
  Vec3 velocity = change + at_lane(u_[point.constraint], point.lane) - point.velocity();
  double longest = std::numeric_limits<double>::infinity();
  if (point.bounded) {
    const double c_bound = point.bound_change(target, corrects);
    point.dp = -impulse[0] - point.bound_residual();
    point.dl = (c_bound - point.l * point.dp) / point.p;
    velocity[0] += point.l + point.dl;
    longest = shorter(longest_step(point.p, point.dp), longest_step(point.l, point.dl));
  }
  point.dy = Vec3(point.friction * impulse[0], impulse[1], impulse[2]);
  point.ds = Vec3(velocity[0] / point.friction, point.tangential * velocity[1], point.tangential * velocity[2]);
  for (const double step : {lorentz::longest_step(point.y, point.dy), lorentz::longest_step(point.s, point.ds)})
    longest = shorter(longest, step);
  return longest;
}

void InteriorPoint::write(ContactProblem& problem) const {
  for (const Point& point : points_) {
    ContactConstraint& constraint = problem.constraints[point.constraint];
    set_lane(constraint.impulse, point.lane, point.impulse());
    set_lane(constraint.contact_velocity, point.lane, point.velocity());
  }
}

}  // namespace holdfast::internal::native
