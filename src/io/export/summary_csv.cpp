#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "io/export/csv_field.hpp"
#include "io/export/output_file.hpp"
#include "io/results/load_names.hpp"
#include "io/results/summary.hpp"

namespace holdfast::internal {

namespace {

/// Fields that CSV has: all that are shown, but hashes, which readers take for numbers.
bool in_csv(const OutcomeField& field) { return !field.label.empty() && field.type != "hash"; }

/// The field that the name of its box stands behind.
constexpr std::string_view kNamedBox = "critical_box";

std::string world_header() {
  std::string header = "world,layout,acceleration,container";
  visit_outcome<holdfast::WorldOutcome>([&](const OutcomeField& field, auto) {
    if (in_csv(field)) header += ',' + csv_heading(field);
    if (field.label == kNamedBox) header += ",critical_box_name";
  });
  return header;
}

std::string box_header() {
  std::string header = "world,layout,acceleration,id,name,material,mass_kg";
  const auto append = [&](const OutcomeField& field, auto) {
    if (in_csv(field)) header += ',' + csv_heading(field);
  };
  visit_box_verdict<BoxVerdict>(append);
  visit_ends<EndTable>(append);
  return header;
}

/// Index of the world and names of its inputs: the first columns of both tables.
std::string naming(const ResultsInfo& info, std::uint64_t world, const WorldRow& row) {
  return fmt::format("{},{},{}", world, csv_field(info.layout_name(row.layout)),
                     csv_field(info.acceleration_name(row.acceleration)));
}

/// What the analyses of a file add to the lines of a slice.
std::vector<CsvFields> analysis_fields(ResultsReader& results, const SummarySlice& slice) {
  std::vector<CsvFields> all;
  for (const AnalysisTables* analysis : results.info().analyses) {
    if (analysis->csv_fields == nullptr) continue;
    Result<CsvFields> fields = analysis->csv_fields(results, slice);
    if (!fields) throw h5::Failure(fields.error());
    all.push_back(std::move(*fields));
  }
  return all;
}

std::string world_lines(const ResultsInfo& info, const SummarySlice& slice, LoadNames& names,
                        const std::vector<CsvFields>& added) {
  std::string text;
  for (std::size_t i = 0; i < slice.rows.size(); ++i) {
    const std::uint64_t layout = slice.rows[i].layout;
    text += naming(info, slice.world_begin + i, slice.rows[i]) + ',' + csv_field(names.container(layout));
    visit_world_values(slice.rows[i], slice.worlds[i], [&](const OutcomeField& field, const auto& value, auto) {
      if (in_csv(field)) text += ',' + csv_value(value);
      if (field.label == kNamedBox) text += ',' + csv_field(names.box_name(layout, slice.worlds[i].critical_box));
    });
    for (const CsvFields& fields : added) text += fields.worlds[i];
    text += "\r\n";
  }
  return text;
}

/// Names stand where the file has them: of materials in the place of their numbers.
std::string box_lines(const ResultsInfo& info, const SummarySlice& slice, const BoxTable& boxes, LoadNames& names,
                      const std::vector<CsvFields>& added) {
  std::string text;
  for (std::size_t world = 0; world < slice.rows.size(); ++world) {
    const WorldRow& row = slice.rows[world];
    const std::string inputs = naming(info, slice.world_begin + world, row);
    const std::size_t begin = row.box_begin - slice.box_begin;
    for (std::size_t i = begin; i < begin + row.boxes; ++i) {
      const std::uint64_t box = i - begin + 1;
      const std::string material = names.material_name(row.layout, box);
      text += fmt::format("{},{},{},{},{}", inputs, boxes.id[i], csv_field(names.box_name(row.layout, box)),
                          material.empty() ? std::to_string(boxes.material[i]) : csv_field(material),
                          csv_number(boxes.mass[i]));
      visit_box_verdict<BoxVerdict>([&](const OutcomeField& field, auto member) {
        if (in_csv(field)) text += ',' + csv_value(slice.boxes[i].*member);
      });
      visit_ends<EndTable>([&](const OutcomeField& field, auto member) {
        if (in_csv(field)) text += ',' + csv_value((slice.ends.*member)[i]);
      });
      for (const CsvFields& fields : added) text += fields.boxes[i];
      text += "\r\n";
    }
  }
  return text;
}

/// The input may be in the folder under the name of a table, by a link.
void refuse_input(const std::string& results_path, const std::string& folder) {
  std::vector<std::string> names = {"worlds", "boxes"};
  for (const AnalysisTables* analysis : all_tables()) names.emplace_back(analysis->name);
  std::error_code absent;
  for (const std::string& name : names)
    if (const std::string path = fmt::format("{}/{}.csv", folder, name);
        std::filesystem::equivalent(results_path, path, absent))
      h5::fail(path, "is the results file itself", "another folder");
}

}  // namespace

std::optional<Error> write_summary_csv(const std::string& results_path, const Thresholds& thresholds,
                                       const std::string& folder) {
  return h5::caught(folder, [&] {
    Result<ResultsReader> results = ResultsReader::open(results_path);
    if (!results) throw h5::Failure(results.error());
    make_output_folder(folder);
    refuse_input(results_path, folder);
    OutputFile worlds(folder + "/worlds.csv");
    OutputFile boxes(folder + "/boxes.csv");
    std::string world_headings = world_header();
    std::string box_headings = box_header();
    for (const AnalysisTables* analysis : results->info().analyses) {
      world_headings += analysis->world_headings;
      box_headings += analysis->box_headings;
    }
    worlds.write(world_headings + "\r\n");
    boxes.write(box_headings + "\r\n");
    LoadNames names(*results);
    const auto error = derive_summary(*results, thresholds, [&](const SummarySlice& slice) -> std::optional<Error> {
      const Result<BoxTable> table = results->boxes(slice.box_begin, slice.boxes.size());
      if (!table) return table.error();
      return h5::caught(folder, [&] {
        const std::vector<CsvFields> added = analysis_fields(*results, slice);
        worlds.write(world_lines(results->info(), slice, names, added));
        boxes.write(box_lines(results->info(), slice, *table, names, added));
      });
    });
    if (error) throw h5::Failure(*error);
    worlds.close();
    boxes.close();
    for (const AnalysisTables* analysis : results->info().analyses) {
      if (analysis->csv == nullptr) continue;
      OutputFile file(fmt::format("{}/{}.csv", folder, analysis->name));
      if (const auto failure = analysis->csv(*results, [&](std::string_view text) { file.write(text); }))
        throw h5::Failure(*failure);
      file.close();
    }
  });
}

}  // namespace holdfast::internal
