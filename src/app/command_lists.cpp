#include "app/commands.hpp"
#include "app/pages/containers_page.hpp"
#include "app/pages/norms_page.hpp"
#include "app/report.hpp"
#include "io/loads/known_formats.hpp"

namespace holdfast::internal {

ExitCode run_norms_command() {
  print_to(stdout, "{}", norms_help());
  return ExitCode::done;
}

ExitCode run_containers_command() {
  print_to(stdout, "{}", containers_text());
  return ExitCode::done;
}

ExitCode run_formats_command() {
  for (const KnownFormat& format : kKnownFormats) print_to(stdout, "{:<16} {}\n", format.name, format.what);
  return ExitCode::done;
}

}  // namespace holdfast::internal
