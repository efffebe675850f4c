#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/result.hpp"
#include "core/model/side_impulse.hpp"
#include "io/results/results_schema.hpp"

namespace holdfast::internal {

struct Analysis;
class ResultsReader;

/// What the boxes of a world did to the sides of the container; one entry per side, in the order of `kPushedNames`.
/// Forces are along the side's outward normal. NaN where they were not asked for, or the world was not accelerated.
struct WallForces {
  std::array<double, kPushedCount> peak_force = filled(kUnknown);  ///< largest mean over a step, N
  std::array<double, kPushedCount> peak_time = filled(kUnknown);   ///< start of that step, s
  /// Centre of pressure in that step, m; NaN where nothing pressed the side.
  std::array<Vec3, kPushedCount> peak_point = filled(Vec3(kUnknown, kUnknown, kUnknown));
  std::array<double, kPushedCount> lasting_force = filled(kUnknown);  ///< largest mean over `kLastingSeconds`, N
  std::array<Vec3, kPushedCount> impulse = filled(Vec3(kUnknown, kUnknown, kUnknown));  ///< from t = 0 on, N s
  std::array<double, kPushedCount> limit = filled(kUnknown);  ///< of the norm; NaN where it has none, N

  /// With series: outward force on each side per sample, mean over the step that the sample lies in, N.
  std::vector<std::array<float, kPushedCount>> force;

  bool known() const { return !std::isnan(peak_force[0]); }

  /// Lasting force over limit; NaN where there is no limit.
  double share_of_limit(std::size_t side) const { return lasting_force.at(side) / limit.at(side); }

  /// Whether the lasting force is larger than the limit.
  bool exceeds(std::size_t side) const { return share_of_limit(side) > 1.0; }

  template <class Visit>
  static void describe(Visit&& visit) {
    visit(
        DatasetContent{
            "/walls/peak_force", Axis::worlds, "N",
            "largest outward force of the boxes on the floor, front, rear, left, right, roof, on the ground, and on "
            "the fixed boxes together (length of the force), mean over a step; NaN in a world that was not "
            "accelerated, as all but force"},
        &WallForces::peak_force);
    visit(DatasetContent{"/walls/peak_time", Axis::worlds, "s", "start of the step with that force"},
          &WallForces::peak_time);
    visit(
        DatasetContent{
            "/walls/peak_point", Axis::worlds, "m",
            "x, y, z of the centre of pressure in that step, side by side; NaN where nothing pressed the side"},
        &WallForces::peak_point);
    visit(DatasetContent{"/walls/lasting_force", Axis::worlds, "N",
                         "largest outward force, mean over 0.05 s: what counts against a limit"},
          &WallForces::lasting_force);
    visit(DatasetContent{"/walls/limit", Axis::worlds, "N",
                         "test force of the norm that the run was asked for; NaN where there is none"},
          &WallForces::limit);
    visit(DatasetContent{"/walls/impulse", Axis::worlds, "N*s",
                         "x, y, z of the impulse of the boxes on the side from t = 0 to the end, side by side"},
          &WallForces::impulse);
    visit(DatasetContent{"/walls/force", Axis::samples, "N",
                         "outward force, mean over the step that the sample lies in; 0 at t = 0"},
          &WallForces::force);
  }

 private:
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  template <class Entry>
  static std::array<Entry, kPushedCount> filled(const Entry& value) {
    std::array<Entry, kPushedCount> all;
    all.fill(value);
    return all;
  }
};

/// Time over which a force has to act to count against a limit, s. A rigid box hits a rigid wall in no time, so that
/// the mean over a step of an impact grows as steps get shorter; the mean over a time that holds several steps does
/// not. EUMOS 40509 lets an acceleration build up for as long: what is over sooner is no acting force.
inline constexpr double kLastingSeconds = 0.05;

/// The largest forces on the walls over the accelerations of each layout.
Result<std::string> wall_table(ResultsReader& results);

/// Forces on the sides of the container: docs/guide/walls.md.
extern const Analysis kWalls;

}  // namespace holdfast::internal
