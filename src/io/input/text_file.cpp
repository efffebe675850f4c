#define OPENSSL_API_COMPAT 0x10100000L  // SHA256_Init and similar functions belong to that version

#include "io/input/text_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <openssl/sha.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <span>

#include "io/input/regular_file.hpp"
#include "io/results/durable_file.hpp"

namespace holdfast::internal {

namespace {

Error cannot_be_read(const std::string& path) {
  return {.file = path, .what = "cannot be read", .value = std::strerror(errno)};
}

}  // namespace

Result<TextFile> read_text_file(const std::string& path) {
  // Non-blocking: opening a pipe would wait for its writer.
  const Descriptor input(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  if (input.number < 0) return cannot_be_read(path);
  struct stat status = {};
  if (::fstat(input.number, &status) != 0) return cannot_be_read(path);
  if (const auto error = why_no_regular_file(path, status.st_mode)) return *error;
  TextFile file;
  file.path = path;
  file.name = std::filesystem::path(path).filename().string();
  // Block by block, regardless of the size that the system reports: some files of the kernel report none.
  std::array<char, std::size_t{1} << 16U> block;
  file.text.reserve(std::min(static_cast<std::size_t>(status.st_size), kMostTextBytes));
  while (file.text.size() <= kMostTextBytes) {
    const ssize_t count = ::read(input.number, block.data(), block.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return cannot_be_read(path);
    if (count == 0) break;
    file.text.append(block.data(), static_cast<std::size_t>(count));
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
  // The newer interface of OpenSSL 3 first searches for a provider of the hash, which takes longer than hashing a
  // layout.
  SHA256_CTX context;
  SHA256_Init(&context);
  SHA256_Update(&context, bytes.data(), bytes.size());
  unsigned char digest[SHA256_DIGEST_LENGTH];
  SHA256_Final(digest, &context);
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (const unsigned char byte : std::span(digest)) (text += kDigits[byte >> 4U]) += kDigits[byte & 15U];
  return text;
}

}  // namespace holdfast::internal
