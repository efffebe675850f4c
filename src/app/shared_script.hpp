#pragma once

#include <optional>
#include <string>
#include <vector>

namespace holdfast::internal {

/// Added to the number of the signal that ended a script, as shells do.
inline constexpr int kBySignal = 128;

/// Runs a Python script that comes with the program, with the streams of the program, and waits for its end.
/// @param name of the file in `share_folder()`
/// @return its exit status, or `kBySignal` and the signal; nothing when it could not be started
std::optional<int> run_shared_script(const std::string& name, const std::vector<std::string>& arguments);

}  // namespace holdfast::internal
