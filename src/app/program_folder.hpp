#pragma once

#include <filesystem>

namespace holdfast::internal {

/// Where files that come with the program lie: share/holdfast/ beside the folder of the program.
std::filesystem::path share_folder();

}  // namespace holdfast::internal
