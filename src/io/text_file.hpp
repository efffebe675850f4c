#pragma once

#include <string>
#include <string_view>

#include "core/result.hpp"

namespace holdfast {

/// An input file in memory. Inputs are small: the largest layouts have some thousand lines.
struct TextFile {
  std::string path;    ///< as the user wrote it; messages name it so
  std::string name;    ///< last part of the path
  std::string text;    ///< all bytes
  std::string sha256;  ///< of all bytes, 64 hexadecimal digits
};

/// Reads a whole file. An error says why it cannot be read (missing, a folder, no permission).
Result<TextFile> read_text_file(const std::string& path);

/// SHA-256 of the bytes, 64 lower-case hexadecimal digits.
std::string sha256_of(std::string_view bytes);

}  // namespace holdfast
