#include "app/program_folder.hpp"

namespace holdfast::internal {

namespace {

std::filesystem::path program_root() {
  std::error_code ignored;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", ignored);
  return program.parent_path().parent_path();
}

}  // namespace

std::filesystem::path share_folder() { return program_root() / "share" / "holdfast"; }

}  // namespace holdfast::internal
