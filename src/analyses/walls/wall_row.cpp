#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "analyses/analysis.hpp"
#include "analyses/walls/wall_forces.hpp"
#include "analyses/walls/wall_recorder.hpp"
#include "core/model/container_sides.hpp"
#include "io/export/csv_field.hpp"
#include "io/results/found_tables.hpp"

namespace holdfast::internal {

namespace {

void wall_json(nlohmann::ordered_json& json, const holdfast::WorldOutcome& world) {
  for (std::size_t side = 0; side < world.walls.size(); ++side) {
    const holdfast::WallForce& wall = world.walls[side];
    json["walls"][std::string(kPushedNames.at(side))] = {
        {"peak_force_N", wall.peak_force},       {"peak_time_s", wall.peak_time}, {"peak_point_m", wall.peak_point},
        {"lasting_force_N", wall.lasting_force}, {"limit_N", wall.limit},         {"impulse_Ns", wall.impulse}};
  }
}

constexpr const char* kWallHeader =
    "world,layout,acceleration,side,peak_force_N,peak_time_s,peak_x_m,peak_y_m,peak_z_m,lasting_force_N,limit_N,"
    "exceeded,impulse_x_Ns,impulse_y_Ns,impulse_z_Ns\r\n";

std::string wall_line(const std::string& names, const WallForces& walls, std::size_t side) {
  return fmt::format("{},{},{},{},{},{},{},{},{}\r\n", names, kPushedNames.at(side),
                     csv_number(walls.peak_force.at(side)), csv_number(walls.peak_time.at(side)),
                     csv_vector(walls.peak_point.at(side)), csv_number(walls.lasting_force.at(side)),
                     csv_number(walls.limit.at(side)), walls.exceeds(side) ? 1 : 0, csv_vector(walls.impulse.at(side)));
}

template <std::size_t side>
double force_on(const Findings& found) {
  return found.value<WallForces>().lasting_force.at(side);
}

double largest_share(const Findings& found) {
  const auto& walls = found.value<WallForces>();
  double largest = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t side = 0; side < kPushedCount; ++side) largest = std::fmax(largest, walls.share_of_limit(side));
  return largest;
}

constexpr WorldNumber kWallNumbers[] = {
    {"wall_floor", "f8",
     "Largest force on the floor for 0.05 s, N; NaN without ``WallForces`` or ``Walls``, and in a world that was not "
     "accelerated, as the next six.",
     force_on<0>},
    {"wall_front", "f8", "The same on the front wall.", force_on<1>},
    {"wall_rear", "f8", "The same on the door.", force_on<2>},
    {"wall_left", "f8", "The same on the left wall.", force_on<3>},
    {"wall_right", "f8", "The same on the right wall.", force_on<4>},
    {"wall_roof", "f8", "The same on the roof.", force_on<5>},
    {"wall_share", "f8",
     "The largest of these over the test force of the norm ``Walls``: above 1, a wall is pressed beyond it.",
     largest_share}};

/// One line per world that was accelerated and side.
std::optional<Error> write_wall_csv(ResultsReader& results, const std::function<void(std::string_view)>& write) {
  const ResultsInfo& info = results.info();
  write(kWallHeader);
  for (std::uint64_t begin = 0; begin < info.world_count; begin += kSliceWorlds) {
    const Result<std::vector<WorldRow>> rows = results.worlds(begin, std::min(kSliceWorlds, info.world_count - begin));
    if (!rows) return rows.error();
    const Result<std::vector<WallForces>> walls = read_worlds<WallForces>(results, begin, *rows);
    if (!walls) return walls.error();
    for (std::size_t i = 0; i < rows->size(); ++i) {
      if (!(*walls)[i].known()) continue;
      const WorldRow& row = (*rows)[i];
      const std::string names = fmt::format("{},{},{}", begin + i, csv_field(info.layout_name(row.layout)),
                                            csv_field(info.acceleration_name(row.acceleration)));
      for (std::size_t side = 0; side < kPushedCount; ++side) write(wall_line(names, (*walls)[i], side));
    }
  }
  return std::nullopt;
}

}  // namespace

const Analysis kWalls = {.key = "WallForces",
                         .option = "Also record the forces on the sides of the container",
                         .enabled = [](const Settings& settings) { return settings.screening.measures_walls(); },
                         .method = {.recorder = [](const Settings& settings, const BoxView& boxes,
                                                   const StateView& /*settled*/) -> std::unique_ptr<AnalysisRecorder> {
                           return std::make_unique<WallRecorder>(settings.screening.walls, boxes);
                         }},
                         .tables = tables_of_worlds<WallForces>({.name = "walls",
                                                                 .asked_by = "`WallForces` or `Walls`",
                                                                 .page = "walls.md",
                                                                 .file_order = 1,
                                                                 .csv = write_wall_csv}),
                         .table = wall_table,
                         .world_json = wall_json,
                         .numbers = kWallNumbers};

}  // namespace holdfast::internal
