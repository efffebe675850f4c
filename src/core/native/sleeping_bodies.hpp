#pragma once

#include <cstdint>
#include <vector>

#include "core/native/connectivity.hpp"
#include "core/native/scene.hpp"

namespace holdfast::internal::native {

/// Which bodies of moving islands sleep: those that have been slow for some steps stay where they are, as if they were
/// fixed, while the others are stepped against them. Most bodies of a load that moves are slow, and what is stepped
/// falls into many small islands. None sleep in an island of up to `kMediumIslandBodies`, nor in one where all are slow
/// enough to be at rest.
///
/// Five things end the sleep of a body. All bodies are awake in every `kWakeEvery`-th step. A body wakes when the
/// forces of what moves on it, and on those that sleep beside it, have changed by more than a share of their weight
/// since they fell asleep. Bodies that are hit, and those near them, do not sleep in that step, nor do those that
/// moving ones carry. And all wake where the effective gravity has changed by more than `kSmall`.
class SleepingBodies {
 public:
  /// @param rising_speed a step in which a body gains more speed does not count as slow, over |g − a| h
  explicit SleepingBodies(std::size_t bodies = 0, double rising_speed = 0.0)
      : rising_speed_(rising_speed), slow_steps_(bodies, 0), speed_(bodies, 0.0), load_(bodies, Vec3::Zero()) {}

  /// Wakes all bodies, and forgets how long they have been slow: the effective gravity has changed by much.
  void reset(Scene& scene);

  /// Forgets how long these bodies have been slow; the next step does not count.
  /// @param bodies a body: not 0 where it is meant
  void forget(const std::vector<std::uint8_t>& bodies);

  /// Wakes all bodies: the islands of the scene are the real ones.
  void wake(Scene& scene);

  /// Lets slow bodies of the islands that move and are neither small nor medium fall asleep for the step: they lose
  /// their velocity. True where there are any; the islands must then be found anew.
  /// @param islands the real ones
  bool choose(Scene& scene, const StepTerms& terms, const Connectivity& islands);

  /// After the step: counts how long bodies have been slow.
  void note(const Scene& scene, const StepTerms& terms);

 private:
  void find_contacts(const Scene& scene);
  template <class Counts>
  void sum_forces(const Bodies& bodies, Counts counts);
  void wake_hit(Scene& scene, const StepTerms& terms);
  void wake_unsupported(Scene& scene, const StepTerms& terms);
  void wake_overloaded(const Scene& scene, const StepTerms& terms);

  /// What a sleeping body touches: an active manifold with the sum of its forces.
  struct Contact {
    std::int32_t a = 0, b = 0;
    Vec3 force;  ///< on b, N
  };

  double rising_speed_;                    ///< over |g − a| h
  std::vector<std::uint32_t> slow_steps_;  ///< a body: steps in which it was slow, since it was fast or overloaded
  std::vector<double> speed_;              ///< a body: of any of its points, at most, when it was last awake, m/s
  std::vector<Vec3> load_;                 ///< a body that sleeps: sum of its contact forces when it fell asleep, N
  std::uint32_t steps_ = 0;                ///< since the last `reset`
  std::vector<std::uint8_t> slept_;        ///< a body: asleep in the step before
  std::vector<Contact> contacts_;          ///< of the bodies that sleep, in the order of the manifolds
  // Work buffers, an entry per body.
  std::vector<std::uint8_t> hit_;
  std::vector<Vec3> load_now_, change_;
  std::vector<double> mass_;
};

}  // namespace holdfast::internal::native
