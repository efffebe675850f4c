#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "core/base/result.hpp"

namespace holdfast::internal {

/// Largest input file that is read, bytes: a thousand times the size of any layout, or an hour of an acceleration
/// measured at 1 kHz. A larger file is not an input.
inline constexpr std::size_t kMostTextBytes = std::size_t{128} << 20U;

/// An input file in memory. Inputs are small: the largest layouts have some thousand lines.
struct TextFile {
  std::string path;    ///< as the user wrote it, and as messages name it
  std::string name;    ///< last part of the path
  std::string text;    ///< all bytes
  std::string sha256;  ///< of all bytes, 64 hexadecimal digits
};

/// Reads a whole file. An error says why it cannot be read (missing, not a regular file, no permission, too large).
Result<TextFile> read_text_file(const std::string& path);

/// SHA-256 of the bytes, 64 lower-case hexadecimal digits.
std::string sha256_of(std::string_view bytes);

}  // namespace holdfast::internal
