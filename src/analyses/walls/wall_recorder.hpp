#pragma once

#include <array>
#include <deque>
#include <optional>

#include "analyses/walls/wall_forces.hpp"
#include "core/engine/analysis_method.hpp"

namespace holdfast::internal {

/// Follows the forces of a world's boxes on the sides of the container; steps have their impulses. Nothing but the
/// series is found in a world that ends before t = 0.
class WallRecorder final : public AnalysisRecorder {
 public:
  /// @param norm whose limits the forces are compared with, if any
  WallRecorder(std::optional<WallNorm> norm, const BoxView& boxes);

  void step(const Step& step) override;
  void sample() override { forces_.force.push_back(force_now_); }
  void finish(Findings& found) override;

  const WallForces& forces() const { return forces_; }

 private:
  /// A step that is not yet over by `kLastingSeconds`.
  struct Recent {
    double begin, end;                       ///< s
    std::array<double, kPushedCount> force;  ///< outward, N
  };

  /// Mean force on a side over the last `kLastingSeconds`, N; before t = 0 there is none.
  double lasting_force(std::size_t side) const;

  bool settles_ = false;  ///< the last step was before t = 0
  WallForces forces_;
  std::deque<Recent> recent_;
  std::array<float, kPushedCount> force_now_ = {};  ///< outward, in the last step, N; zero before the first one
};

}  // namespace holdfast::internal
