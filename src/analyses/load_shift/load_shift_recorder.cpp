#include "analyses/load_shift/load_shift_recorder.hpp"

#include <cmath>

#include "analyses/settling.hpp"

namespace holdfast::internal {

LoadShiftRecorder::LoadShiftRecorder(const BoxView& boxes, const StateView& settled) {
  double load = 0.0;
  for (const double mass : boxes.mass) load += std::isfinite(mass) ? mass : 0.0;
  for (const double mass : boxes.mass) share_.push_back(std::isfinite(mass) ? mass / load : 0.0);
  start_ = centre_of_gravity(settled);
  shift_.end = shift_.peak = Vec3::Zero();
  shift_.peak_time = 0.0;
}

void LoadShiftRecorder::step(const Step& step) {
  settles_ = is_of_settling(step);
  shift_.end = centre_of_gravity(step.after) - start_;
  if (shift_.end.norm() <= shift_.peak.norm()) return;
  shift_.peak = shift_.end;
  shift_.peak_time = step.end;
}

Vec3 LoadShiftRecorder::centre_of_gravity(const StateView& state) const {
  Vec3 centre = Vec3::Zero();
  for (std::size_t box = 0; box < share_.size(); ++box) centre += share_[box] * state.position[box];
  return centre;
}

}  // namespace holdfast::internal
