#include "api/plugin_file.hpp"

#include <dlfcn.h>

namespace holdfast::internal {

namespace {

/// Folder of the shared library, or of the program, that this code is part of.
std::filesystem::path own_folder() {
  Dl_info module = {};
  // What dladdr calls the program is what its caller called it, which need not be a path.
  std::error_code ignored;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", ignored);
  if (dladdr(reinterpret_cast<const void*>(&own_folder), &module) == 0 || module.dli_fname == nullptr)
    return program.parent_path();
  const std::filesystem::path name(module.dli_fname);
  const bool is_library = name.filename().string().find(".so") != std::string::npos;
  return (is_library ? std::filesystem::weakly_canonical(name, ignored) : program).parent_path();
}

}  // namespace

std::filesystem::path plugin_file(const std::string& name) {
  const std::filesystem::path folder = own_folder();
  std::error_code ignored;
  for (const char* beside : {".", HOLDFAST_LIBRARY_FOLDER}) {
    const std::filesystem::path file = (folder / beside / name).lexically_normal();
    if (std::filesystem::exists(file, ignored)) return file;
  }
  return (folder / name).lexically_normal();
}

}  // namespace holdfast::internal
