#include "core/native/solver/interior_point.hpp"

#include <cmath>
#include <limits>

#include "core/native/constants.hpp"
#include "core/native/solver/body_kernels.hpp"
#include "core/native/solver/contact_kernels.hpp"

namespace holdfast::internal::native {

namespace {

/// Shorter steps lead nowhere: rounding has the better of them.
constexpr double kLeastStep = 1e-6;

/// Bounds of no more than this share of the carried weight leave no inside.
constexpr double kLeastBound = 1e-12;

}  // namespace

void InteriorPoint::start(ContactProblem& problem, double velocity_unit) {
  const std::size_t count = problem.constraints.size();
  ldlt_.analyse(problem.bodies.size(), problem.pairs);
  points_.assign(count, InteriorPoints{});
  pairs_ = 0.0;
  resistance_.resize(count);
  u_.resize(count);
  change_.resize(count);
  for (std::size_t p = 0; p < count; ++p)
    for (std::size_t lane = 0; lane < static_cast<std::size_t>(problem.constraints[p].count); ++lane)
      place(problem, p, lane, velocity_unit);
  std::fill(problem.velocity.begin(), problem.velocity.end(), BodyVector{});
  write_back(points_, problem.constraints);
}

/// Places a point of the problem in the middle of its cones. One whose bound is 0 takes no part in the method.
void InteriorPoint::place(const ContactProblem& problem, std::size_t constraint, std::size_t lane,
                          double velocity_unit) {
  const ContactConstraint& contact = problem.constraints[constraint];
  InteriorPoints& points = points_[constraint];
  const double carried = contact.effective_mass * velocity_unit;
  const double speed = kSmall * velocity_unit;
  const double bound = problem.normal_bounds.empty() ? std::numeric_limits<double>::infinity()
                                                     : problem.normal_bounds[constraint].lane[lane];
  double normal = std::max(contact.impulse.row[0][lane], carried);
  if (std::isfinite(bound)) {
    if (bound <= kLeastBound * carried) return;
    normal = std::min(normal, 0.5 * bound);
    points.is_bounded[lane] = 1.0;
    points.bound[lane] = bound;
    points.p[lane] = bound - normal;
    points.l[lane] = speed * std::min(1.0, normal / points.p[lane]);
    pairs_ += 1.0;
  }
  points.takes_part[lane] = 1.0;
  if (contact.friction > 0.0) {
    points.has_friction[lane] = 1.0;
    points.friction = contact.friction;
    points.inverse_friction = 1.0 / contact.friction;
  }
  points.y.row[0][lane] = points.friction * normal;
  points.s.row[0][lane] = points.inverse_friction * speed;
  pairs_ += 1.0;
}

bool InteriorPoint::iterate(ContactProblem& problem) {
  gap_ = scale(points_, resistance_);
  const double mean = gap_ / pairs_;
  factorise(problem);
  find_contact_velocities(problem.constraints, problem.velocity, u_);
  const double affine = 1.0 - std::min(1.0, find_direction(problem, {}));
  const double centring = std::max(kInteriorLeastCentring, affine * affine * affine);
  const InteriorTarget target{.complementarity = centring * mean, .corrects = true};
  const double step = shorter(1.0, (1.0 - kSlack) * find_direction(problem, target));
  const bool usable = step > kLeastStep;
  if (usable) {
    take_step(step, points_);
    for (std::size_t i = 0; i < problem.bodies.size(); ++i)
      for (int k = 0; k < kPaddedRows; ++k) problem.velocity[i].row[k] += step * dv_[i].row[k];
  }
  write_back(points_, problem.constraints);
  return usable;
}

/// Finds the factor of M + Jᵀ R J.
void InteriorPoint::factorise(const ContactProblem& problem) {
  ldlt_.clear();
  ldlt_.add(problem.bodies);
  ldlt_.add(problem.constraints, resistance_, problem.constraint_pair);
  ldlt_.factorise();
}

/// Finds the Newton step to the target. Returns the largest share of it that stays within all cones.
double InteriorPoint::find_direction(ContactProblem& problem, const InteriorTarget& target) {
  // (M + Jᵀ R J) Δv = M (v* − v) + Jᵀ (y + R g).
  find_drive(target, points_, resistance_, u_, problem.constraints);
  wrench_.assign(problem.bodies.size() + 1, LaneWrench{});
  add_impulses(problem.constraints, {}, wrench_);
  dv_.resize(problem.bodies.size());
  momentum_residual(problem.bodies, problem.free_velocity, problem.velocity.data(), wrench_, dv_);
  ldlt_.solve(dv_);
  dv_.emplace_back();
  find_contact_velocities(problem.constraints, dv_, change_);
  for (std::size_t p = 0; p < change_.size(); ++p)
    for (std::size_t d = 0; d < 3; ++d)
      for (std::size_t lane = 0; lane < kLanes; ++lane)
        change_[p].row[d][lane] -= problem.constraints[p].velocity_bias.row[d][lane];
  return find_changes(target, points_, resistance_, u_, change_);
}

}  // namespace holdfast::internal::native
