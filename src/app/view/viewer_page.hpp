#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "core/base/result.hpp"

namespace holdfast::internal {

/// Largest results file that a page carries within itself, bytes. Browsers take more, but the page is read whole before
/// it shows anything: 64 MB open in about 2 s.
inline constexpr std::size_t kMostEmbeddedBytes = std::size_t{64} << 20U;

/// The viewer as `make viewer` built it, without results. An error says how to get it.
Result<std::string> viewer_page();

/// Whether the text is a viewer's page, with or without results.
bool is_viewer_page(std::string_view text);

/// The page with a results file in it.
/// @param name of the file, as the page shows it
std::string page_with_results(std::string_view page, std::string_view name, std::string_view bytes);

/// The page that reads a results file from an address, in ranges.
std::string page_with_address(std::string_view page, std::string_view name, std::string_view address);

}  // namespace holdfast::internal
