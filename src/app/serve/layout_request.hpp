#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.hpp"
#include "holdfast/holdfast.hpp"

namespace holdfast::internal {

/// How the layout of a line is to be evaluated, and what is to be said of it. A screen evaluates lines that want the
/// same.
struct RequestOptions {
  holdfast::LengthUnit unit = holdfast::LengthUnit::metre;
  std::vector<std::size_t> accelerations;  ///< indices, in the order of the line; empty: all there are
  bool per_box = false;                    ///< how every box ended
  bool series = false;                     ///< time series

  bool operator==(const RequestOptions&) const = default;
};

/// A line of the input of `holdfast serve`.
struct LayoutRequest {
  std::string id = "null";      ///< text of JSON, as it is in the line
  std::vector<double> numbers;  ///< of the boxes, seven per box, as in `holdfast::LayoutView`
  /// The layout in place of `numbers`, where a box is an object or the line has a container.
  std::optional<holdfast::Layout> layout;
  RequestOptions options;
  std::vector<std::size_t> places;  ///< where each box begins in the line, in bytes from 0
  /// Where the numbers of a box that is an object begin, 0 for those that are not there; by the index of the box.
  std::map<std::size_t, std::array<std::size_t, 7>> number_places;

  /// Names of the boxes; empty where none has one.
  std::vector<std::string> box_names() const;
};

/// A line that was read as far as it can be.
struct ReadRequest {
  LayoutRequest request;  ///< the id is there also where the rest cannot be used, unless it comes after a bad place
  std::optional<Error> error;  ///< the first mistake, with its column, and box and number where it is in one
};

/// Reads a line.
/// @param accelerations names that it may choose from
ReadRequest read_request(std::string_view line, std::span<const std::string> accelerations);

/// Column in the line, from 1, of a number of a box, both from 0; that of the box with a negative number; 0 when there
/// is no such box.
long column_of(std::string_view line, const LayoutRequest& request, std::ptrdiff_t box, int number);

}  // namespace holdfast::internal
