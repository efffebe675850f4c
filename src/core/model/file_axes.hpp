#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "core/base/vector.hpp"

namespace holdfast::internal {

/// Which axes of a file are the container's length, width and height, and from which end they count.
struct FileAxes {
  struct Axis {
    std::size_t of_file = 0;  ///< 0, 1, 2: x, y, z of the file
    bool from_end = false;    ///< it counts from the far side: rear, right wall or roof
    friend bool operator==(const Axis&, const Axis&) = default;
  };
  std::array<Axis, 3> axes = {{{0, false}, {1, false}, {2, false}}};  ///< length, width, height

  friend bool operator==(const FileAxes&, const FileAxes&) = default;

  /// Lengths along the axes of the file, as lengths along those of the container.
  Vec3 extents(const Vec3& of_file) const;

  /// Two corners of the file, which need not be in order along axes from the end, as corners in the container, m.
  std::pair<Vec3, Vec3> corners(const Vec3& low, const Vec3& high, const Vec3& container_size) const;
};

/// Reads `-z x y`: three different axes, for length, width and height, with a minus where one counts from the far side.
std::optional<FileAxes> parse_axes(std::string_view text);
std::string axes_text(const FileAxes& axes);

}  // namespace holdfast::internal
