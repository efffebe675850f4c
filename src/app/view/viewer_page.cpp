#include "app/view/viewer_page.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <filesystem>

#include "app/program_folder.hpp"
#include "io/input/text_file.hpp"

namespace holdfast::internal {

namespace {

/// Where the page takes its results.
constexpr std::string_view kPlace = "<!--RESULTS-->";

/// Only the viewer has it, near its beginning.
constexpr std::string_view kMark = R"(<meta name="generator" content="holdfast viewer">)";

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t j = i; j < i + 3; ++j) group = group << 8U | (j < bytes.size() ? std::uint8_t(bytes[j]) : 0U);
    for (std::size_t j = 0; j < 4; ++j) text += i + j <= bytes.size() ? kDigits[group >> (18 - 6 * j) & 63U] : '=';
  }
  return text;
}

std::string as_attribute(std::string_view text) {
  std::string escaped;
  for (const char letter : text) {
    switch (letter) {
      case '&':
        escaped += "&amp;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      default:
        escaped += letter;
    }
  }
  return escaped;
}

/// What the policy of the page lets it ask for: packed parts of itself. A page that is served asks its server, too.
constexpr std::string_view kMayAsk = "connect-src data:";

/// A page with one of its parts replaced.
std::string with(std::string_view page, std::string_view part, std::string_view other) {
  const std::size_t at = page.find(part);
  std::string text;
  text.reserve(page.size() + other.size());
  text.append(page.substr(0, at)).append(other).append(page.substr(at + part.size()));
  return text;
}

}  // namespace

Result<std::string> viewer_page() {
  const std::string path = (share_folder() / "viewer.html").string();
  std::error_code unknown;
  if (!std::filesystem::exists(path, unknown)) {
    return Error{.file = path,
                 .what = "the viewer is not built",
                 .accepted = "`make viewer` in the sources builds it; the package holdfast-viewer has it"};
  }
  Result<TextFile> file = read_text_file(path);
  if (!file) return file.errors();
  const auto has = [&](std::string_view part) { return file->text.find(part) != std::string::npos; };
  if (!is_viewer_page(file->text) || !has(kPlace) || !has(kMayAsk)) {
    return Error{.file = path, .what = "is no page of the viewer", .accepted = "`make viewer` builds it again"};
  }
  return std::move(file->text);
}

bool is_viewer_page(std::string_view text) { return text.substr(0, 1024).find(kMark) != std::string_view::npos; }

std::string page_with_results(std::string_view page, std::string_view name, std::string_view bytes) {
  return with(page, kPlace,
              fmt::format(R"(<script type="text/plain" id="results" data-name="{}">{}</script>)", as_attribute(name),
                          base64(bytes)));
}

std::string page_with_address(std::string_view page, std::string_view name, std::string_view address) {
  return with(with(page, kMayAsk, std::string(kMayAsk) + " 'self'"), kPlace,
              fmt::format(R"(<script type="text/plain" id="results" data-name="{}" data-address="{}"></script>)",
                          as_attribute(name), as_attribute(address)));
}

}  // namespace holdfast::internal
