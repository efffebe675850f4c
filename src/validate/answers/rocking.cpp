#include "validate/answers/rocking.hpp"

#include <cmath>

namespace holdfast::internal {

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

}  // namespace holdfast::internal
