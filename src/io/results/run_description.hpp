#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/model/acceleration.hpp"
#include "core/model/verdict.hpp"

namespace holdfast::internal {

/// What the results file says about a run as a whole, and what every world of it shares.
struct RunDescription {
  std::string software;      ///< name and version
  std::string git_commit;    ///< of the software's sources; "unknown" outside a repository
  std::string engine;        ///< name of the engine
  std::string command_line;  ///< as typed
  std::string created_utc;   ///< start of the run, ISO 8601
  std::string host;          ///< name of the machine
  std::string config_text;   ///< the configuration file as used, all bytes; may be empty
  /// Every effective setting, as (`Section/Key`, text as one would write it in the configuration file).
  std::vector<std::pair<std::string, std::string>> settings;
  std::vector<std::string> layout_names;  ///< of all layouts of the run, in its order
  /// SHA-256 of each layout's file as it was when the run began; empty where it could not be read.
  std::vector<std::string> layout_hashes;
  std::vector<Acceleration> accelerations;  ///< all of the run, in its order; a bad one has no segments
  bool record_series = true;                ///< false: end states and peaks only
  Thresholds thresholds;                    ///< by which the summary is judged
};

/// What must be the same for a run to be taken up again, as text: `software=… settings=… engine=… layouts=…
/// accelerations=… series=…`, SHA-256 of each where it is long. Neither command line, host, time, threads nor scheduler
/// are in it, nor what of the configuration file is no setting.
std::string fingerprint(const RunDescription& run);

/// Names of what differs between two fingerprints, joined by ", "; empty when they are equal.
std::string fingerprint_difference(const std::string& a, const std::string& b);

}  // namespace holdfast::internal
