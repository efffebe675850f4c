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

/// Margins of a layout's replicas, g, one entry per direction; see `margin_spread.hpp`. NaN where they are not known.
struct MarginSpread {
  std::array<double, kDirectionCount> low = kUnknownMargins;     ///< 5 % of the replicas stand less
  std::array<double, kDirectionCount> median = kUnknownMargins;  ///< half of them
  std::array<double, kDirectionCount> high = kUnknownMargins;    ///< 95 % of them
  double cpu_seconds = 0.0;                                      ///< to find them, s

  template <class Visit>
  static void describe(Visit&& visit) {
    visit(
        DatasetContent{
            "/margin_spread/low", Axis::layouts, "g",
            "margin in each direction that 5 % of the layout's replicas do not reach; NaN if it is not known, as "
            "the next two"},
        &MarginSpread::low);
    visit(DatasetContent{"/margin_spread/median", Axis::layouts, "g", "margin that half of them reach"},
          &MarginSpread::median);
    visit(DatasetContent{"/margin_spread/high", Axis::layouts, "g", "margin that 5 % of them reach"},
          &MarginSpread::high);
    visit(DatasetContent{"/margin_spread/cpu_seconds", Axis::layouts, "s", "processor time to find them"},
          &MarginSpread::cpu_seconds);
  }
};

/// How much a layout stands in each direction, see `margin_search.hpp`; one entry per direction.
struct LayoutMargins {
  /// Largest constant acceleration that the layout stands, g; NaN where it is not known. Negative: the layout does not
  /// stand under gravity alone, and this is minus the largest acceleration with which a box begins to move.
  std::array<double, kDirectionCount> margin = kUnknownMargins;
  /// The box that goes first where the acceleration is a little larger: position in the layout, from 1; 0 where none
  /// does up to the largest acceleration that is tried.
  std::array<std::uint32_t, kDirectionCount> critical_box = {};
  std::uint32_t trials = 0;  ///< accelerations that were tried, in all directions
  double cpu_seconds = 0.0;  ///< s

  template <class Visit>
  static void describe(Visit&& visit) {
    visit(
        DatasetContent{
            "/margins/margin", Axis::layouts, "g",
            "largest constant acceleration that the layout stands, towards the front, the rear, the left and the "
            "right; negative: it does not stand under gravity alone; NaN if it is not known"},
        &LayoutMargins::margin);
    visit(
        DatasetContent{
            "/margins/critical_box", Axis::layouts, "1",
            "box that goes first above the margin: position in the layout file, from 1; 0: none up to 1.5 g"},
        &LayoutMargins::critical_box);
    visit(DatasetContent{"/margins/trials", Axis::layouts, "1", "accelerations that were tried to find the margins"},
          &LayoutMargins::trials);
    visit(DatasetContent{"/margins/cpu_seconds", Axis::layouts, "s", "processor time to find the margins"},
          &LayoutMargins::cpu_seconds);
  }
};

/// The margins of layouts, with their spread where the file has it, the weakest first.
Result<std::string> margin_table(ResultsReader& results);

/// How many g each layout stands, and each of its replicas: docs/margins.md.
extern const Analysis kMargins, kMarginSpread;

}  // namespace holdfast::internal
