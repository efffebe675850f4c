#include "app/stage_costs_file.hpp"

#include <nlohmann/json.hpp>

#include "io/export/text_output.hpp"
#include "io/input/text_file.hpp"

namespace holdfast::internal {

std::optional<Error> write_stage_seconds(const StageSeconds& seconds, const std::string& path) {
  nlohmann::ordered_json json;
  for (std::size_t i = 0; i < seconds.size(); ++i) json[kStageNames[i]] = seconds[i];
  return write_text_file(path, json.dump(2) + '\n');
}

std::optional<Error> check_costs_file(const std::string& path) {
  return check_output_file(path, [](const std::string& old) { return bool(read_stage_seconds(old)); });
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

}  // namespace holdfast::internal
