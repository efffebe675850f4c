#pragma once

#include <vector>

#include "analyses/load_shift/load_shift.hpp"
#include "core/engine/analysis_method.hpp"

namespace holdfast::internal {

/// Follows the centre of gravity of a world's boxes, those that are not fixed to the container. Nothing is
/// found in a world that ends before t = 0.
class LoadShiftRecorder final : public AnalysisRecorder {
 public:
  LoadShiftRecorder(const BoxView& boxes, const StateView& settled);

  void step(const Step& step) override;
  void finish(Findings& found) override { found.put(settles_ ? LoadShift() : shift_); }

 private:
  Vec3 centre_of_gravity(const StateView& state) const;

  std::vector<double> share_;  ///< of the load's mass, per box
  Vec3 start_;                 ///< centre of gravity at t = 0, m
  LoadShift shift_;
  bool settles_ = false;  ///< the last step was before t = 0
};

}  // namespace holdfast::internal
