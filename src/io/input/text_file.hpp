#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "core/base/result.hpp"

namespace holdfast::internal {

/// Largest input file that is read, byte: a thousand times what any layout has, an hour of an acceleration measured at
/// 1 kHz. More is a wrong file.
inline constexpr std::size_t kMostTextBytes = std::size_t{128} << 20U;

/// An input file in memory. Inputs are small: the largest layouts have some thousand lines.
struct TextFile {
  std::string path;    ///< as the user wrote it; messages name it so
  std::string name;    ///< last part of the path
  std::string text;    ///< all bytes
  std::string sha256;  ///< of all bytes, 64 hexadecimal digits
};

/// Reads a whole file. An error says why it cannot be read (missing, no regular file, no permission, too large).
Result<TextFile> read_text_file(const std::string& path);

/// SHA-256 of the bytes, 64 lower-case hexadecimal digits.
std::string sha256_of(std::string_view bytes);

}  // namespace holdfast::internal
