#include "app/world_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <type_traits>

#include "api/convert.hpp"
#include "core/model/outcome.hpp"

namespace holdfast::internal {

namespace {

using Json = nlohmann::ordered_json;

/// A value of an outcome: names of codes, and 16 hexadecimal digits of a hash.
template <class Value>
Json json_value(const OutcomeField& field, const Value& value) {
  if constexpr (std::is_enum_v<Value>)
    return to_string(value);
  else if constexpr (std::is_integral_v<Value>)
    if (field.type == "status")
      return to_string(static_cast<Status>(value));
    else if (field.type == "caveat")
      return to_string(static_cast<Caveat>(value));
    else
      return field.type == "hash" ? Json(fmt::format("{:016x}", value)) : Json(value);
  else
    return value;
}

}  // namespace

void append_outcome(nlohmann::ordered_json& json, const holdfast::WorldOutcome& world, const std::string& acceleration,
                    std::span<const std::string> box_names) {
  const bool was_run = world.stop_reason != holdfast::StopReason::not_run;
  json["acceleration"] = acceleration;
  visit_outcome<holdfast::WorldOutcome>([&](const OutcomeField& field, auto member) {
    if (field.label.empty()) return;
    // What is not known is null; numbers that are not finite become it by themselves.
    const bool known = was_run || field.scope != FieldScope::derived || field.type == "verdict";
    json[std::string(field.label)] = known ? json_value(field, world.*member) : Json();
    if (field.name != "critical_box") return;
    const std::size_t box = world.critical_box;
    if (box > 0 && box <= box_names.size() && !box_names[box - 1].empty())
      json["critical_box_name"] = box_names[box - 1];
  });
  std::size_t next = 0;  // of the numbers of all analyses
  for (const Analysis* analysis : all_analyses()) {
    const std::size_t count = std::min(analysis->numbers.size(), world.numbers.size() - next);
    const std::span<const double> numbers = std::span(world.numbers).subspan(next, count);
    next += count;
    if (analysis->world_json != nullptr) {
      analysis->world_json(json, world);
      continue;
    }
    // What was not asked for has no numbers.
    if (std::all_of(numbers.begin(), numbers.end(), [](double number) { return std::isnan(number); })) continue;
    Json& of_analysis = json[std::string(analysis->tables.name)];
    for (std::size_t i = 0; i < numbers.size(); ++i) of_analysis[std::string(analysis->numbers[i].label)] = numbers[i];
  }
}

void append_box(nlohmann::ordered_json& json, const holdfast::BoxOutcome& box) {
  visit_box_outcome<holdfast::BoxOutcome>(
      [&](const OutcomeField& field, auto member) { json[std::string(field.label)] = json_value(field, box.*member); });
}

std::string one_line(const nlohmann::ordered_json& json) {
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::string world_json(const WorldRecord& world, const std::string& layout, const std::string& acceleration,
                       std::size_t index, const Thresholds& thresholds, double time_saved,
                       std::span<const std::string> box_names) {
  holdfast::WorldOutcome outcome;
  fill_world(world, thresholds, false, outcome);
  outcome.numbers = numbers_of(world.found);
  nlohmann::ordered_json json;
  json["world"] = index;
  json["layout"] = layout;
  append_outcome(json, outcome, acceleration, box_names);
  json["time_saved_s"] = time_saved;
  return one_line(json);
}

std::string layout_json(const LayoutRecord& layout, std::span<const Analysis* const> analyses) {
  Json json;
  json["layout"] = layout.layout->name;
  for (const Analysis* analysis : analyses)
    if (analysis->layout_json != nullptr) analysis->layout_json(json, layout);
  return one_line(json);
}

}  // namespace holdfast::internal
