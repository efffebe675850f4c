#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "core/model/settings.hpp"

namespace holdfast::internal {

/// Puts the norm of the command line, where one is given, into the settings; or says what is wrong with it.
std::optional<Error> apply_norm(const std::optional<std::string>& norm, Settings& settings);

/// The files of accelerations that paths refer to: none where a norm makes the accelerations and no paths are given.
/// Standard input may list them.
Result<std::vector<std::string>> files_beside_norm(const std::vector<std::string>& paths, const Settings& settings,
                                                   std::vector<Error>& warnings);

/// One line about a norm: its numbers and their source.
std::string norm_text(const std::string& norm);

}  // namespace holdfast::internal
