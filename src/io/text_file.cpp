#include "io/text_file.hpp"

#include <fmt/format.h>
#include <openssl/sha.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <span>

namespace holdfast {

Result<TextFile> read_text_file(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    return Error{.file = path, .what = "is a folder", .accepted = "a file is needed here"};
  }
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  TextFile file;
  file.path = path;
  file.name = std::filesystem::path(path).filename().string();
  if (stream) file.text.assign(std::istreambuf_iterator<char>(stream), {});
  if (!stream.is_open() || stream.bad()) {
    return Error{.file = path, .what = "cannot be read", .value = std::strerror(errno)};
  }
  file.sha256 = sha256_of(file.text);
  return file;
}

std::string sha256_of(std::string_view bytes) {
  unsigned char digest[SHA256_DIGEST_LENGTH];
  SHA256(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(), digest);
  std::string text;
  for (const unsigned char byte : std::span(digest)) text += fmt::format("{:02x}", byte);
  return text;
}

}  // namespace holdfast
