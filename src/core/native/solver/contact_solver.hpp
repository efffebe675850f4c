#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "core/native/constants.hpp"
#include "core/native/solver/contact_kernels.hpp"
#include "core/native/solver/contact_problem.hpp"

namespace holdfast::internal::native {

/// How hard a solve tries.
struct SolveLimits {
  double tolerance = kNegligible;       ///< of velocities, in units of `velocity_unit`
  double velocity_unit = 1.0;           ///< what residuals are measured in, m/s
  int iterations = 2 * kCheckEvery;     ///< at most, where what is left may pass
  int more_iterations = 0;              ///< at most, on top of these, where it may not
  double mean_residual = 0.0;           ///< that may pass: root of the mean square over the points, in those units
  double worst_residual = kNoticeable;  ///< that may pass, likewise
  double sticking = kStickingPenalty;  ///< R over the mass that a contact carries, where it sticks and along the normal
  double sliding = kSlidingPenalty;    ///< the same along the tangents where it slides
  double idle_penalty =
      kIdlePenalty;               ///< R of a contact without impulse, over that of one that carries its effective mass
  int refit_every = kCheckEvery;  ///< iterations between two looks at R
  double refit_share = kRefitShare;  ///< of the points, above which R is fitted anew where so many call for another one
  Projection projection = Projection::coulomb;  ///< Π
  /// Iterations before Anderson acceleration begins; 0 for solves that go on to the end.
  int plain_iterations = kPlainIterations;
};

/// How far a solve came, and what it cost.
struct SolveResult {
  int iterations = 0;
  int factorisations = 0;
  double residual = 0.0;  ///< larger of |u − z| and the last change of a body's velocity, m/s
  bool converged = false;
};

/// Solves contact problems, one after another. Keeps its factor, its order of the bodies and all memory to itself; what
/// it computes depends on the problem and the limits alone, and on its own last solve where the problem `continues`.
class ContactSolver {
 public:
  ContactSolver() = default;
  ContactSolver(const ContactSolver&) = delete;
  ContactSolver& operator=(const ContactSolver&) = delete;
  virtual ~ContactSolver() = default;

  /// The index that each of `count` bodies is to have in a problem with these pairs, which are written with other
  /// indices. Valid until the next call. The order of a problem that has been renumbered so is the identity.
  virtual std::span<const std::uint32_t> order(std::size_t count, std::span<const BodyPair> pairs) = 0;

  /// Replaces the problem's velocities, impulses and contact velocities by better ones, which start from those that are
  /// there, and sets `continues`.
  virtual SolveResult solve(ContactProblem& problem, const SolveLimits& limits) = 0;
};

/// The solver that the engine takes.
std::unique_ptr<ContactSolver> make_contact_solver();

}  // namespace holdfast::internal::native
