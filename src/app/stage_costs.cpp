#include "app/stage_costs.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

#include "io/text_file.hpp"

namespace holdfast {

StageSeconds StageCosts::seconds() const {
  StageSeconds seconds{};
  for (std::size_t i = 0; i < seconds.size(); ++i) seconds[i] = seconds_[i];
  seconds[static_cast<std::size_t>(Stage::simulate)] -= seconds[static_cast<std::size_t>(Stage::build)];
  return seconds;
}

std::optional<Error> write_stage_seconds(const StageSeconds& seconds, const std::string& path) {
  nlohmann::ordered_json json;
  for (std::size_t i = 0; i < seconds.size(); ++i) json[kStageNames[i]] = seconds[i];
  std::ofstream file(path, std::ios::trunc);
  file << json.dump(2) << '\n';
  file.close();
  if (!file) return Error{.file = path, .what = "cannot be written"};
  return std::nullopt;
}

Result<StageSeconds> read_stage_seconds(const std::string& path) {
  const Result<TextFile> file = read_text_file(path);
  if (!file) return file.errors();
  const auto json = nlohmann::json::parse(file->text, nullptr, false);
  StageSeconds seconds{};
  for (std::size_t i = 0; i < seconds.size(); ++i) {
    if (!json.is_object() || !json.contains(kStageNames[i]) || !json[kStageNames[i]].is_number())
      return Error{.file = path, .what = "has no processor time of a stage", .value = kStageNames[i]};
    seconds[i] = json[kStageNames[i]];
  }
  return seconds;
}

}  // namespace holdfast
