#include "app/world_json.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace holdfast::internal {

namespace {

/// Numbers that are not finite become null by themselves.
nlohmann::ordered_json count(std::uint32_t boxes) {
  if (boxes == kNotCounted) return nullptr;
  return boxes;
}

}  // namespace

std::string world_json(const WorldRecord& world, const std::string& layout, const std::string& acceleration,
                       std::size_t index, const Thresholds& thresholds, double time_saved) {
  const Outcome& outcome = world.outcome;
  const WorldVerdict verdict =
      judge_world(outcome.status, outcome.stop_reason, world.peak_total_kinetic_energy, world.end, thresholds);
  nlohmann::ordered_json json;
  json["world"] = index;
  json["layout"] = layout;
  json["acceleration"] = acceleration;
  json["verdict"] = to_string(verdict.verdict);
  json["status"] = to_string(outcome.status);
  json["status_text"] = world.status_text;
  json["stop_reason"] = to_string(outcome.stop_reason);
  json["boxes"] = world.end.displacement.size();
  json["fallen_boxes"] = count(verdict.fallen_boxes);
  json["moved_boxes"] = count(verdict.moved_boxes);
  json["tilted_boxes"] = count(verdict.tilted_boxes);
  json["unstable_boxes"] = count(verdict.unstable_boxes);
  json["max_displacement_m"] = verdict.max_displacement;
  json["peak_displacement_m"] = verdict.peak_displacement;
  json["total_kinetic_energy_J"] = verdict.total_kinetic_energy;
  json["peak_kinetic_energy_J"] = verdict.peak_kinetic_energy;
  json["end_time_s"] = outcome.end_time;
  json["time_saved_s"] = time_saved;
  json["steps"] = outcome.counters.steps;
  json["steps_skipped"] = outcome.counters.steps_skipped;
  json["max_residual"] = outcome.counters.max_residual;
  json["residual_scale"] = outcome.counters.residual_scale;
  json["max_penetration_m"] = outcome.counters.max_penetration;
  json["cpu_seconds"] = world.cpu_seconds;
  json["state_hash"] = fmt::format("{:016x}", world.state_hash);
  // Names of files need not be UTF-8; what is not becomes a replacement character, not an exception.
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace holdfast::internal
