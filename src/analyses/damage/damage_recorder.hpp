#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "analyses/damage/damage.hpp"
#include "core/engine/analysis_method.hpp"

namespace holdfast::internal {

/// Follows what impacts do to the boxes of a world. Velocities are those of the centres of mass in a frame at rest, in
/// which the container moves. Nothing is counted in a world that ends before t = 0.
class DamageRecorder final : public AnalysisRecorder {
 public:
  /// @param window   over which accelerations are averaged, s
  /// @param gravity  m/s²
  /// @param start    state at the first step
  DamageRecorder(const DamageBoundary& boundary, double window, double gravity, const StateView& start);

  void step(const Step& step) override;
  void finish(Findings& found) override { found.put(damage()); }

  WorldDamage damage() const;

 private:
  /// The velocities of all boxes at a time. Between two instants they are interpolated; before the first they are
  /// constant.
  struct Instant {
    double time;  ///< s
    std::vector<Vec3> velocity;
  };

  /// An impact of a box that lasts, or did.
  struct Impact {
    bool lasts = false;
    Vec3 before = Vec3::Zero();  ///< velocity at its start, m/s
    double change = 0.0;         ///< largest change of the velocity in any impact so far, m/s
  };

  /// Velocity of a box at the start of the window that ends with the newest instant.
  Vec3 velocity_at_window(std::size_t box) const;
  /// @param least_change of the velocity, so that the step belongs to an impact, m/s
  void follow_impact(std::size_t box, const Vec3& before, const Vec3& after, double least_change);

  bool settles_ = false;  ///< the last step was before t = 0
  DamageBoundary boundary_;
  double window_;
  double gravity_;
  std::deque<Instant> recent_;  ///< the newest, and as many before it as the window needs
  Vec3 container_velocity_ = Vec3::Zero();
  std::vector<double> peak_acceleration_;  ///< m/s²
  std::vector<Impact> impacts_;
};

}  // namespace holdfast::internal
