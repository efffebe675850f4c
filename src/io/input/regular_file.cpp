#include "io/input/regular_file.hpp"

#include <sys/stat.h>

namespace holdfast::internal {

namespace {

const char* kind_of(mode_t mode) {
  if (S_ISFIFO(mode)) return "a pipe";
  if (S_ISSOCK(mode)) return "a socket";
  return "a device";
}

}  // namespace

std::optional<Error> why_no_regular_file(const std::string& path, mode_t mode) {
  if (S_ISREG(mode)) return std::nullopt;
  if (S_ISDIR(mode)) return Error{.file = path, .what = "is a folder", .accepted = "a file is needed here"};
  return Error{.file = path,
               .what = std::string("is ") + kind_of(mode) + ", not a file",
               .accepted = "save its output in a file, and give that file"};
}

}  // namespace holdfast::internal
