#include "app/world_json.hpp"

#include <fmt/format.h>
#include <array>
#include <nlohmann/json.hpp>

#include "api/convert.hpp"
#include "core/model/container_sides.hpp"
#include "core/model/status.hpp"

namespace holdfast::internal {

namespace {

void append_walls(nlohmann::ordered_json& json, const std::vector<holdfast::WallForce>& walls) {
  for (std::size_t side = 0; side < walls.size(); ++side) {
    const holdfast::WallForce& wall = walls[side];
    nlohmann::ordered_json& of_side = json[std::string(kContainerSides.at(side).name)];
    of_side["peak_force_N"] = wall.peak_force;
    of_side["peak_time_s"] = wall.peak_time;
    of_side["peak_point_m"] = wall.peak_point;
    of_side["lasting_force_N"] = wall.lasting_force;
    of_side["limit_N"] = wall.limit;
    of_side["impulse_Ns"] = wall.impulse;
  }
}

void append_indicators(nlohmann::ordered_json& json, const LayoutIndicators& found) {
  const auto array = [](const Vec3& v) { return std::array{v.x(), v.y(), v.z()}; };
  json["fill"] = found.fill;
  json["centre_of_gravity_m"] = array(found.centre_of_gravity);
  json["centre_offset"] = array(found.centre_offset);
  json["badly_based"] = found.badly_based;
  json["badly_braced"] = found.badly_braced;
}

}  // namespace

void append_outcome(nlohmann::ordered_json& json, const holdfast::WorldOutcome& world,
                    const std::string& acceleration) {
  const bool was_run = world.stop_reason != holdfast::StopReason::not_run;
  // Numbers that are not finite become null by themselves.
  const auto known = [&](auto number) -> nlohmann::ordered_json {
    if (!was_run) return nullptr;
    return number;
  };
  json["acceleration"] = acceleration;
  json["verdict"] = to_string(static_cast<Verdict>(world.verdict));
  json["status"] = to_string(static_cast<Status>(world.status));
  json["status_text"] = world.message;
  json["stop_reason"] = to_string(static_cast<StopReason>(world.stop_reason));
  json["boxes"] = world.boxes;
  json["fallen_boxes"] = known(world.fallen);
  json["moved_boxes"] = known(world.moved);
  json["tilted_boxes"] = known(world.tilted);
  json["unstable_boxes"] = known(world.unstable);
  json["max_displacement_m"] = known(world.max_displacement);
  json["peak_displacement_m"] = known(world.peak_displacement);
  json["total_kinetic_energy_J"] = known(world.total_kinetic_energy);
  json["peak_kinetic_energy_J"] = known(world.peak_kinetic_energy);
  json["end_time_s"] = world.end_time;
  json["steps"] = world.steps;
  json["steps_skipped"] = world.steps_skipped;
  json["max_residual"] = world.max_residual;
  json["residual_scale"] = world.residual_scale;
  json["max_penetration_m"] = world.max_penetration;
  json["cpu_seconds"] = world.cpu_seconds;
  if (!world.walls.empty()) append_walls(json["walls"], world.walls);
  if (world.damage.known)
    json["damage"] = {{"boxes_beyond", world.damage.boxes_beyond},
                      {"peak_acceleration_m_s2", world.damage.peak_acceleration},
                      {"velocity_change_m_s", world.damage.velocity_change}};
  json["state_hash"] = fmt::format("{:016x}", world.state_hash);
  if (world.replicas.count == 0) return;
  json["replicas"] = {{"verdict", to_string(static_cast<ReplicaVerdict>(world.replicas.verdict))},
                      {"count", world.replicas.count},
                      {"failed", world.replicas.failed},
                      {"share", world.replicas.share},
                      {"wilson_95", {world.replicas.wilson_low, world.replicas.wilson_high}},
                      {"cpu_seconds", world.replicas.cpu_seconds}};
}

std::string one_line(const nlohmann::ordered_json& json) {
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::string world_json(const WorldRecord& world, const std::string& layout, const std::string& acceleration,
                       std::size_t index, const Thresholds& thresholds, double time_saved) {
  holdfast::WorldOutcome outcome;
  fill_world(world, thresholds, false, outcome);
  nlohmann::ordered_json json;
  json["world"] = index;
  json["layout"] = layout;
  append_outcome(json, outcome, acceleration);
  json["time_saved_s"] = time_saved;
  return one_line(json);
}

std::string layout_json(const LayoutRecord& layout, const std::vector<Analysis>& analyses) {
  nlohmann::ordered_json json;
  json["layout"] = layout.layout->name;
  if (includes(analyses, Analysis::indicators)) append_indicators(json["indicators"], layout.indicators);
  if (!includes(analyses, Analysis::margins)) return one_line(json);
  for (std::size_t i = 0; i < kDirectionCount; ++i) {
    const std::string direction(kMarginDirections.at(i).name);
    json["margins_g"][direction] = layout.margins.margin.at(i);
    json["critical_boxes"][direction] = layout.margins.critical_box.at(i);
  }
  const MarginSpread& spread = layout.margins.spread;
  if (includes(analyses, Analysis::margin_spread)) {
    for (std::size_t i = 0; i < kDirectionCount; ++i)
      json["margins_5_50_95_g"][std::string(kMarginDirections.at(i).name)] = {spread.low.at(i), spread.median.at(i),
                                                                              spread.high.at(i)};
  }
  json["cpu_seconds"] = layout.margins.cpu_seconds + spread.cpu_seconds;
  return one_line(json);
}

}  // namespace holdfast::internal
