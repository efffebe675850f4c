#include <fmt/format.h>

#include <fstream>

#include "io/export/csv_field.hpp"
#include "io/export/output_file.hpp"
#include "io/results/summary.hpp"

namespace holdfast::internal {

namespace {

std::string count(std::uint32_t boxes) { return boxes == kNotCounted ? "" : fmt::format("{}", boxes); }

std::string vector(const Float3& v) { return csv_number(v.x) + ',' + csv_number(v.y) + ',' + csv_number(v.z); }

constexpr const char* kWorldHeader =
    "world,layout,acceleration,verdict,status,status_text,stop_reason,end_time_s,boxes,fallen_boxes,unstable_boxes,"
    "moved_boxes,"
    "tilted_boxes,total_kinetic_energy_J,peak_kinetic_energy_J,max_displacement_m,peak_displacement_m,max_residual,"
    "residual_scale,max_penetration_m,cpu_seconds\r\n";
constexpr const char* kBoxHeader =
    "world,layout,acceleration,id,material,mass_kg,displacement_x_m,displacement_y_m,displacement_z_m,"
    "max_displacement_m,drop_m,tilt_degree,kinetic_energy_J,peak_kinetic_energy_J,fallen,moved,tilted,unstable,"
    "first_move_time_s\r\n";

/// Index of the world and names of its inputs: the first columns of both tables.
std::string naming(const ResultsInfo& info, std::uint64_t world, const WorldRow& row) {
  return fmt::format("{},{},{}", world, csv_field(layout_name(info, row)), csv_field(acceleration_name(info, row)));
}

std::string world_lines(const ResultsInfo& info, const SummarySlice& slice) {
  std::string text;
  const WorldSummary& w = slice.worlds;
  for (std::size_t i = 0; i < slice.rows.size(); ++i) {
    const WorldRow& row = slice.rows[i];
    text += fmt::format(
        "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\r\n", naming(info, slice.world_begin + i, row),
        to_string(w.verdict[i]), to_string(row.status), csv_field(row.status_text), to_string(row.stop_reason),
        row.end_time, row.box_count, count(w.fallen_boxes[i]), count(w.unstable_boxes[i]), count(w.moved_boxes[i]),
        count(w.tilted_boxes[i]), csv_number(w.total_kinetic_energy[i]), csv_number(w.peak_kinetic_energy[i]),
        csv_number(w.max_displacement[i]), csv_number(w.peak_displacement[i]), row.max_residual, row.residual_scale,
        row.max_penetration, row.cpu_seconds);
  }
  return text;
}

std::string box_lines(const ResultsInfo& info, const SummarySlice& slice, const BoxTable& boxes) {
  std::string text;
  const BoxSummary& b = slice.boxes;
  for (std::size_t world = 0; world < slice.rows.size(); ++world) {
    const WorldRow& row = slice.rows[world];
    const std::string names = naming(info, slice.world_begin + world, row);
    const std::size_t begin = row.box_begin - slice.box_begin;
    for (std::size_t i = begin; i < begin + row.box_count; ++i) {
      text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\r\n", names, boxes.id[i], boxes.material[i],
                          csv_number(boxes.mass[i]), vector(b.displacement[i]), csv_number(b.max_displacement[i]),
                          csv_number(b.drop[i]), csv_number(b.tilt[i]), csv_number(b.kinetic_energy[i]),
                          csv_number(b.peak_kinetic_energy[i]), b.fallen[i], b.moved[i], b.tilted[i], b.unstable[i],
                          csv_number(b.first_move_time[i]));
    }
  }
  return text;
}

}  // namespace

std::optional<Error> write_summary_csv(const std::string& results_path, const Thresholds& thresholds,
                                       const std::string& folder) {
  return h5::caught(folder, [&] {
    Result<ResultsReader> results = ResultsReader::open(results_path);
    if (!results) throw h5::Failure(results.error());
    make_output_folder(folder);
    OutputFile worlds(folder + "/worlds.csv");
    OutputFile boxes(folder + "/boxes.csv");
    worlds.write(kWorldHeader);
    boxes.write(kBoxHeader);
    const auto error = derive_summary(*results, thresholds, [&](const SummarySlice& slice) -> std::optional<Error> {
      const Result<BoxTable> table = results->boxes(slice.box_begin, slice.boxes.drop.size());
      if (!table) return table.error();
      return h5::caught(folder, [&] {
        worlds.write(world_lines(results->info(), slice));
        boxes.write(box_lines(results->info(), slice, *table));
      });
    });
    if (error) throw h5::Failure(*error);
    worlds.close();
    boxes.close();
    if (results->info().has_margins) write_margin_csv(*results, folder + "/margins.csv");
    if (results->info().has_walls) write_wall_csv(*results, folder + "/walls.csv");
    if (results->info().has_replicas) write_replica_csv(*results, folder + "/replicas.csv");
  });
}

}  // namespace holdfast::internal
