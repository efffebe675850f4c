#pragma once

namespace holdfast::internal {

extern const char* const kVersion;    ///< of the program, "2.0.0"
extern const char* const kGitCommit;  ///< of the sources it was built from, "-dirty" when changed; or "unknown"

}  // namespace holdfast::internal
