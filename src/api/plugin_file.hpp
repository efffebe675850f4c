#pragma once

#include <filesystem>
#include <string>

namespace holdfast::internal {

/// Path of an engine's plug-in: beside the library that holds this code, or in the library folder that belongs to the
/// program that holds it. The file need not be there.
/// @param name file name, such as `libholdfast-bullet.so`
std::filesystem::path plugin_file(const std::string& name);

}  // namespace holdfast::internal
