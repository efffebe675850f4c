#pragma once

#include <string>

namespace holdfast::internal {

/// Asks the desktop to show a file or an address. What becomes of that is the desktop's.
/// @return false where there is no desktop to ask
bool open_in_browser(const std::string& place);

}  // namespace holdfast::internal
