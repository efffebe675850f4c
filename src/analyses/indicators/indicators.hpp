#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "core/base/result.hpp"
#include "core/base/vector.hpp"
#include "core/model/layout.hpp"
#include "core/model/settings.hpp"
#include "io/results/results_schema.hpp"

namespace holdfast::internal {

struct Analysis;
class ResultsReader;

/// What geometry alone says of a layout: nothing is simulated. NaN, and no boxes, where the layout cannot be used.
struct LayoutIndicators {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

  Vec3 centre_of_gravity = Vec3(kUnknown, kUnknown, kUnknown);  ///< of the load, container frame, m
  /// From the middle of the container to the centre of gravity, over the container's inner size: −0.5 to 0.5.
  Vec3 centre_offset = Vec3(kUnknown, kUnknown, kUnknown);
  double fill = kUnknown;          ///< volume of the boxes over that of the container
  double badly_based = kUnknown;   ///< share of the boxes with `base_support` below `kGoodBase`
  double badly_braced = kUnknown;  ///< share of the boxes with fewer than `kGoodBracing` supported sides

  std::vector<float> base_support;            ///< per box, share of its bottom face on the floor or on other boxes
  std::vector<std::uint8_t> supported_sides;  ///< per box, how many of its four sides touch a wall or a box

  template <class Visit>
  static void describe(Visit&& visit) {
    visit(
        DatasetContent{
            "/indicators/centre_of_gravity", Axis::layouts, "m",
            "x, y, z of the load's centre of gravity as loaded, container frame; NaN if the layout could not be "
            "used, as all"},
        &LayoutIndicators::centre_of_gravity);
    visit(
        DatasetContent{
            "/indicators/centre_offset", Axis::layouts, "1",
            "from the middle of the container to the centre of gravity, over the container's inner size: -0.5 to 0.5"},
        &LayoutIndicators::centre_offset);
    visit(DatasetContent{"/indicators/fill", Axis::layouts, "1", "volume of the boxes over that of the container"},
          &LayoutIndicators::fill);
    visit(DatasetContent{"/indicators/badly_based", Axis::layouts, "1",
                         "share of the boxes with base_support below 0.75"},
          &LayoutIndicators::badly_based);
    visit(DatasetContent{"/indicators/badly_braced", Axis::layouts, "1",
                         "share of the boxes with fewer than 3 supported_sides"},
          &LayoutIndicators::badly_braced);
    visit(DatasetContent{"/indicators/base_support", Axis::layout_boxes, "1",
                         "share of the box's bottom face on the floor or on other boxes, within 1 mm; rows as in "
                         "/inputs/layouts/material"},
          &LayoutIndicators::base_support);
    visit(DatasetContent{"/indicators/supported_sides", Axis::layout_boxes, "1",
                         "how many of its four sides touch a wall or another box, within 1 cm"},
          &LayoutIndicators::supported_sides);
  }
};

/// Distance up to which a box counts as standing on what is below, m. Layout files are exact to rounding.
inline constexpr double kBaseGap = 1e-3;
/// Distance up to which the side of a box counts as touching, m. At 0.5 g a box crosses it with 0.3 m/s at most.
/// Larger: boxes with room to gain speed count as supported.
inline constexpr double kSideGap = 1e-2;
/// Common length of two faces along each axis from which they count as facing each other, m.
inline constexpr double kLeastOverlap = 1e-3;
/// Share of the bottom face below which a box is badly based. In the literature 0.7 to 1 are asked for.
inline constexpr double kGoodBase = 0.75;
/// Number of supported sides below which a box is badly braced (Bischoff and Ratcliff 1995).
inline constexpr int kGoodBracing = 3;

/// The indicators of a layout in its container, or that of the settings. Open sides support nothing, and the floor ends
/// there; low sides support what they reach, and what stands on them.
LayoutIndicators find_indicators(const Layout& layout, const Settings& settings);

/// The indicators of layouts, in the order of the run.
Result<std::string> indicator_table(ResultsReader& results);

/// What geometry alone says of a layout: docs/guide/indicators.md.
extern const Analysis kIndicators;

}  // namespace holdfast::internal
