#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/native/collision/oriented_box.hpp"
#include "core/native/solver/anderson.hpp"
#include "core/native/solver/block_ldlt.hpp"
#include "core/native/solver/contact_constraint.hpp"
#include "core/native/solver/contact_kernels.hpp"

namespace holdfast::internal::native {

/// What a body's mass does in a solve.
struct SolverBody {
  double mass = 0.0;            ///< kg
  Mat3 inertia = Mat3::Zero();  ///< container frame, at the end of the step, kg m²
  double radius = 0.0;          ///< of the sphere around the box, m
};

/// How hard a solve tries.
struct SplittingOptions {
  double tolerance = 1e-3;      ///< of velocities, in units of `velocity_unit`
  int iterations = 24;          ///< at most, where what is left may pass
  int more_iterations = 0;      ///< at most, on top of these, where it may not
  double mean_residual = 0.0;   ///< that may pass: root of the mean square over the points, in units of `velocity_unit`
  double worst_residual = 0.5;  ///< that may pass, likewise
  double relaxation = 1.0;      ///< α
  double sticking = 10.0;       ///< R over the mass that a contact carries, where it sticks and along the normal
  double sliding = 3.0;         ///< the same along the tangents where it slides
  double ready = 0.1;           ///< share of its bodies' mass that a contact without load stands ready for
  int refit_every = 12;         ///< iterations between two looks at R
  double refit_share = 0.2;     ///< of the points, above which it is fitted anew where so many call for another one
  Projection projection = Projection::coulomb;  ///< Π
  bool accelerate = false;                      ///< Anderson's acceleration: for solves that go on to the end
};

/// How far a solve came.
struct SplittingResult {
  int iterations = 0;
  double residual = 0.0;  ///< larger of |u − z| and the last change of a body's velocity, m/s
  bool converged = false;
};

/// Velocities of an island's bodies at the end of a step, and the impulses of its contacts: hard contacts with the
/// exact Coulomb cone at the velocity level (Moreau 1988), by operator splitting with one sparse factorisation
///
///   A = M + J_midᵀ R J_mid,    x = y − R (z + α (J_end v − z)),    y = Π(x),    z = (y − x) / R,
///   v ← v + A⁻¹ (M (v* − v) + J_midᵀ (y + R (z − J_end v))).
///
/// Π cuts the normal part at zero and the tangential part at the disc of radius μ y_n: at the fixed point Coulomb's
/// law holds exactly, without the dilation of convex cones. The residual form keeps the fixed point exact whatever
/// A is made of, so that arms of mid step and end of step may differ.
class Splitting {
 public:
  std::vector<SolverBody> bodies;         ///< by place in the factor
  std::vector<BodyVector> free_velocity;  ///< v*: without contacts, by place
  std::vector<BodyVector> velocity;       ///< by place; one more than bodies, the last is zero
  std::vector<Patch> patches;
  std::vector<Arms> mid_arms;             ///< a patch; empty when nothing turns
  std::vector<std::uint32_t> patch_pair;  ///< pair of the factor that a patch belongs to; `kNoPair` with what is fixed
  std::vector<NormalBounds> most_normal;  ///< of a proof of rest, a patch: largest normal impulses, kg m/s; else empty
  BlockFactor factor;
  double load_unit = 1.0;  ///< impulse that a kilogram brings to bear in the step, m/s

  /// To be told when bodies, patches or arms are new: what was factorised for the ones before no longer counts.
  void begin() { begun_ = true; }

  /// Iterates from the velocities, impulses and slips that are there; goes on with the factor of the last call where it
  /// still holds.
  /// @param velocity_unit what tolerances are measured in, m/s
  SplittingResult solve(const SplittingOptions& options, double velocity_unit);

  /// Starts again from no impulses at `start`, with arms of one time alone: what helps where the iteration has
  /// diverged, because bodies turn far within the step.
  void restart(std::span<const BodyVector> start);

  /// No point of any body moves faster than this, by the velocities that are there, m/s.
  double largest_speed() const;

  /// Whether the velocities that are there prove that no impulses in Coulomb's cones balance the bodies at rest.
  /// Balance means Jᵀy = −M v*; then v · M v* = −Σ y · J v for every motion v, and an impulse y of the cone takes no
  /// more than −y · u ≤ y_n (μ |u_t| − u_n). A motion to which the load gives more than that refutes balance. (It is
  /// Farkas' lemma; the iteration with the orthogonal projection converges to such a motion where there is one.)
  /// @param most no impulse of a balance is larger than this, kg m/s
  bool refutes_rest(double most);

  /// Largest force that is left on a body at rest under the impulses that are there, over its weight m · velocity
  /// unit; torques over the radius.
  double imbalance_at_rest(double velocity_unit);

 private:
  /// R of a point, along the normal and the tangents, kg.
  struct Resistance {
    double normal = 0.0;
    double tangential = 0.0;
  };

  Resistance wanted_resistance(const Patch& patch, std::size_t lane, const SplittingOptions& options) const;
  bool choose_resistance(const SplittingOptions& options);
  double speed(std::size_t place) const;
  void assemble();
  /// Most that impulses can take from the motion, kg m²/s².
  double supported_power(std::span<const BodyVector> motion, double most);
  /// Into `change_`: what M (v* − v) and the impulses leave over, for the velocities that are there or for none.
  void residual_force(bool at_rest);

  bool begun_ = true;      ///< nothing has been iterated since `begin`
  double heaviest_ = 0.0;  ///< most mass that a point can carry, kg
  Anderson anderson_;
  std::vector<PatchVector> u_, g_, r_;
  std::vector<LaneWrench> wrench_;
  std::vector<BodyVector> change_, motion_;
};

}  // namespace holdfast::internal::native
