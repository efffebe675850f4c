#include <fmt/format.h>

#include <csignal>

#include "app/commands.hpp"
#include "app/reading_guard.hpp"
#include "app/report.hpp"
#include "app/shared_script.hpp"
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

std::optional<Error> check_report(const std::string& path) {
  if (!path.ends_with(".html") && !path.ends_with(".pdf"))
    return Error{
        .what = "the report has no known format", .value = path, .accepted = "a name that ends in .html or .pdf"};
  return check_output_file(path, is_report);
}

}  // namespace

ExitCode run_report_command(const ReportOptions& options) {
  if (const auto error = check_report(options.output_path)) return fail(ExitCode::bad_usage, *error);
  const std::vector<std::string> arguments = {"--most", fmt::format("{}", options.most), "--", options.results_path,
                                              options.output_path};
  return guard_reading({.path = options.results_path, .cure = "simulate it again", .memory = options.memory}, [&] {
    const Result<ResultsReader> results = ResultsReader::open(options.results_path);
    if (!results) return fail(ExitCode::bad_usage, results.error());
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
