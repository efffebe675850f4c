#pragma once

#include <functional>
#include <optional>
#include <string>

#include "core/base/result.hpp"

namespace holdfast::internal {

/// A page and the results file that it reads, as they are served.
struct ServedPage {
  std::string page;          ///< HTML
  std::string results_path;  ///< answered in the ranges that the page asks for
  std::string token;         ///< first part of every address; whoever does not know it gets nothing
  int port = 0;              ///< 0: one that is free
};

/// Address of the results, relative to that of the page.
inline constexpr const char* kResultsAddress = "results";

/// The function that the plug-in exports under the name `kServePageEntry`: it serves on the loopback address,
/// read-only, until the process ends. A plug-in, because the HTTP library draws in others that would delay every start
/// of the program.
/// @param listening called once, with the address of the page, when it can be asked for
using ServePage = void(const ServedPage& served, const std::function<void(const std::string& address)>& listening,
                       std::optional<Error>& error);
inline constexpr const char* kServePageEntry = "holdfast_serve_page";
inline constexpr const char* kServePagePlugin = "libholdfast-page-server.so";

}  // namespace holdfast::internal
