#pragma once

#include <limits>

#include "core/base/result.hpp"
#include "core/base/vector.hpp"
#include "io/results/results_schema.hpp"

namespace holdfast::internal {

struct Analysis;
class ResultsReader;

/// How far the centre of gravity of a whole load is displaced from where it is at t = 0: what changes the axle loads
/// and the tilting moment of the vehicle. Container frame; NaN where it was not asked for, or the world was not
/// accelerated.
struct LoadShift {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

  Vec3 end = Vec3(kUnknown, kUnknown, kUnknown);   ///< at the end, m
  Vec3 peak = Vec3(kUnknown, kUnknown, kUnknown);  ///< where it is farthest, over all steps, m
  double peak_time = kUnknown;                     ///< when that is, s

  template <class Visit>
  static void describe(Visit&& visit) {
    visit(
        DatasetContent{
            "/load_shift/end", Axis::worlds, "m",
            "displacement x, y, z of the load's centre of gravity at the end, from where it is at t = 0; NaN in a "
            "world that was not accelerated, as the next two"},
        &LoadShift::end);
    visit(DatasetContent{"/load_shift/peak", Axis::worlds, "m", "the same where it is farthest, over all steps"},
          &LoadShift::peak);
    visit(DatasetContent{"/load_shift/peak_time", Axis::worlds, "s", "time at which it is farthest"},
          &LoadShift::peak_time);
  }
};

/// How far the centre of gravity of a load moves: docs/guide/load_shift.md.
extern const Analysis kLoadShift;

}  // namespace holdfast::internal
