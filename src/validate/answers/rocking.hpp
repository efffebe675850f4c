#pragma once

namespace holdfast::internal {

/// A block that rocks on its two lower edges without sliding (Housner 1963), with R half the diagonal and
/// α = atan(width / height):
///   θ'' = −p² sin(α − θ),  p² = 3 g / (4 R)
struct RockingBlock {
  double half_diagonal = 0.0;  ///< R, m
  double slenderness = 0.0;    ///< α, rad
  double frequency = 0.0;      ///< p, 1/s
};

RockingBlock rocking_block(double width, double height, double gravity);

/// Ratio of the angular velocities after and before an impact on the other edge. The angular momentum about that edge
/// is conserved:
///   I_o ω⁺ = (I_o − 2 m R² sin²α) ω⁻ with I_o = (4/3) m R²:  r = 1 − (3/2) sin²α
double impact_ratio(const RockingBlock& block);

/// Tilt of the n-th peak after release at rest from `tilt`, rad. Energy is conserved between impacts:
///   cos(α − θ_n) = cos α + r^(2n) (cos(α − θ_0) − cos α)
double peak_tilt(const RockingBlock& block, double tilt, int n);

/// Time from rest at `tilt` to the first impact, s, by the classical Runge-Kutta method with steps of 20 µs.
double quarter_period(const RockingBlock& block, double tilt);

/// Time of the n-th peak after release from `tilt`, s: a sum of quarter periods.
double peak_time(const RockingBlock& block, double tilt, int n);

}  // namespace holdfast::internal
