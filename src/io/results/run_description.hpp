#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/model/acceleration.hpp"
#include "core/model/shard.hpp"
#include "core/model/verdict.hpp"
#include "io/results/analysis_tables.hpp"

namespace holdfast::internal {

/// What a shard knows of the run that it is a part of.
struct ShardOfRun {
  Shard shard;
  std::string run_fingerprint;  ///< `fingerprint_with_contents` of the whole run
};

/// The properties of a run that its worlds share, as the results file stores them.
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
  /// SHA-256 of each layout file when the run began; empty if it could not be read.
  std::vector<std::string> layout_hashes;
  std::vector<Acceleration> accelerations;  ///< of the run, in its order; a bad acceleration has no segments
  RunTables analyses;                       ///< what the run finds out beside the verdicts
  bool record_series = true;                ///< false: end states and peaks only
  Thresholds thresholds;                    ///< of the summary
  std::optional<ShardOfRun> shard;          ///< of a run that is a part of another
};

/// Everything that must be the same for a run to be resumed, as text: `software=… settings=… engine=… layouts=…
/// accelerations=… series=…`, with the SHA-256 of long items. It does not include command line, host, time, threads,
/// scheduler, or parts of the configuration file that are not settings.
std::string fingerprint(const RunDescription& run);

/// The same with the SHA-256 of what is in all layouts, as `layout_contents=…`: what shards of one run share.
std::string fingerprint_with_contents(const RunDescription& run);

/// Names of the items that differ between two fingerprints, joined by ", "; empty if they are equal.
std::string fingerprint_difference(const std::string& a, const std::string& b);

}  // namespace holdfast::internal
