#pragma once

namespace holdfast::internal {

/// A block that rocks on its two lower edges without slipping (Housner 1963): half diagonal R, atan(width / height) α.
///   θ'' = −p² sin(α − θ),  p² = 3 g / (4 R)
struct RockingBlock {
  double half_diagonal = 0.0;  ///< R, m
  double slenderness = 0.0;    ///< α, rad
  double frequency = 0.0;      ///< p, 1/s
};

RockingBlock rocking_block(double width, double height, double gravity);

/// Angular velocity kept by an impact on the other edge. The angular momentum about that edge is kept:
///   I_o ω⁺ = (I_o − 2 m R² sin²α) ω⁻ with I_o = (4/3) m R²:  r = 1 − (3/2) sin²α
double impact_ratio(const RockingBlock& block);

/// Tilt of the n-th peak after release at rest from `tilt`, rad. Energy is kept between impacts:
///   cos(α − θ_n) = cos α + r^(2n) (cos(α − θ_0) − cos α)
double peak_tilt(const RockingBlock& block, double tilt, int n);

/// Time from rest at `tilt` to the first impact, s, by the classic Runge-Kutta method in steps of 20 µs.
double quarter_period(const RockingBlock& block, double tilt);

/// Time of the n-th peak after release from `tilt`, s: quarter periods between.
double peak_time(const RockingBlock& block, double tilt, int n);

}  // namespace holdfast::internal
