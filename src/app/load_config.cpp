#include "app/load_config.hpp"

#include "app/report.hpp"

namespace holdfast::internal {

Result<Config> load_config(const std::optional<std::string>& path) {
  if (!path) return Config{};
  if (path->empty()) return Error{.what = "an empty path", .accepted = "the name of a configuration file"};
  const Result<TextFile> file = read_text_file(*path);
  if (!file) return file.errors();
  std::vector<Error> warnings;
  Result<Config> config = parse_config(*file, warnings);
  warn(warnings);
  return config;
}

}  // namespace holdfast::internal
