#pragma once

namespace holdfast::internal {

/// A body that rotates about a fixed edge or corner below its centre of mass.
struct Pivoted {
  double arm = 0.0;               ///< R, from the pivot to the centre of mass, m
  double lean = 0.0;              ///< α, angle of the arm from the vertical while the body stands, rad
  double gyration_squared = 0.0;  ///< moment of inertia about the pivot over the mass, m²
};

/// A uniform box of the given length along the acceleration, and height, about its lower edge: R = ½√(l² + h²),
/// tan α = l/h, k² = (4/3) R² (Steiner: (l² + h²)/12 + R²).
Pivoted about_edge(double length, double height);

/// A uniform box with a square base about a lower corner, rotating in the vertical plane of the base's diagonal: half
/// the diagonal, l/√2, replaces l/2, and the moment about any horizontal axis through the centre is m(l² + h²)/12.
Pivoted about_corner(double side, double height);

/// A body that rotates about its pivot under the constant acceleration `a` of the ground, from rest, without sliding:
///     θ'' = (R/k²) [a cos(α − θ) − g sin(α − θ)]
/// (moments of weight and inertial force about the pivot). Integrated by the classical Runge-Kutta method of order 4 in
/// long double, with steps of 0.5 ms: below 1e-11 rad for boxes of a metre and times of a second.
class Toppling {
 public:
  Toppling(const Pivoted& body, double acceleration, double gravity);

  /// Integrates to `time`, s; not backwards. The angle is zero below the tipping threshold.
  void advance_to(double time);

  /// Integrates until the angle is reached from below and returns the time, s; infinity if it is not reached within a
  /// minute.
  double time_to(double angle);

  double angle() const { return static_cast<double>(state_.angle); }  ///< θ, rad
  double rate() const { return static_cast<double>(state_.rate); }    ///< θ', rad/s

  /// Vertical force on the pivot per mass of the body, m/s²: the pivot lifts off where it is not positive.
  double support() const;
  /// Ratio of horizontal to vertical force on the pivot: the friction coefficient below which the pivot slides.
  double friction_needed() const;

 private:
  struct State {
    long double angle = 0.0L;
    long double rate = 0.0L;
  };
  long double angular_acceleration(long double angle) const;
  State after(const State& state, long double step) const;
  long double horizontal_force() const;

  Pivoted body_;
  long double acceleration_;
  long double gravity_;
  long double time_ = 0.0L;
  State state_;
};

/// The smallest acceleration under which the body, from rest, reaches `angle` within `time`, m/s²: slightly more than
/// g tan α, since the body falls more slowly the closer the acceleration is to this limit.
double toppling_threshold(const Pivoted& body, double gravity, double angle, double time);

/// The shortest rectangular pulse of the acceleration that overturns the body, s. At its end, at the angle θ_T, the
/// energy gained, R a (sin α − sin(α − θ_T)) − R g (cos(α − θ_T) − cos α) per unit of mass, must lift the centre of
/// mass to the top of its arc, R g (1 − cos(α − θ_T)):   a [sin α − sin(α − θ_T)] = g [1 − cos α].
double overturning_pulse(const Pivoted& body, double acceleration, double gravity);

}  // namespace holdfast::internal
