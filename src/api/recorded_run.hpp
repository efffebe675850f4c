#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "io/results/output_lock.hpp"
#include "io/results/run_description.hpp"
#include "parallel/screening/screening.hpp"

namespace holdfast::internal {

/// What to do about results that are there already.
enum class ExistingResults { refuse, resume, overwrite };

/// A run whose results go to a file.
struct Recording {
  std::string path;            ///< of the results file
  RunDescription description;  ///< what the file says of the run
  ExistingResults existing = ExistingResults::refuse;
  bool report_finished = false;  ///< the observer is also called for worlds that an earlier run finished
};

/// How such a run ended.
struct RecordedEnd {
  enum class Kind {
    complete,  ///< the results file is there
    refused,   ///< nothing was simulated: inputs, or results that are there already, are in the way
    stopped,   ///< by request; the finished parts are kept, and a resumed run continues from them
    failed,    ///< the run, or the assembly of the file, met an error; `safe_worlds` says what is kept
  };
  Kind kind = Kind::complete;
  std::vector<Error> errors;      ///< why; empty when complete or stopped
  std::uint64_t done = 0;         ///< worlds that are simulated and written
  std::uint64_t total = 0;        ///< worlds of the run
  bool was_complete = false;      ///< an earlier run had finished already
  bool parts_are_gone = false;    ///< the folder of the parts has been removed by somebody
  std::uint64_t safe_worlds = 0;  ///< after a failure: worlds that a resumed run would find
};

/// Runs the plan and writes its results file: continues an earlier run, simulates, assembles the parts. What is
/// finished survives whatever ends the process (docs/reference/results_file.md).
/// @param plan      `finished_worlds` is set here
/// @param lock      on the results file, held by the caller
RecordedEnd record_run(ScreeningPlan plan, const Recording& recording, const OutputLock& lock, RunObserver& observer,
                       const StopRequest& stop, StageCosts& costs);

/// SHA-256 of the numbers of an acceleration that is from no file.
std::string hash_of(const Acceleration& acceleration);

/// What the results file says about a run; `command_line`, `config_text` and the names are the caller's.
/// @param hashes SHA-256 of each layout's file; empty where there is none
RunDescription describe_run(const Settings& settings, std::vector<std::string> layout_names,
                            std::vector<std::string> hashes, std::span<const ReadAcceleration> accelerations,
                            bool record_series);

}  // namespace holdfast::internal
