#include "io/export/text_export.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <vector>

#include "io/export/output_file.hpp"
#include "io/input/text_lines.hpp"
#include "io/results/summary.hpp"

namespace holdfast::internal {

namespace {

/// File names without extension, made distinct with `~2`, `~3`, …; without `$`, which separates names in the result.
std::vector<std::string> distinct_stems(const std::vector<std::string>& names) {
  std::set<std::string> taken;
  std::vector<std::string> stems;
  for (const std::string& name : names) {
    // Of a load in a file with several: the file without its ending, and the name of the load.
    const std::string text = valid_utf8(name);
    const std::size_t load = std::min(text.find('#'), text.size());
    std::string stem = std::filesystem::path(text.substr(0, load)).stem().string() + text.substr(load);
    for (const char sign : {'$', '/'}) std::replace(stem.begin(), stem.end(), sign, '_');
    std::string distinct = stem;
    for (int i = 2; !taken.insert(distinct).second; ++i) distinct = fmt::format("{}~{}", stem, i);
    stems.push_back(distinct);
  }
  return stems;
}

std::string base_name(const std::string& folder) {
  std::filesystem::path path = std::filesystem::path(folder).lexically_normal();
  if (!path.has_filename()) path = path.parent_path();
  const std::string name = path.filename().string();
  return name.empty() || name == "." || name == ".." ? "batch" : name;
}

std::string batch_file(const std::string& batch_directory) { return "[BATCH-RESUMED]$" + base_name(batch_directory); }
std::string solution_file(const std::string& pair) { return "[SOLUTION]" + pair; }
std::string resumed_file(const std::string& pair) { return "[SOLUTION_RESUMED]" + pair; }

/// The common part of the names of a world's files.
std::string pair_of(const std::string& layout, const std::string& acceleration) {
  return "$" + layout + "$" + acceleration;
}

/// "nan" instead of zero for a world that was not simulated, so that it is not mistaken for one in which all boxes
/// stayed.
std::string outcome(const WorldRow& row, double value) {
  return row.stop_reason == StopReason::not_run ? "nan" : fmt::format("{}", value);
}

/// The first lines of both files of a world.
std::string heading(const ResultsInfo& info, const WorldRow& row) {
  std::string text =
      fmt::format("# layout {}, acceleration {}, engine {}, status {}", printable(info.layout_name(row.layout)),
                  printable(info.acceleration_name(row.acceleration)), row.engine, to_string(row.status));
  if (!row.message.empty()) text += " (" + row.message + ")";
  return text + '\n';
}

std::string solution_lines(const Series& series, const BoxTable& boxes) {
  std::string text;
  const std::size_t box_count = boxes.id.size();
  for (std::size_t i = 0; i < series.displacement.size(); ++i) {
    const Float3& d = series.displacement[i];
    const Float3& f = series.force[i];
    const Float3& w = series.angular_velocity[i];
    const Float3& a = series.linear_acceleration[i];
    text += fmt::format("{} {} {} {} {} {} {} {} {} {} {} {} {} {}\n", boxes.id[i % box_count], d.x, d.y, d.z, f.x, f.y,
                        f.z, w.x, w.y, w.z, a.x, a.y, a.z, series.time[i / box_count]);
  }
  return text;
}

void write_solution(ResultsReader& results, const WorldRow& row, const std::string& path) {
  const Result<BoxTable> boxes = results.boxes(row.box_begin, row.boxes);
  if (!boxes) throw h5::Failure(boxes.error());
  const Result<Series> series = results.series(row);
  if (!series) throw h5::Failure(series.error());
  OutputFile file(path);
  file.write(heading(results.info(), row));
  file.write(
      "# id  displacement of the centre of mass x y z [m]  total external force x y z [N]  angular velocity x y z "
      "[rad/s]  linear acceleration x y z [m/s2]  elapsed time [s]\n");
  if (row.sample_count == 0) file.write("# no samples\n");
  file.write(solution_lines(*series, *boxes));
  file.close();
}

/// @param world of the slice
void write_resumed(ResultsReader& results, const SummarySlice& slice, std::size_t world, const std::string& path) {
  const WorldRow& row = slice.rows[world];
  const Result<BoxTable> boxes = results.boxes(row.box_begin, row.boxes);
  if (!boxes) throw h5::Failure(boxes.error());
  OutputFile file(path);
  file.write(heading(results.info(), row));
  file.write("# number of fallen boxes\n" + outcome(row, slice.worlds[world].fallen_at_end) + '\n');
  file.write("# id  displacement of the centre of mass x y z [m]  kinetic energy [J]\n");
  std::string lines;
  for (std::size_t box = 0; box < row.boxes; ++box) {
    const std::size_t i = row.box_begin - slice.box_begin + box;
    const Float3& d = slice.ends.end_displacement[i];
    lines += fmt::format("{} {} {} {} {}\n", boxes->id[box], d.x, d.y, d.z, slice.ends.end_kinetic_energy[i]);
  }
  file.write(lines);
  file.write("# total kinetic energy [J]\n" + outcome(row, slice.worlds[world].end_kinetic_energy) + '\n');
  file.close();
}

void export_slice(ResultsReader& results, const SummarySlice& slice, const std::string& folder,
                  const std::vector<std::string>& layouts, const std::vector<std::string>& accelerations,
                  OutputFile& batch) {
  for (std::size_t world = 0; world < slice.rows.size(); ++world) {
    const WorldRow& row = slice.rows[world];
    const std::string pair = pair_of(layouts.at(row.layout), accelerations.at(row.acceleration));
    write_solution(results, row, folder + "/" + solution_file(pair));
    write_resumed(results, slice, world, folder + "/" + resumed_file(pair));
    batch.write(fmt::format("{}\t{}\t{}\t{}\n", printable(results.info().layout_name(row.layout)),
                            printable(results.info().acceleration_name(row.acceleration)),
                            outcome(row, slice.worlds[world].fallen_at_end),
                            outcome(row, slice.worlds[world].end_kinetic_energy)));
  }
}

/// The longest of the names; empty when there are none.
std::string longest(const std::vector<std::string>& names) {
  const auto shorter = [](const std::string& a, const std::string& b) { return a.size() < b.size(); };
  const auto found = std::max_element(names.begin(), names.end(), shorter);
  return found == names.end() ? "" : *found;
}

}  // namespace

std::optional<Error> prepare_text_export(const std::string& folder, const std::vector<std::string>& layout_names,
                                         const std::vector<std::string>& acceleration_names,
                                         const std::string& batch_directory) {
  return h5::caught(folder, [&] {
    make_output_folder(folder);
    const long most = ::pathconf(folder.c_str(), _PC_NAME_MAX);
    const std::string pair =
        pair_of(longest(distinct_stems(layout_names)), longest(distinct_stems(acceleration_names)));
    const std::string name = longest({resumed_file(pair), batch_file(batch_directory)});
    if (most < 0 || name.size() <= static_cast<std::size_t>(most)) return;
    throw h5::Failure(Error{.file = folder,
                            .what = "cannot have a text file with such a long name",
                            .value = printable(name),
                            .accepted = fmt::format("at most {} bytes; use shorter names, or no text files", most)});
  });
}

std::optional<Error> export_text(const std::string& results_path, const std::string& folder,
                                 const std::string& batch_directory) {
  return h5::caught(folder, [&] {
    Result<ResultsReader> results = ResultsReader::open(results_path);
    if (!results) throw h5::Failure(results.error());
    const ResultsInfo& info = results->info();
    if (!info.complete) {
      throw h5::Failure(Error{.file = results_path,
                              .what = "is a part of an unfinished run",
                              .accepted = "a complete results file; --resume finishes the run"});
    }
    make_output_folder(folder);
    const std::vector<std::string> layouts = distinct_stems(info.layouts);
    const std::vector<std::string> accelerations = distinct_stems(info.accelerations);
    OutputFile batch(folder + "/" + batch_file(batch_directory));
    batch.write("# layout file\tacceleration file\tfallen boxes\ttotal kinetic energy [J]   (nan: not simulated)\n");
    const auto error =
        derive_summary(*results, info.thresholds, [&](const SummarySlice& slice) -> std::optional<Error> {
          return h5::caught(folder, [&] { export_slice(*results, slice, folder, layouts, accelerations, batch); });
        });
    if (error) throw h5::Failure(*error);
    batch.close();
  });
}

}  // namespace holdfast::internal
