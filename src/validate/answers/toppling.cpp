#include "validate/answers/toppling.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace holdfast::internal {

namespace {

constexpr long double kStep = 5e-4L;  ///< s

}  // namespace

Pivoted about_edge(double length, double height) {
  const double squares = length * length + height * height;
  return {0.5 * std::sqrt(squares), std::atan2(length, height), squares / 3.0};
}

Pivoted about_corner(double side, double height) {
  const double half_diagonal = side / std::numbers::sqrt2;
  const double arm_squared = half_diagonal * half_diagonal + 0.25 * height * height;
  return {std::sqrt(arm_squared), std::atan2(half_diagonal, 0.5 * height),
          arm_squared + (side * side + height * height) / 12.0};
}

Toppling::Toppling(const Pivoted& body, double acceleration, double gravity)
    : body_(body), acceleration_(acceleration), gravity_(gravity) {}

long double Toppling::angular_acceleration(long double angle) const {
  const long double lean = static_cast<long double>(body_.lean) - angle;
  return static_cast<long double>(body_.arm) / static_cast<long double>(body_.gyration_squared) *
         (acceleration_ * std::cos(lean) - gravity_ * std::sin(lean));
}

Toppling::State Toppling::after(const State& state, long double step) const {
  const long double half = 0.5L * step;
  const long double a1 = angular_acceleration(state.angle);
  const long double a2 = angular_acceleration(state.angle + half * state.rate);
  const long double a3 = angular_acceleration(state.angle + half * (state.rate + half * a1));
  const long double a4 = angular_acceleration(state.angle + step * (state.rate + half * a2));
  return {state.angle + step * (state.rate + step / 6.0L * (a1 + a2 + a3)),
          state.rate + step / 6.0L * (a1 + 2.0L * a2 + 2.0L * a3 + a4)};
}

void Toppling::advance_to(double time) {
  // The floor prevents rotation backwards.
  if (angular_acceleration(0.0L) <= 0.0L && state_.angle == 0.0L) return;
  while (time_ < static_cast<long double>(time)) {
    const long double step = std::min(kStep, static_cast<long double>(time) - time_);
    state_ = after(state_, step);
    time_ += step;
  }
}

double Toppling::time_to(double angle) {
  const auto level = static_cast<long double>(angle);
  if (angular_acceleration(0.0L) <= 0.0L) return std::numeric_limits<double>::infinity();
  State next = after(state_, kStep);
  while (next.angle < level) {
    state_ = next;
    time_ += kStep;
    if (time_ > 60.0L) return std::numeric_limits<double>::infinity();
    next = after(state_, kStep);
  }
  long double low = 0.0L;
  long double high = kStep;
  for (int i = 0; i < 60; ++i) {
    const long double middle = 0.5L * (low + high);
    (after(state_, middle).angle < level ? low : high) = middle;
  }
  state_ = after(state_, high);
  time_ += high;
  return static_cast<double>(time_);
}

// The centre of mass is R sin β behind the pivot and R cos β above it, β = α − θ. It is accelerated towards the pivot
// by R (cos β θ'' + sin β θ'²) and upwards by R (sin β θ'' − cos β θ'²).
double Toppling::support() const {
  const long double lean = static_cast<long double>(body_.lean) - state_.angle;
  const long double upwards =
      std::sin(lean) * angular_acceleration(state_.angle) - std::cos(lean) * state_.rate * state_.rate;
  return static_cast<double>(gravity_ + static_cast<long double>(body_.arm) * upwards);
}

long double Toppling::horizontal_force() const {
  const long double lean = static_cast<long double>(body_.lean) - state_.angle;
  const long double forwards =
      std::cos(lean) * angular_acceleration(state_.angle) + std::sin(lean) * state_.rate * state_.rate;
  return acceleration_ - static_cast<long double>(body_.arm) * forwards;
}

double Toppling::friction_needed() const { return std::abs(static_cast<double>(horizontal_force())) / support(); }

double toppling_threshold(const Pivoted& body, double gravity, double angle, double time) {
  const double limit = gravity * std::tan(body.lean);
  const auto lateness = [&](double log_excess) {
    return Toppling(body, limit * (1.0 + std::exp(log_excess)), gravity).time_to(angle) - time;
  };
  // The time decreases almost linearly with the logarithm of the excess: the secant method finds it in a few
  // iterations.
  double before = std::log(1e-4);
  double late_before = lateness(before);
  double now = std::log(1e-3);
  double late = lateness(now);
  for (int i = 0; i < 20 && std::abs(now - before) > 1e-9 && late != late_before; ++i) {
    const double next = now - late * (now - before) / (late - late_before);
    before = std::exchange(now, next);
    late_before = std::exchange(late, lateness(next));
  }
  return limit * (1.0 + std::exp(now));
}

double overturning_pulse(const Pivoted& body, double acceleration, double gravity) {
  const double remaining_sine = std::sin(body.lean) - gravity / acceleration * (1.0 - std::cos(body.lean));
  return Toppling(body, acceleration, gravity).time_to(body.lean - std::asin(remaining_sine));
}

}  // namespace holdfast::internal
