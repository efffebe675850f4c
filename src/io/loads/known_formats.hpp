#pragma once

#include <array>
#include <string_view>

namespace holdfast::internal {

/// Tables of which the words of the header do not tell everything.
struct KnownFormat {
  std::string_view name;     ///< as `--format` takes it
  std::string_view what;     ///< in words
  std::string_view axes;     ///< as `--axes` takes them; empty: x y z
  std::string_view unit;     ///< where headers have none; empty: by the file
  std::string_view columns;  ///< as `--columns` takes them
  /// Codes of orientations from 0 on, separated by blanks: which own size lies along x, y and z of the file, in letters
  /// of those axes; empty: the usual ones.
  std::string_view turns = {};
  std::string_view sign = {};  ///< a key that tells the format; empty: none does
};

inline constexpr std::array kKnownFormats = {
    KnownFormat{"planner", "load planners that count z from the door, x from the left wall and y upwards", "-z x y", "",
                ""},
    KnownFormat{"y-up", "packers that count x along the length, y upwards and z across from right to left", "x -z y",
                "", ""},
    KnownFormat{"y-up-left", "packers that count x along the length, y upwards and z across from left to right",
                "x z y", "", ""},
    KnownFormat{"py3dbp", "py3dbp and its kin: width along x, height along y, depth along z, which is the length",
                "z x y", "", "width = dx, height = dy, depth = dz", "xyz yxz yzx zyx zxy xzy", "\"rotation_type\""},
    KnownFormat{"packingsolver", "solutions of PackingSolver: rows of bins and items, sizes as placed", "", "", ""},
};

}  // namespace holdfast::internal
