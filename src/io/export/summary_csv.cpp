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
    "residual_scale,max_penetration_m,cpu_seconds";
constexpr const char* kBoxHeader =
    "world,layout,acceleration,id,material,mass_kg,displacement_x_m,displacement_y_m,displacement_z_m,"
    "max_displacement_m,drop_m,tilt_degree,kinetic_energy_J,peak_kinetic_energy_J,fallen,moved,tilted,unstable,"
    "first_move_time_s";

/// Columns of what a run was asked for, at the end of both tables.
std::string world_extras(const ResultsInfo& info) {
  return std::string(info.has_damage ? ",boxes_beyond" : "") +
         (info.has_indicators
              ? ",fill,centre_x_m,centre_y_m,centre_z_m,centre_offset_x,centre_offset_y,centre_offset_z,"
                "badly_based,badly_braced"
              : "");
}
std::string box_extras(const ResultsInfo& info) {
  return std::string(info.has_damage ? ",peak_acceleration_m_s2,velocity_change_m_s,beyond" : "") +
         (info.has_indicators ? ",base_support,supported_sides" : "");
}

/// Index of the world and names of its inputs: the first columns of both tables.
std::string naming(const ResultsInfo& info, std::uint64_t world, const WorldRow& row) {
  return fmt::format("{},{},{}", world, csv_field(layout_name(info, row)), csv_field(acceleration_name(info, row)));
}

/// Beside the summary of some worlds, what their run was asked for; empty where it was not.
struct ExtraColumns {
  std::vector<std::uint32_t> boxes_beyond;   ///< per world
  BoxDamage damage;                          ///< per box
  std::vector<LayoutIndicators> indicators;  ///< per world, of its layout; unknown where another part has the layout
};

void read_indicators(ResultsReader& results, const SummarySlice& slice, ExtraColumns& extras) {
  const ResultsInfo& info = results.info();
  const auto value_of = [](auto&& read) {
    if (!read) throw h5::Failure(read.error());
    return std::move(*read);
  };
  for (const WorldRow& row : slice.rows) {
    const std::uint64_t layout = row.layout - info.layout_begin;
    if (row.layout < info.layout_begin || layout >= info.layouts.size()) {
      extras.indicators.emplace_back();
      continue;
    }
    LayoutIndicators found = value_of(results.indicators(layout, 1)).front();
    LayoutIndicators boxes = value_of(results.box_indicators(layout));
    found.base_support = std::move(boxes.base_support);
    found.supported_sides = std::move(boxes.supported_sides);
    extras.indicators.push_back(std::move(found));
  }
}

std::string indicator_fields(const LayoutIndicators& found) {
  const auto numbers = [](const Vec3& v) {
    return fmt::format("{},{},{}", csv_number(v.x()), csv_number(v.y()), csv_number(v.z()));
  };
  return fmt::format(",{},{},{},{},{}", csv_number(found.fill), numbers(found.centre_of_gravity),
                     numbers(found.centre_offset), csv_number(found.badly_based), csv_number(found.badly_braced));
}

std::string box_indicator_fields(const LayoutIndicators& found, std::size_t box) {
  if (box >= found.base_support.size()) return ",,";
  return fmt::format(",{},{}", found.base_support[box], found.supported_sides[box]);
}

ExtraColumns read_extras(ResultsReader& results, const SummarySlice& slice) {
  ExtraColumns extras;
  if (results.info().has_indicators) read_indicators(results, slice, extras);
  if (!results.info().has_damage) return extras;
  Result<std::vector<std::uint32_t>> boxes_beyond = results.boxes_beyond(slice.world_begin, slice.rows.size());
  if (!boxes_beyond) throw h5::Failure(boxes_beyond.error());
  Result<BoxDamage> damage = results.box_damage(slice.box_begin, slice.boxes.drop.size());
  if (!damage) throw h5::Failure(damage.error());
  extras.boxes_beyond = std::move(*boxes_beyond);
  extras.damage = std::move(*damage);
  return extras;
}

std::string world_lines(const ResultsInfo& info, const SummarySlice& slice, const ExtraColumns& extras) {
  std::string text;
  const WorldSummary& w = slice.worlds;
  for (std::size_t i = 0; i < slice.rows.size(); ++i) {
    const WorldRow& row = slice.rows[i];
    text += fmt::format(
        "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}", naming(info, slice.world_begin + i, row),
        to_string(w.verdict[i]), to_string(row.status), csv_field(row.status_text), to_string(row.stop_reason),
        row.end_time, row.box_count, count(w.fallen_boxes[i]), count(w.unstable_boxes[i]), count(w.moved_boxes[i]),
        count(w.tilted_boxes[i]), csv_number(w.total_kinetic_energy[i]), csv_number(w.peak_kinetic_energy[i]),
        csv_number(w.max_displacement[i]), csv_number(w.peak_displacement[i]), row.max_residual, row.residual_scale,
        row.max_penetration, row.cpu_seconds);
    if (info.has_damage) text += ',' + count(extras.boxes_beyond[i]);
    if (info.has_indicators) text += indicator_fields(extras.indicators[i]);
    text += "\r\n";
  }
  return text;
}

std::string box_lines(const ResultsInfo& info, const SummarySlice& slice, const BoxTable& boxes,
                      const ExtraColumns& extras) {
  std::string text;
  const BoxSummary& b = slice.boxes;
  for (std::size_t world = 0; world < slice.rows.size(); ++world) {
    const WorldRow& row = slice.rows[world];
    const std::string names = naming(info, slice.world_begin + world, row);
    const std::size_t begin = row.box_begin - slice.box_begin;
    for (std::size_t i = begin; i < begin + row.box_count; ++i) {
      text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}", names, boxes.id[i], boxes.material[i],
                          csv_number(boxes.mass[i]), vector(b.displacement[i]), csv_number(b.max_displacement[i]),
                          csv_number(b.drop[i]), csv_number(b.tilt[i]), csv_number(b.kinetic_energy[i]),
                          csv_number(b.peak_kinetic_energy[i]), b.fallen[i], b.moved[i], b.tilted[i], b.unstable[i],
                          csv_number(b.first_move_time[i]));
      if (info.has_damage)
        text += fmt::format(",{},{},{}", extras.damage.peak_acceleration[i], extras.damage.velocity_change[i],
                            extras.damage.beyond[i]);
      if (info.has_indicators) text += box_indicator_fields(extras.indicators[world], i - begin);
      text += "\r\n";
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
    worlds.write(kWorldHeader + world_extras(results->info()) + "\r\n");
    boxes.write(kBoxHeader + box_extras(results->info()) + "\r\n");
    const auto error = derive_summary(*results, thresholds, [&](const SummarySlice& slice) -> std::optional<Error> {
      const Result<BoxTable> table = results->boxes(slice.box_begin, slice.boxes.drop.size());
      if (!table) return table.error();
      return h5::caught(folder, [&] {
        const ExtraColumns extras = read_extras(*results, slice);
        worlds.write(world_lines(results->info(), slice, extras));
        boxes.write(box_lines(results->info(), slice, *table, extras));
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
