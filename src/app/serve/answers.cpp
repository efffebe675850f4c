#include "app/serve/answers.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <utility>

#include "app/report.hpp"
#include "app/world_json.hpp"

namespace holdfast::internal {

namespace {

using Json = nlohmann::ordered_json;

/// A column of a series as one list per sample.
template <class Entry>
Json by_sample(const std::vector<Entry>& column, std::size_t samples) {
  Json lists = Json::array();
  const std::size_t boxes = samples > 0 ? column.size() / samples : 0;
  for (std::size_t i = 0; i < samples; ++i) {
    Json list = Json::array();
    for (std::size_t j = 0; j < boxes; ++j) list.push_back(column[i * boxes + j]);
    lists.push_back(std::move(list));
  }
  return lists;
}

Json json_of(const holdfast::Series& series) {
  const std::size_t samples = series.time.size();
  return {{"time_s", series.time},
          {"displacement_m", by_sample(series.displacement, samples)},
          {"orientation_wxyz", by_sample(series.orientation, samples)},
          {"angular_velocity_rad_s", by_sample(series.angular_velocity, samples)}};
}

Json number_or_null(long number) { return number > 0 ? Json(number) : Json(nullptr); }
Json text_or_null(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

}  // namespace

std::string verdicts_text(const AnsweredLine& line, std::span<const holdfast::WorldOutcome> worlds,
                          std::span<const std::string> accelerations, const RequestOptions& options) {
  Json verdicts = Json::array();
  for (const holdfast::WorldOutcome& world : worlds) {
    Json& json = verdicts.emplace_back(Json::object());
    append_outcome(json, world, accelerations[world.acceleration], line.box_names);
    if (options.per_box) {
      Json& boxes = json["per_box"] = Json::array();
      for (std::size_t i = 0; i < world.box_outcomes.size(); ++i) {
        Json& box = boxes.emplace_back(Json::object());
        if (i < line.box_names.size() && !line.box_names[i].empty()) box["name"] = line.box_names[i];
        append_box(box, world.box_outcomes[i]);
      }
    }
    if (options.series) json["series"] = json_of(world.series);
  }
  return fmt::format("{{\"id\":{},\"layout\":{},\"line\":{},\"verdicts\":{}}}\n", line.id, line.layout, line.line,
                     one_line(verdicts));
}

std::string error_text(const AnsweredLine& line, const Error& error, std::size_t more) {
  const Json json = {{"layout", line.layout},
                     {"line", line.line},
                     {"column", number_or_null(error.column)},
                     {"box", error.box > 0 ? Json(error.box - 1) : Json(nullptr)},
                     {"number", error.box_number > 0 ? Json(error.box_number - 1) : Json(nullptr)},
                     {"error", error.what},
                     {"value", text_or_null(error.value)},
                     {"accepted", text_or_null(error.accepted)},
                     {"more", more}};
  return fmt::format("{{\"id\":{},{}\n", line.id, one_line(json).substr(1));
}

void AnswerQueue::give(std::uint64_t ticket, std::string text) {
  if (!ordered_ || ticket == written_)
    write(text);
  else
    kept_.emplace(ticket, std::move(text));
  for (auto next = kept_.begin(); next != kept_.end() && next->first == written_; next = kept_.erase(next))
    write(next->second);
}

void AnswerQueue::write(const std::string& text) {
  write_unless(drop_, stdout, text);
  ++written_;
}

}  // namespace holdfast::internal
