#pragma once

#include <cstdint>
#include <vector>

#include "core/engine/engine.hpp"
#include "core/native/connectivity.hpp"
#include "core/native/island/rest_proof.hpp"
#include "core/native/scene.hpp"

namespace holdfast::internal::native {

/// How what acts on the bodies has changed since the step before.
enum class Change : std::uint8_t {
  none,
  little,  ///< g − a, by no more than `kSmall` since it last changed by much
  much,    ///< g − a by more, or a force from outside, or a coefficient of friction
};

/// Decides at the start of a step which islands of a world rest and which move.
class RestDecision {
 public:
  explicit RestDecision(std::size_t bodies = 0)
      : reset_(bodies, 0),
        refuted_(bodies, 0),
        undecided_(bodies, 0),
        wait_(bodies, 0),
        next_wait_(bodies, 0),
        pushes_with_(bodies, 0) {}

  /// Takes down what acts in the steps to come. No body rests any longer, if it has changed.
  /// @param disturbed a force or a coefficient has changed
  Change note(Bodies& bodies, const StepTerms& terms, const Vec3& effective_gravity, bool disturbed);

  /// Makes islands whose bodies are slow enough rest where that is proved, and all others move. Finds the islands,
  /// which contacts join that bodies lean on.
  /// @param freeze islands that rest are left alone until something touches them
  void decide(Scene& scene, const StepTerms& terms, Connectivity& islands, bool freeze, RestProof& proof,
              Counters& counters);

  /// Adds what the bodies that rest have done to the sides, where that is asked for.
  /// @param duration of what has been taken of the step, s
  void add_pushes(Scene& scene, const StepTerms& terms, double duration, RestProof& proof);

  /// The terms of the step for an island, with whether it is reset, and refuted.
  StepTerms terms_for(const StepTerms& terms, const IslandView& island) const;

  /// The step has been taken: nothing has changed since.
  void end_step() { change_ = Change::none; }

 private:
  void reset_small_islands(const Connectivity& islands);
  bool is_due(const IslandView& island);
  bool prove(Scene& scene, const StepTerms& terms, const IslandView& island, bool leans, RestProof& proof,
             Counters& counters);
  void find_resting_pushes(Scene& scene, const StepTerms& terms, RestProof& proof);
  bool activate_leaning(Scene& scene, const StepTerms& terms);

  Change change_ = Change::none;
  Vec3 reset_gravity_ = Vec3::Zero();            ///< g − a when it last changed by much, m/s²
  std::vector<std::uint8_t> reset_;              ///< a body: where g − a has just changed, its last step is no guess
  std::vector<std::uint8_t> refuted_;            ///< a body: its proof of rest has failed in this step
  std::vector<std::uint8_t> undecided_;          ///< a body: whether it rests in this step is not known yet
  std::vector<std::uint32_t> wait_, next_wait_;  ///< a body: steps until rest is tried again, and the wait after that
  std::vector<std::uint64_t> pushes_with_;  ///< a body: hash of those with which its pushes at rest are known; none: 0
};

}  // namespace holdfast::internal::native
