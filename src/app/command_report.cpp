#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <csignal>

#include "app/commands.hpp"
#include "app/reading_guard.hpp"
#include "app/report.hpp"
#include "app/shared_script.hpp"
#include "app/stored_bearing.hpp"
#include "core/model/norms.hpp"
#include "io/export/text_output.hpp"
#include "io/input/text_file.hpp"
#include "io/results/results_reader.hpp"

namespace holdfast::internal {

namespace {

/// Reports name what made them, in HTML and in PDF.
bool is_report(const std::string& path) {
  const Result<TextFile> file = read_text_file(path);
  return file && (file->text.find("content=\"holdfast report\"") != std::string::npos ||
                  file->text.find("/Creator (holdfast report)") != std::string::npos);
}

/// The path of a file with a text that lives as long as this process and those that it starts; empty where there is no
/// memory for it.
std::string file_in_memory(const std::string& text) {
  const int file = memfd_create("bearing", 0);
  if (file < 0 || write(file, text.data(), text.size()) != static_cast<ssize_t>(text.size())) return {};
  return fmt::format("/proc/self/fd/{}", file);
}

std::optional<Error> check_report(const std::string& path) {
  if (!path.ends_with(".html") && !path.ends_with(".pdf"))
    return Error{
        .what = "the report has no known format", .value = path, .accepted = "a name that ends in .html or .pdf"};
  return check_output_file(path, is_report);
}

}  // namespace

ExitCode run_report_command(const ReportOptions& options) {
  if (const auto error = check_report(options.output_path)) return fail(ExitCode::bad_usage, *error);
  return guard_reading({.path = options.results_path, .cure = "simulate it again", .memory = options.memory}, [&] {
    Result<ResultsReader> results = ResultsReader::open(options.results_path);
    if (!results) return fail(ExitCode::bad_usage, results.error());
    const Result<std::string> bearing = bearing_json(*results, static_cast<std::size_t>(options.most));
    if (!bearing) return fail(ExitCode::bad_usage, bearing.error());
    const std::string bearing_file = file_in_memory(*bearing);
    std::vector<std::string> arguments = {"--most", fmt::format("{}", options.most)};
    if (!bearing_file.empty()) arguments.insert(arguments.end(), {"--bearing", bearing_file});
    // The norm is a text of the file, which may have been another program's.
    if (const auto norm = find_norm(results->info().norm))
      arguments.insert(arguments.end(), {"--norm-source", std::string(norm->norm->source)});
    arguments.insert(arguments.end(), {"--", options.results_path, options.output_path});
    const std::optional<int> status = run_shared_script("load_report.py", arguments);
    if (status == 0) return ExitCode::done;
    if (status > kBySignal) {
      // It read the file: the guard says what that means.
      std::signal(*status - kBySignal, SIG_DFL);
      std::raise(*status - kBySignal);
    }
    // A script that ran has said why.
    if (status) return ExitCode::some_failed;
    return fail(ExitCode::some_failed,
                {.what = "the report could not be drawn",
                 .accepted = "python3 with h5py is needed; `holdfast summary --csv` needs neither"});
  });
}

}  // namespace holdfast::internal
