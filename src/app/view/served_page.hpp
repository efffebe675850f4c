#pragma once

#include <functional>
#include <optional>
#include <string>

#include "core/base/result.hpp"

namespace holdfast::internal {

/// Serves the viewer's page with a results file of any size on the loopback address, until the process ends. The
/// address has a token that is drawn anew each time.
/// @param page as `viewer_page` gives it
/// @param listening called once, with the address of the page
std::optional<Error> serve_page(const std::string& page, const std::string& results_path, int port,
                                const std::function<void(const std::string& address)>& listening);

}  // namespace holdfast::internal
