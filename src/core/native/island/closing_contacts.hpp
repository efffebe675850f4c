#pragma once

#include <limits>

#include "core/native/island/impacts.hpp"
#include "core/native/island/solved_motion.hpp"

namespace holdfast::internal::native {

/// Looks for contacts outside of the solve of a part of a step that the part would make overlap.
class ClosingContacts {
 public:
  /// @param motion of the solutions of the island
  explicit ClosingContacts(const SolvedMotion& motion) : motion_(motion) {}

  /// The first overlap that a part would bring.
  struct Event {
    bool activated = false;                                 ///< manifolds became active: it must be solved again
    double time = std::numeric_limits<double>::infinity();  ///< of the first fast impact, s from its start
  };

  /// Begins a part of a step: nothing is predicted.
  void begin(const Scene& scene) { predicted_.assign(scene.manifolds.size(), 0); }

  /// Points that are solved because they were found to close within the part.
  const PointBits& predicted() const { return predicted_; }

  /// Slow contacts become active and predicted; the first fast one is the event that cuts the part.
  /// @param step length of the part, s
  Event find(Scene& scene, const IslandView& island, const StepTerms& terms, const Effort& effort,
             const ImpactTiming& timing, double step);

 private:
  void activate_nearby(Scene& scene, const IslandView& island, const StepTerms& terms, const PointFilter& filter,
                       double step) const;

  const SolvedMotion& motion_;
  PointBits predicted_;
};

}  // namespace holdfast::internal::native
