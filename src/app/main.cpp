#include "app/command_line.hpp"
#include "app/report.hpp"
#include "app/uncaught.hpp"

int main(int argc, char** argv) {
  holdfast::internal::meet_the_callers_limits();
  holdfast::internal::report_uncaught();
  return holdfast::internal::run_command_line(argc, argv);
}
