#pragma once

#include <filesystem>

namespace holdfast {

/// Where the engines' plug-ins lie: lib/ beside the folder of the program, in the build tree as where it is installed.
std::filesystem::path plugin_folder();

/// Where files that come with the program lie: share/holdfast/ beside the folder of the program.
std::filesystem::path share_folder();

}  // namespace holdfast
