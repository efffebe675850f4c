#include <fmt/format.h>

#include <algorithm>

#include "io/export/csv_field.hpp"
#include "io/export/output_file.hpp"
#include "io/results/summary.hpp"

namespace holdfast::internal {

namespace {

constexpr const char* kHeader =
    "world,layout,acceleration,side,peak_force_N,peak_time_s,peak_x_m,peak_y_m,peak_z_m,lasting_force_N,limit_N,"
    "exceeded,impulse_x_Ns,impulse_y_Ns,impulse_z_Ns\r\n";

std::string vector(const Vec3& v) { return csv_number(v.x()) + ',' + csv_number(v.y()) + ',' + csv_number(v.z()); }

std::string line_of(const std::string& names, const WallForces& walls, std::size_t side) {
  return fmt::format("{},{},{},{},{},{},{},{},{}\r\n", names, kContainerSides.at(side).name,
                     csv_number(walls.peak_force.at(side)), csv_number(walls.peak_time.at(side)),
                     vector(walls.peak_point.at(side)), csv_number(walls.lasting_force.at(side)),
                     csv_number(walls.limit.at(side)), walls.exceeds(side) ? 1 : 0, vector(walls.impulse.at(side)));
}

}  // namespace

void write_wall_csv(ResultsReader& results, const std::string& path) {
  const ResultsInfo& info = results.info();
  OutputFile file(path);
  file.write(kHeader);
  for (std::uint64_t begin = 0; begin < info.world_count; begin += kSliceWorlds) {
    const std::uint64_t count = std::min(kSliceWorlds, info.world_count - begin);
    const Result<std::vector<WorldRow>> rows = results.worlds(begin, count);
    if (!rows) throw h5::Failure(rows.error());
    const Result<std::vector<WallForces>> walls = results.walls(begin, count);
    if (!walls) throw h5::Failure(walls.error());
    for (std::size_t i = 0; i < count; ++i) {
      if (!(*walls)[i].known()) continue;
      const WorldRow& row = (*rows)[i];
      const std::string names = fmt::format("{},{},{}", begin + i, csv_field(layout_name(info, row)),
                                            csv_field(acceleration_name(info, row)));
      for (std::size_t side = 0; side < kSideCount; ++side) file.write(line_of(names, (*walls)[i], side));
    }
  }
  file.close();
}

}  // namespace holdfast::internal
