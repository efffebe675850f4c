#pragma once

#include <array>
#include <deque>
#include <optional>

#include "core/engine/recorder.hpp"
#include "core/model/wall_forces.hpp"

namespace holdfast::internal {

/// Follows the forces of a world's boxes on the sides of the container.
class WallRecorder {
 public:
  /// @param norm whose limits the forces are compared with, if any
  WallRecorder(std::optional<WallNorm> norm, const BoxView& boxes);

  /// Called for every step, in order, with its impulses.
  void step(const Step& step);

  /// Outward force on each side in the last step, N; zero before the first one.
  std::array<float, kSideCount> force_now() const { return force_now_; }

  const WallForces& forces() const { return forces_; }

 private:
  /// A step that is not yet over by `kLastingSeconds`.
  struct Recent {
    double begin, end;                     ///< s
    std::array<double, kSideCount> force;  ///< outward, N
  };

  /// Mean force on a side over the last `kLastingSeconds`, N; before t = 0 there is none.
  double lasting_force(std::size_t side) const;

  WallForces forces_;
  std::deque<Recent> recent_;
  std::array<float, kSideCount> force_now_ = {};
};

}  // namespace holdfast::internal
