#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <optional>

#include "app/commands.hpp"
#include "app/reading_guard.hpp"
#include "app/report.hpp"
#include "app/view/open_in_browser.hpp"
#include "app/view/served_page.hpp"
#include "app/view/viewer_page.hpp"
#include "io/export/text_output.hpp"
#include "io/input/text_file.hpp"
#include "io/results/results_reader.hpp"

namespace holdfast::internal {

namespace {

ExitCode check_results(const std::string& path) {
  const Result<ResultsReader> results = ResultsReader::open(path);
  return results ? ExitCode::done : fail(ExitCode::bad_usage, results.error());
}

void show(const std::string& place) {
  if (!open_in_browser(place)) print_to(stderr, "no browser could be started: open {} yourself\n", place);
}

/// Beside the results file, with its name.
std::string page_beside(const std::string& results_path) {
  return std::filesystem::path(results_path).replace_extension(".html").string();
}

std::optional<Error> too_large(const std::string& path) {
  std::error_code unknown;
  const auto size = std::filesystem::file_size(path, unknown);
  if (unknown || size <= kMostEmbeddedBytes) return std::nullopt;
  return Error{.file = path,
               .what = "is too large to be part of a page",
               .value = fmt::format("{} MB", size >> 20U),
               .accepted = fmt::format("at most {} MB; --serve shows it", kMostEmbeddedBytes >> 20U)};
}

/// Of a page without results, in the current folder.
constexpr const char* kEmptyPage = "holdfast.html";

/// The page with the results, or without where there are none.
Result<std::string> filled_page(const ViewOptions& options, const std::string& page) {
  if (options.results_path.empty()) return page;
  if (const auto error = too_large(options.results_path)) return *error;
  const Result<TextFile> results = read_text_file(options.results_path);
  if (!results) return results.errors();
  return page_with_results(page, results->name, results->text);
}

ExitCode write_page(const ViewOptions& options, const std::string& page) {
  const std::string path =
      options.page_path.value_or(options.results_path.empty() ? kEmptyPage : page_beside(options.results_path));
  const auto is_page = [](const std::string& old) {
    const Result<TextFile> file = read_text_file(old);
    return file && is_viewer_page(file->text);
  };
  if (const auto error = check_output_file(path, is_page)) return fail(ExitCode::bad_usage, *error);
  const Result<std::string> filled = filled_page(options, page);
  if (!filled) return fail(ExitCode::bad_usage, filled.errors());
  if (const auto error = write_text_file(path, *filled)) return fail(ExitCode::some_failed, *error);
  print_to(stdout, "{}\n", path);
  if (options.open) show(path);
  return ExitCode::done;
}

ExitCode serve_results(const ViewOptions& options, const std::string& page) {
  const auto listening = [&options](const std::string& address) {
    print_to(stdout, "{}\n", address);
    (void)std::fflush(stdout);
    if (options.open) show(address);
  };
  if (const auto error = serve_page(page, options.results_path, options.port, listening))
    return fail(ExitCode::some_failed, *error);
  return ExitCode::done;
}

}  // namespace

ExitCode run_view_command(const ViewOptions& options) {
  if (!options.results_path.empty()) {
    // In a process of its own, as a damaged file may end it.
    const ExitCode checked =
        guard_reading({.path = options.results_path, .cure = "simulate again", .memory = options.memory},
                      [&] { return check_results(options.results_path); });
    if (checked != ExitCode::done) return checked;
  }
  const Result<std::string> page = viewer_page();
  if (!page) return fail(ExitCode::some_failed, page.errors());
  return options.serve ? serve_results(options, *page) : write_page(options, *page);
}

}  // namespace holdfast::internal
