#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "analyses/analysis.hpp"
#include "analyses/damage/damage.hpp"
#include "analyses/damage/damage_recorder.hpp"
#include "io/export/csv_field.hpp"
#include "io/results/found_tables.hpp"
#include "io/results/summary.hpp"

namespace holdfast::internal {

namespace {

std::optional<Error> why_no_damage(const Engine& engine, const Settings& settings) {
  if (settings.container.motion == ContainerMotion::prescribed) return std::nullopt;
  return Error{.what = "damage is not recorded by this engine, or not with this motion of the container",
               .value = engine.traits().name,
               .accepted = "leave damage out, or take native, bullet or bullet-f64 with Motion = prescribed"};
}

void damage_json(nlohmann::ordered_json& json, const holdfast::WorldOutcome& world) {
  if (!world.damage.known) return;
  json["damage"] = {{"boxes_beyond", world.damage.boxes_beyond},
                    {"peak_acceleration_m_s2", world.damage.peak_acceleration},
                    {"velocity_change_m_s", world.damage.velocity_change}};
}

/// The largest_of_boxes of all boxes; NaN where nothing was found.
template <std::vector<float> WorldDamage::*column>
double largest_of_boxes(const Findings& found) {
  const WorldDamage* damage = found.get<WorldDamage>();
  if (damage == nullptr) return std::numeric_limits<double>::quiet_NaN();
  const std::vector<float>& values = damage->*column;
  return values.empty() ? 0.0 : static_cast<double>(*std::max_element(values.begin(), values.end()));
}

constexpr WorldNumber kDamageNumbers[] = {
    {"boxes_beyond", "f4", "Number of boxes beyond the damage boundary; NaN where it is not known.",
     [](const Findings& found) {
       const WorldDamage* damage = found.get<WorldDamage>();
       const bool known = damage != nullptr && damage->known();
       return known ? static_cast<double>(damage->boxes_beyond) : std::numeric_limits<double>::quiet_NaN();
     }},
    {"peak_acceleration", "f4", "Largest of all boxes, mean over ``DamageWindow``, m/s²; NaN where it is not known.",
     largest_of_boxes<&WorldDamage::peak_acceleration>},
    {"velocity_change", "f4", "Largest of all boxes in an impact, m/s; NaN where it is not known.",
     largest_of_boxes<&WorldDamage::velocity_change>}};

Result<CsvFields> damage_fields(ResultsReader& results, const SummarySlice& slice) {
  const Result<std::vector<WorldDamage>> damage =
      read_worlds<WorldDamage>(results, slice.world_begin, slice.rows, Depth::boxes);
  if (!damage) return damage.errors();
  CsvFields fields;
  for (const WorldDamage& world : *damage) {
    fields.worlds.push_back(',' + csv_count(world.boxes_beyond));
    for (std::size_t box = 0; box < world.beyond.size(); ++box)
      fields.boxes.push_back(fmt::format(",{},{},{}", csv_number(world.peak_acceleration[box]),
                                         csv_number(world.velocity_change[box]),
                                         world.known() ? fmt::format("{}", world.beyond[box]) : ""));
  }
  return fields;
}

}  // namespace

const Analysis kDamage = {
    .key = "Damage",
    .option = "Also record accelerations and impacts of boxes, and count those beyond a damage boundary",
    .enabled = [](const Settings& settings) { return settings.screening.damage; },
    .why_not = why_no_damage,
    .method = {.recorder = [](const Settings& settings, const BoxView& /*boxes*/,
                              const StateView& settled) -> std::unique_ptr<AnalysisRecorder> {
      return std::make_unique<DamageRecorder>(damage_boundary(settings.screening), settings.screening.damage_window,
                                              settings.gravity, settled);
    }},
    .tables = tables_of_worlds<WorldDamage>({.name = "damage",
                                             .asked_by = "`Damage`",
                                             .page = "damage.md",
                                             .file_order = 2,
                                             .world_headings = ",boxes_beyond",
                                             .box_headings = ",peak_acceleration_m_s2,velocity_change_m_s,beyond",
                                             .csv_fields = damage_fields}),
    .table = damage_table,
    .world_json = damage_json,
    .numbers = kDamageNumbers};

}  // namespace holdfast::internal
