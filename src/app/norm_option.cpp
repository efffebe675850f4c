#include "app/norm_option.hpp"

#include <fmt/format.h>

#include <iostream>

#include "core/model/norms.hpp"
#include "io/input/input_paths.hpp"

namespace holdfast::internal {

std::optional<Error> apply_norm(const std::optional<std::string>& norm, Settings& settings) {
  if (!norm) return std::nullopt;
  const Result<ChosenNorm> chosen = find_norm(*norm);
  if (!chosen) return chosen.error();
  settings.screening.norm = chosen->name();
  return std::nullopt;
}

Result<std::vector<std::string>> files_beside_norm(const std::vector<std::string>& paths, const Settings& settings,
                                                   std::vector<Error>& warnings) {
  if (!paths.empty()) return acceleration_paths(paths, std::cin, warnings);
  if (!settings.screening.norm.empty()) return std::vector<std::string>();
  return Error{.what = "--accelerations is required",
               .accepted = "files or folders, or --norm NAME; `holdfast norms` lists norms"};
}

std::string norm_text(const std::string& norm) {
  const ChosenNorm chosen = *find_norm(norm);
  return fmt::format("norm {}: {}; source: {}\n", chosen.name(), chosen.numbers(), chosen.norm->source);
}

}  // namespace holdfast::internal
