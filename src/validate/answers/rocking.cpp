#include "validate/answers/rocking.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace holdfast::internal {

namespace {

/// Angle and angular velocity relative to the edge that the block turns about; both are positive where it rises.
struct Swing {
  double tilt = 0.0;
  double velocity = 0.0;
};

/// Gravity and the inertial force in an interval, for a block that turns about one of its edges:
/// θ'' = −square sin(inclination − θ).
struct Field {
  double square = 0.0;       ///< p² √(1 + (a/g)²), 1/s²
  double inclination = 0.0;  ///< of the block's diagonal at rest to the field, rad

  double rate(double tilt) const { return -square * std::sin(inclination - tilt); }
};

/// One step of the classical Runge-Kutta method. In an equation of second order without damping, the stages of the
/// velocities are the rates of the angles' stages.
Swing advanced(const Swing& at, const Field& field, double h) {
  const double k1 = field.rate(at.tilt);
  const double k2 = field.rate(at.tilt + 0.5 * h * at.velocity);
  const double k3 = field.rate(at.tilt + 0.5 * h * at.velocity + 0.25 * h * h * k1);
  const double k4 = field.rate(at.tilt + h * at.velocity + 0.5 * h * h * k2);
  return {at.tilt + h * at.velocity + h * h / 6.0 * (k1 + k2 + k3),
          at.velocity + h / 6.0 * (k1 + 2.0 * (k2 + k3) + k4)};
}

/// The time at which `has_passed` becomes true, by halving an interval to the last bit.
template <class Predicate>
double time_of(double low, double high, Predicate has_passed) {
  for (;;) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) return high;
    (has_passed(middle) ? high : low) = middle;
  }
}

/// The time of the impact within a step, s; beyond the step if there is none. A block that falls, is caught by the
/// field and rises again within one step touches the floor only if its lowest point does.
double impact_within(const Swing& at, const Field& field, double h) {
  const auto is_below = [&](double time) { return advanced(at, field, time).tilt < 0.0; };
  if (is_below(h)) return time_of(0.0, h, is_below);
  if (at.velocity >= 0.0 || advanced(at, field, h).velocity <= 0.0) return 2.0 * h;
  const double lowest = time_of(0.0, h, [&](double time) { return advanced(at, field, time).velocity > 0.0; });
  return is_below(lowest) ? time_of(0.0, lowest, is_below) : 2.0 * h;
}

/// The largest tilt within a step without impact, rad.
double highest_within(const Swing& at, const Swing& after, const Field& field, double h) {
  if (at.velocity <= 0.0 || after.velocity >= 0.0) return std::max(at.tilt, after.tilt);
  return advanced(at, field, time_of(0.0, h, [&](double time) { return advanced(at, field, time).velocity < 0.0; }))
      .tilt;
}

}  // namespace

RockingBlock rocking_block(double width, double height, double gravity) {
  const double half_diagonal = 0.5 * std::hypot(width, height);
  return {half_diagonal, std::atan2(width, height), std::sqrt(0.75 * gravity / half_diagonal)};
}

double impact_ratio(const RockingBlock& block) {
  const double sine = std::sin(block.slenderness);
  return 1.0 - 1.5 * sine * sine;
}

double peak_tilt(const RockingBlock& block, double tilt, int n) {
  const double base = std::cos(block.slenderness);
  const double kept = std::pow(impact_ratio(block), 2 * n);
  return block.slenderness - std::acos(base + kept * (std::cos(block.slenderness - tilt) - base));
}

double quarter_period(const RockingBlock& block, double tilt) {
  constexpr double kStep = 2e-5;
  const double square = block.frequency * block.frequency;
  const auto rate = [&](double angle) { return -square * std::sin(block.slenderness - angle); };
  double angle = tilt;
  double velocity = 0.0;
  for (int i = 0;; ++i) {
    // A second-order equation without damping: the stages of the velocities are the rates of the angles' stages.
    const double k1 = rate(angle);
    const double k2 = rate(angle + 0.5 * kStep * velocity);
    const double k3 = rate(angle + 0.5 * kStep * velocity + 0.25 * kStep * kStep * k1);
    const double k4 = rate(angle + kStep * velocity + 0.5 * kStep * kStep * k2);
    const double next = angle + kStep * velocity + kStep * kStep / 6.0 * (k1 + k2 + k3);
    if (next <= 0.0) return kStep * i + 2.0 * angle / (-velocity + std::sqrt(velocity * velocity - 2.0 * k1 * angle));
    velocity += kStep / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    angle = next;
  }
}

double peak_time(const RockingBlock& block, double tilt, int n) {
  double time = 0.0;
  for (int i = 0; i < n; ++i) {
    time += quarter_period(block, peak_tilt(block, tilt, i));
    time += quarter_period(block, peak_tilt(block, tilt, i + 1));
  }
  return time;
}

RockingState rocked_by(const RockingBlock& block, const Acceleration& acceleration, double gravity, double overturned) {
  constexpr double kStep = 1e-3;    // s
  constexpr double kStands = 1e-9;  // rad/s
  const double ratio = impact_ratio(block);
  const double square = block.frequency * block.frequency;
  RockingState state;
  Swing swing;
  double side = 0.0;  // of the edge that the block turns about; 0 while it stands
  for (const Phase& phase : phases_of(acceleration, acceleration.end_time())) {
    const double push = phase.acceleration.x();
    double left = phase.end - phase.begin;
    while (left > 0.0) {
      const double turns = side != 0.0 ? side : push > 0.0 ? -1.0 : 1.0;
      const Field field{square * std::hypot(1.0, push / gravity),
                        block.slenderness + turns * std::atan(push / gravity)};
      // It stands as long as the field does not lift it: |a| ≤ g tan α.
      if (side == 0.0 && field.rate(0.0) <= 0.0) break;
      side = turns;
      const double longest = std::min(left, kStep);
      const double impact = impact_within(swing, field, longest);
      const bool hits = impact <= longest;
      const double h = hits ? impact : longest;
      const Swing before = std::exchange(swing, advanced(swing, field, h));
      state.largest_tilt = std::max(state.largest_tilt, highest_within(before, swing, field, h));
      left = hits || left > kStep ? left - h : 0.0;
      if (hits) {
        ++state.impacts;
        swing = {0.0, -ratio * swing.velocity};
        side = -side;
        if (swing.velocity < kStands) {
          swing = {};
          side = 0.0;
        }
      }
      if (state.largest_tilt >= overturned) {
        state.has_overturned = true;
        left = 0.0;
      }
    }
    if (state.has_overturned) break;
  }
  state.tilt = side * swing.tilt;
  state.velocity = side * swing.velocity;
  return state;
}

}  // namespace holdfast::internal
