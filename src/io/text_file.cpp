#include "io/text_file.hpp"

#include <fmt/format.h>
#include <openssl/sha.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
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
  // Block by block, whatever size the system tells: a pipe and a device tell none.
  constexpr std::size_t kBlock = std::size_t{1} << 16U;
  while (stream && file.text.size() <= kMostTextBytes) {
    const std::size_t size = file.text.size();
    file.text.resize(size + kBlock);
    stream.read(file.text.data() + size, kBlock);
    file.text.resize(size + static_cast<std::size_t>(stream.gcount()));
  }
  if (!stream.is_open() || stream.bad()) {
    return Error{.file = path, .what = "cannot be read", .value = std::strerror(errno)};
  }
  if (file.text.size() > kMostTextBytes) {
    return Error{.file = path,
                 .what = "is too large for an input file",
                 .accepted = fmt::format("at most {} MiB", kMostTextBytes >> 20U)};
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
