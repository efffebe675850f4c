#pragma once

#include "core/model/acceleration.hpp"

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

/// The state of a block that rocks under an acceleration of the container along x.
struct RockingState {
  double tilt = 0.0;            ///< θ, rad, positive towards +x, where it turns about the lower edge at +x
  double velocity = 0.0;        ///< ω = θ', rad/s
  double largest_tilt = 0.0;    ///< largest |θ| since the start, rad
  int impacts = 0;              ///< on the other edge, those of a block that comes to rest among them
  bool has_overturned = false;  ///< it was integrated until |θ| reached `overturned`
};

/// Housner's equation with impacts, from rest at t = 0 to the end of an acceleration along x. With s the sign of θ, and
/// a the acceleration of the container, whose inertial force −m a acts on the centre of mass:
///   θ'' = −p² (sin(α s − θ) + (a/g) cos(α s − θ))
/// The block at rest lifts off when |a| > g tan α. At θ = 0 it changes to the other edge with r ω. Within an interval
/// of constant a, gravity and the inertial force are one field of strength √(g² + a²) that is inclined by atan(a/g), so
/// that θ'' = −p² √(1 + (a/g)²) sin(α s + atan(a/g) − θ): this is integrated by the classical Runge-Kutta method with
/// steps of at most 1 ms that end at the breakpoints of the acceleration and at the impacts, to better than 1e-10 rad.
/// After an impact with less than 1e-9 rad/s the block stands: it would only rock by less than 1e-16 rad.
/// @param overturned tilt at which the integration ends, rad
RockingState rocked_by(const RockingBlock& block, const Acceleration& acceleration, double gravity, double overturned);

}  // namespace holdfast::internal
