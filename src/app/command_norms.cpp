#include "app/commands.hpp"
#include "app/report.hpp"
#include "core/model/norms_page.hpp"

namespace holdfast::internal {

ExitCode run_norms_command() {
  print_to(stdout, "{}", norms_help());
  return ExitCode::done;
}

}  // namespace holdfast::internal
