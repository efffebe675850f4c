#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "core/base/result.hpp"
#include "core/model/push_direction.hpp"
#include "io/results/results_schema.hpp"

namespace holdfast::internal {

struct Analysis;
class ResultsReader;

/// A number per direction, none of them known yet.
inline constexpr std::array<double, kDirectionCount> kUnknownMargins = {
    std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN(),
    std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};

/// Margins within the limits of a layout's replicas, g, one entry per direction; see `margin_spread.hpp`. NaN where
/// they are not known.
struct MarginSpread {
  std::array<double, kDirectionCount> low = kUnknownMargins;     ///< 5 % of the replicas stand less
  std::array<double, kDirectionCount> median = kUnknownMargins;  ///< half of them
  std::array<double, kDirectionCount> high = kUnknownMargins;    ///< 95 % of them
  double cpu_seconds = 0.0;                                      ///< to find them, s

  template <class Visit>
  static void describe(Visit&& visit) {
    visit(DatasetContent{"/margin_spread/low", Axis::layouts, "g",
                         "margin within the limits, in each direction, that 5 % of the layout's replicas do not "
                         "reach; NaN if it is not known, as the next two"},
          &MarginSpread::low);
    visit(DatasetContent{"/margin_spread/median", Axis::layouts, "g", "margin that half of them reach"},
          &MarginSpread::median);
    visit(DatasetContent{"/margin_spread/high", Axis::layouts, "g", "margin that 5 % of them reach"},
          &MarginSpread::high);
    visit(DatasetContent{"/margin_spread/cpu_seconds", Axis::layouts, "s", "processor time to find them"},
          &MarginSpread::cpu_seconds);
  }
};

/// How much a layout stands in each direction, see `margin_search.hpp`; one entry per direction. A critical box is a
/// position in the layout, from 1: the box that is beyond first where the acceleration is a little larger; 0 where none
/// is up to the largest acceleration that is tried.
struct LayoutMargins {
  /// Largest constant acceleration under which every box stays in its place, within 5 mm, g; NaN where it is not known.
  /// Negative: the layout is unstable under gravity alone, and this is minus the acceleration with which a box leaves.
  std::array<double, kDirectionCount> margin = kUnknownMargins;
  std::array<std::uint32_t, kDirectionCount> critical_box = {};
  /// The same where every box stays within the limits of the verdict.
  std::array<double, kDirectionCount> margin_within_limits = kUnknownMargins;
  std::array<std::uint32_t, kDirectionCount> critical_box_within_limits = {};
  std::uint32_t trials = 0;  ///< accelerations that were tried, in all directions
  double cpu_seconds = 0.0;  ///< s

  template <class Visit>
  static void describe(Visit&& visit) {
    visit(
        DatasetContent{
            "/margins/margin", Axis::layouts, "g",
            "largest constant acceleration, for as long as anything moves, under which no box leaves its place by more "
            "than 5 mm, towards the front, the rear, the left and the right; negative: the layout is unstable under "
            "gravity alone; NaN if it is not known"},
        &LayoutMargins::margin);
    visit(DatasetContent{"/margins/critical_box", Axis::layouts, "1",
                         "box that leaves its place first above that margin: position in the layout file, from 1; 0: "
                         "none up to 1.5 g"},
          &LayoutMargins::critical_box);
    visit(DatasetContent{"/margins/margin_within_limits", Axis::layouts, "g",
                         "the same where no box goes beyond a limit of the verdict", 3},
          &LayoutMargins::margin_within_limits);
    visit(DatasetContent{"/margins/critical_box_within_limits", Axis::layouts, "1",
                         "box that is beyond a limit first above that margin; 0: none up to 1.5 g", 3},
          &LayoutMargins::critical_box_within_limits);
    visit(DatasetContent{"/margins/trials", Axis::layouts, "1", "accelerations that were tried to find the margins"},
          &LayoutMargins::trials);
    visit(DatasetContent{"/margins/cpu_seconds", Axis::layouts, "s", "processor time to find the margins"},
          &LayoutMargins::cpu_seconds);
  }
};

/// The margins of layouts, with their spread where the file has it, the weakest first.
Result<std::string> margin_table(ResultsReader& results);

/// How many g each layout stands, and each of its replicas: docs/guide/margins.md.
extern const Analysis kMargins, kMarginSpread;

}  // namespace holdfast::internal
