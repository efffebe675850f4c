#include <mpi.h>

#include <string_view>

#include "app/command_line.hpp"
#include "app/report.hpp"
#include "app/uncaught.hpp"
#include "mpi/distributed_screening.hpp"
#include "mpi/shared_counter.hpp"

namespace {

using namespace holdfast::internal;

/// The commands whose jobs are distributed.
bool is_distributed(std::string_view command) { return command == "screen" || command == "margins"; }

int run(int argc, char** argv) {
  if (argc > 1 && is_distributed(argv[1])) return run_command_line(argc, argv, run_distributed);
  // Everything else, help among it, is for one process.
  if (SharedCounter::rank() != 0) return 0;
  if (argc > 1 && argv[1][0] != '-')
    return static_cast<int>(fail(ExitCode::bad_usage, {.what = "is no command of holdfast-mpi",
                                                       .value = argv[1],
                                                       .accepted = "screen or margins; `holdfast` has the others"}));
  return run_command_line(argc, argv);
}

}  // namespace

int main(int argc, char** argv) {
  meet_the_callers_limits();
  report_uncaught();
  // The threads of a rank simulate; the main thread alone calls MPI.
  int provided = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
  const int code = run(argc, argv);
  MPI_Finalize();
  return code;
}
