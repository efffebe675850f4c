#pragma once

#include <filesystem>
#include <string>

namespace holdfast::internal {

/// Path of a plug-in: in the folder of plug-ins below that of the libraries (`lib/holdfast/VERSION`), or beside the
/// library or program that holds this code. The file need not be there.
/// @param name file name, such as `libholdfast-bullet.so`
std::filesystem::path plugin_file(const std::string& name);

}  // namespace holdfast::internal
