#include "api/plugin_file.hpp"

#include <dlfcn.h>

namespace holdfast::internal {

namespace {

/// What this code is part of.
struct OwnFile {
  std::filesystem::path folder;
  bool is_library = false;  ///< the shared one, or else a program
};

OwnFile own_file() {
  Dl_info module = {};
  // What dladdr calls the program is what its caller called it, which need not be a path.
  std::error_code ignored;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", ignored);
  if (dladdr(reinterpret_cast<const void*>(&own_file), &module) == 0 || module.dli_fname == nullptr)
    return {program.parent_path(), false};
  const std::filesystem::path name(module.dli_fname);
  if (name.filename().string().find(".so") == std::string::npos) return {program.parent_path(), false};
  return {std::filesystem::weakly_canonical(name, ignored).parent_path(), true};
}

}  // namespace

std::filesystem::path plugin_file(const std::string& name) {
  const OwnFile own = own_file();
  const char* place = own.is_library ? HOLDFAST_PLUGIN_FOLDER : HOLDFAST_PLUGIN_FOLDER_OF_PROGRAM;
  const std::filesystem::path file = (own.folder / place / name).lexically_normal();
  const std::filesystem::path beside = own.folder / name;
  std::error_code ignored;
  return !std::filesystem::exists(file, ignored) && std::filesystem::exists(beside, ignored) ? beside : file;
}

}  // namespace holdfast::internal
