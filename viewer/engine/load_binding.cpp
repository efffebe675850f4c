// Loads, as the program reads, screens and searches them: what the page calls when it has files of loads, not results.
// A load goes between the two as JSON of ours (docs/start/loads.md), which has everything that a load says.

#include <nlohmann/json.hpp>

#include <array>
#include <atomic>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "analyses/bearing/bearing.hpp"
#include "analyses/margins/margin_search.hpp"
#include "api/convert.hpp"
#include "core/engine/series_recorder.hpp"
#include "core/model/container_catalogue.hpp"
#include "core/model/friction_pairs.hpp"
#include "core/model/length_unit.hpp"
#include "core/model/norms.hpp"
#include "core/model/outcome.hpp"
#include "core/model/setting_table.hpp"
#include "io/loads/check_load.hpp"
#include "io/loads/known_formats.hpp"
#include "io/loads/load_choices.hpp"
#include "io/loads/load_file.hpp"
#include "io/loads/load_json.hpp"
#include "io/loads/own_json.hpp"
#include "io/loads/table_text.hpp"
#include "page_call.hpp"

using namespace holdfast::internal;

namespace {

using Json = nlohmann::ordered_json;

/// Texts of files may have bytes that are no UTF-8.
std::string text_of(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

Json error_json(const Error& error) {
  return {{"message", error.message()}, {"file", error.file},   {"line", error.line},        {"column", error.column},
          {"what", error.what},         {"value", error.value}, {"accepted", error.accepted}};
}

Json errors_json(const std::vector<Error>& errors) {
  Json list = Json::array();
  for (const Error& error : errors) list.push_back(error_json(error));
  return list;
}

std::vector<double> list_of(const Vec3& vector) { return {vector.begin(), vector.end()}; }

Json shape_json(const ContainerShape& shape) {
  Json drops = Json::object();
  for (const DropSide& drop : shape.drop_sides) drops[drop.side] = drop.height;
  return {{"type", shape.type},
          {"size", list_of(shape.size)},
          {"open_sides", shape.open_sides},
          {"drop_sides", drops},
          {"bed_height", shape.bed_height}};
}

std::optional<std::string> optional_text(const char* text) {
  return text == nullptr || *text == '\0' ? std::nullopt : std::optional<std::string>(text);
}

/// The settings with what is chosen for files of loads beside them, as the options of the program choose it.
Settings settings_with(const holdfast_settings* handle, const LoadChoices& choices) {
  Config config;
  apply_settings(config, given_settings(handle));
  Settings settings = config.settings;
  if (const auto wrong = choices.apply_to(settings, config)) throw exception_of({*wrong});
  return settings;
}

/// A load of the page, read and checked as one of a file.
Layout load_of(const char* text, Settings settings) {
  // How files lie and are measured is said of what the user has, and the page has read that.
  const std::optional<double> tolerance = settings.loads.overlap_tolerance;
  settings.loads = {};
  settings.loads.overlap_tolerance = tolerance;
  settings.up_axis = UpAxis::z;
  const std::string path = "the load";
  OwnJson json(path, path, settings);
  if (const auto error = json.read_file(required(text, "text"), 0)) throw exception_of({*error});
  LoadsOfFile found = json.take();
  if (found.loads.size() != 1) throw BadArgument{"not one load"};
  ReadLoad& load = found.loads.front();
  check_load(load, path, settings);
  if (!load.errors.empty()) throw exception_of(load.errors);
  return std::move(load.layout);
}

/// The acceleration of these rows of five numbers; without any, that of the norm in the settings.
Acceleration acceleration_for(const Settings& settings, std::size_t of_norm, const double* segments,
                              std::size_t segment_count) {
  if (segment_count > 0)
    return value_or_throw(read_acceleration(acceleration_of("the acceleration", segments, segment_count)));
  std::vector<Acceleration> accelerations = value_or_throw(find_norm(settings.screening.norm)).accelerations();
  if (of_norm >= accelerations.size()) throw BadArgument{"no such acceleration"};
  return std::move(accelerations[of_norm]);
}

Json acceleration_json(const Acceleration& acceleration) {
  Json segments = Json::array();
  for (const Segment& segment : acceleration.segments)
    segments.push_back(
        {{"start", segment.start}, {"duration", segment.duration}, {"value", list_of(segment.acceleration)}});
  return {{"name", acceleration.name}, {"purpose", acceleration.purpose}, {"segments", segments}};
}

void add_column(std::string_view name, const std::vector<double>& values) {
  page_answer.numbers.insert(page_answer.numbers.end(), values.begin(), values.end());
  page_answer.columns += std::string(name) + ' ' + std::to_string(values.size()) + '\n';
}

void put(std::vector<double>& numbers, double value) { numbers.push_back(value); }
void put(std::vector<double>& numbers, const Float3& value) {
  numbers.insert(numbers.end(), {value.x, value.y, value.z});
}
void put(std::vector<double>& numbers, const Float4& value) {
  numbers.insert(numbers.end(), {value.w, value.x, value.y, value.z});
}

template <class Values>
void add_values(const std::string& name, const Values& values) {
  std::vector<double> numbers;
  for (const auto& value : values) put(numbers, value);
  add_column(name, numbers);
}

/// What the results file has of the boxes of a world, and of its samples.
void add_record(const WorldRecord& record, const Layout& layout, const Settings& settings) {
  add_values("worlds/solve_iterations", std::array{record.row.solve_iterations});
  add_values("boxes/mass", record.boxes.mass);
  add_values("boxes/size", record.boxes.size);
  add_values("boxes/initial_position", record.boxes.initial_position);
  std::vector<double> fixed;
  for (const Box& box : layout.boxes) fixed.push_back(properties_of(settings, box).fixed ? 1.0 : 0.0);
  add_column("boxes/fixed", fixed);
  visit_ends<EndTable>([&](const OutcomeField& field, auto column) {
    add_values("boxes/" + std::string(field.name), record.end.*column);
  });
  const Thresholds thresholds = recording_plan(settings, false).thresholds;
  std::vector<BoxVerdict> verdicts;
  for (std::size_t box = 0; box < record.end.end_tilt.size(); ++box)
    verdicts.push_back(judge_box(record.end, box, by_run(thresholds)));
  visit_box_verdict<BoxVerdict>([&](const OutcomeField& field, auto member) {
    std::vector<double> numbers;
    for (const BoxVerdict& verdict : verdicts) numbers.push_back(static_cast<double>(verdict.*member));
    add_column("verdict/" + std::string(field.name), numbers);
  });
  const Series& series = record.series;
  add_values("series/time", series.time);
  add_values("series/container_acceleration", series.container_acceleration);
  add_values("series/total_kinetic_energy", series.total_kinetic_energy);
  add_values("series/fallen_count", series.fallen_count);
  add_values("series/displacement", series.displacement);
  add_values("series/orientation", series.orientation);
}

}  // namespace

/// Leaves as JSON what there is to choose from: `containers`, `norms` and `friction` (pairs of materials), each with
/// where its numbers are from, and what tells how files lie: `formats`.
EXPORTED int page_catalogue() {
  return call([] {
    Json json;
    for (const ContainerType& type : container_catalogue()) {
      Json container = {{"name", type.name}, {"what", type.what}, {"payload", type.payload}, {"source", type.source}};
      container["shape"] = shape_json(type.shape());
      json["containers"].push_back(container);
    }
    for (const Norm& norm : norms())
      json["norms"].push_back({{"name", norm.name},
                               {"numbers", numbers_of(norm)},
                               {"source", norm.source},
                               {"takesSize", norm.takes_size}});
    for (const FrictionPair& pair : friction_pairs()) {
      Json row = {{"name", pair.name}, {"materials", pair.materials}, {"dry", pair.dry}, {"wet", nullptr}};
      if (pair.wet) row["wet"] = *pair.wet;
      json["friction"].push_back(row);
    }
    json["frictionSource"] = kFrictionSource;
    for (const KnownFormat& format : kKnownFormats)
      json["formats"].push_back({{"name", format.name}, {"what", format.what}});
    page_answer.text = text_of(json);
  });
}

/// Leaves as JSON what a run with these settings has: `settings`, all of them as the results file has them; the
/// `container` that loads stand in which have none of their own; the `limits` of verdicts; and, where they name a norm,
/// that `norm` with its accelerations and the margins that it needs.
EXPORTED int page_run(const holdfast_settings* handle, const char* container) {
  return call([&] {
    const Settings settings = settings_with(handle, {.container = optional_text(container)});
    Json json;
    for (const auto& [key, value] : effective_settings(settings)) json["settings"][key] = value;
    json["container"] = shape_json(settings.container);
    const Thresholds limits = recording_plan(settings, false).thresholds;
    json["limits"] = {{"drop", limits.drop}, {"move", limits.move}, {"tilt", limits.tilt}};
    json["norm"] = nullptr;
    if (!settings.screening.norm.empty()) {
      const ChosenNorm norm = value_or_throw(find_norm(settings.screening.norm));
      Json accelerations = Json::array();
      for (const Acceleration& acceleration : norm.accelerations())
        accelerations.push_back(acceleration_json(acceleration));
      json["norm"] = {{"name", norm.name()},
                      {"numbers", norm.numbers()},
                      {"source", norm.norm->source},
                      {"neededMargins", norm.needed_margins()},
                      {"accelerations", accelerations}};
    }
    page_answer.text = text_of(json);
  });
}

/// Reads all loads of a text as the program reads those of a file, and leaves a line of JSON for the file and two for
/// each load: what is said of it, and the load itself as JSON of ours.
/// @param bytes     of the file
/// @param name      of the file, which messages and loads have
/// @param container and what follows it: options of the program beside the settings; null or empty: not given
EXPORTED int page_read_loads(const holdfast_settings* handle, const char* bytes, std::size_t size, const char* name,
                             const char* container, const char* unit, const char* axes, const char* format,
                             const char* columns) {
  return call([&] {
    const Settings settings = settings_with(handle, {.container = optional_text(container),
                                                     .unit = optional_text(unit),
                                                     .axes = optional_text(axes),
                                                     .format = optional_text(format),
                                                     .columns = optional_text(columns)});
    const TextFile file{.path = required(name, "name"), .name = name, .text = std::string(bytes, size)};
    Result<LoadsOfFile> read = read_loads(file, settings);
    LoadsOfFile found = read ? std::move(*read) : LoadsOfFile();
    const Json errors = read ? Json::array() : errors_json(read.errors());
    std::string lines = text_of({{"form", found.form}, {"notes", errors_json(found.notes)}, {"errors", errors}}) + '\n';
    for (ReadLoad& load : found.loads) {
      Layout& layout = load.layout;
      if (settings.container.overrides_loads) layout.container.reset();
      double mass = 0.0;
      for (const Box& box : layout.boxes)
        if (const BoxProperties properties = properties_of(settings, box); !properties.fixed) mass += properties.mass;
      lines += text_of({{"name", layout.name},
                        {"header", layout.header},
                        {"boxCount", load.box_count},
                        {"mass", mass},
                        {"errors", errors_json(load.errors)},
                        {"warnings", errors_json(load.warnings)}});
      lines += '\n' + load_line(layout) + '\n';
    }
    page_answer.text = std::move(lines);
  });
}

/// Leaves the first rows of a table as JSON, with their lines in the text: for a user who has to tell what its columns
/// mean.
/// @param rows at most
EXPORTED int page_preview(const char* bytes, std::size_t size, std::size_t rows) {
  return call([&] {
    const std::string_view text(bytes, size);
    TableText table(text, separator_of(text));
    Json json = Json::array();
    while (json.size() < rows && table.next()) {
      Json cells = Json::array();
      for (const TableCell& cell : table.row()) cells.push_back(std::string(cell.text));
      json.push_back({{"line", table.row().front().line}, {"cells", cells}});
    }
    page_answer.text = text_of(json);
  });
}

/// Simulates a load under an acceleration, as `holdfast screen` does, into numbers that `page_outcome_rows` explains.
/// @param text         of a file of ours with the load
/// @param acceleration of the norm in the settings, from 0, where there are no segments
/// @param segments     rows of five numbers
/// @param record       also what the results file has of boxes and samples, in further columns
EXPORTED int page_screen_load(const holdfast_settings* handle, const char* container, const char* text,
                              std::size_t acceleration, const double* segments, std::size_t segment_count, int record) {
  return call([&] {
    const Settings settings = settings_with(handle, {.container = optional_text(container)});
    const Layout layout = load_of(text, settings);
    const Acceleration pushed = acceleration_for(settings, acceleration, segments, segment_count);
    const std::unique_ptr<Engine> engine = engine_of(settings);
    const WorldRecord found = simulate_world(*engine, layout, pushed, settings, record != 0);
    holdfast::WorldOutcome world;
    fill_world(found, recording_plan(settings, false).thresholds, false, world);
    append(world);
    page_answer.columns = "outcome " + std::to_string(page_answer.numbers.size()) + '\n';
    if (record != 0) add_record(found, layout, settings);
  });
}

/// Finds the margins of a load, as `holdfast margins` does, into columns of four directions.
/// @param direction that is searched alone; below 0: all
EXPORTED int page_load_margins(const holdfast_settings* handle, const char* container, const char* text,
                               int direction) {
  return call([&] {
    const Settings settings = settings_with(handle, {.container = optional_text(container)});
    const Layout layout = load_of(text, settings);
    const std::unique_ptr<Engine> engine = engine_of(settings);
    const std::atomic<bool> abort = false;
    const LayoutMargins margins =
        direction < 0 ? *find_margins(*engine, layout, settings, abort)
                      : *find_margin(static_cast<std::size_t>(direction), *engine, layout, settings, abort);
    add_values("margin", margins.margin);
    add_values("critical_box", margins.critical_box);
    add_values("margin_within_limits", margins.margin_within_limits);
    add_values("critical_box_within_limits", margins.critical_box_within_limits);
    add_values("trials", std::array{margins.trials});
  });
}

/// Finds the least and the largest load on each box at rest, kg, as `holdfast check --bearing` does, into columns.
EXPORTED int page_load_bearing(const holdfast_settings* handle, const char* container, const char* text) {
  return call([&] {
    const Settings settings = settings_with(handle, {.container = optional_text(container)});
    std::vector<double> least;
    std::vector<double> largest;
    for (const BearingRange& range : find_bearing(load_of(text, settings), settings)) {
      least.push_back(range.least);
      largest.push_back(range.largest);
    }
    add_column("least", least);
    add_column("largest", largest);
  });
}
