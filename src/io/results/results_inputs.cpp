#include "io/results/results_inputs.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "core/model/setting_kinds.hpp"
#include "io/input/text_lines.hpp"

namespace holdfast::internal {

namespace {

const std::string kLayoutHashes = "/inputs/layout_hashes";
constexpr std::size_t kHashBytes = 64;  // SHA-256, hexadecimal

/// A whole column of numbers.
template <class T>
std::vector<T> read_numbers(const h5::File& file, std::string_view path) {
  const h5::Dataset dataset = h5::Dataset::open(file, dataset_spec(path));
  return values_of<T>(dataset.read(0, dataset.length()));
}

std::vector<Acceleration> read_accelerations(const h5::File& file) {
  const std::vector<std::string> names = read_texts(file, "/inputs/accelerations/name");
  const std::vector<std::string> hashes = read_texts(file, "/inputs/accelerations/sha256");
  const auto counts = read_numbers<std::uint32_t>(file, "/inputs/accelerations/segment_count");
  const auto start = read_numbers<double>(file, "/inputs/accelerations/start");
  const auto duration = read_numbers<double>(file, "/inputs/accelerations/duration");
  const auto value = read_numbers<double>(file, "/inputs/accelerations/value");
  std::vector<Acceleration> accelerations;
  std::size_t segment = 0;
  for (std::size_t i = 0; i < names.size(); ++i) {
    Acceleration& made = accelerations.emplace_back(Acceleration{.name = names[i], .sha256 = hashes.at(i)});
    for (std::uint32_t k = 0; k < counts.at(i); ++k, ++segment)
      made.segments.push_back({start.at(segment),
                               duration.at(segment),
                               {value.at(3 * segment), value.at(3 * segment + 1), value.at(3 * segment + 2)}});
  }
  return accelerations;
}

}  // namespace

void write_run(const h5::File& file, const RunDescription& run) {
  const auto text = [&](const char* name, std::string_view value) { h5::write_attribute(file, "/", name, value); };
  text("format", kFormatName);
  h5::write_attribute(file, "/", "format_version", kFormatVersion);
  text("software", run.software);
  text("git_commit", run.git_commit);
  text("engine", run.engine);
  text("command_line", run.command_line);
  text("created_utc", run.created_utc);
  text("host", run.host);
  text("fingerprint", fingerprint(run));

  if (run.shard) {
    const Shard& shard = run.shard->shard;
    for (const auto& [name, value] : {std::pair{"shard", shard.part}, std::pair{"shards", shard.parts},
                                      std::pair{"shard_block", shard.block}, std::pair{"run_layouts", shard.layouts}})
      h5::write_attribute(file, "/", name, value);
    text("run_fingerprint", run.shard->run_fingerprint);
  }

  h5::make_group(file, "/inputs/settings");
  h5::write_text(file, "/inputs/config", run.config_text, "configuration file as used");
  for (const auto& [key, value] : run.settings) h5::write_attribute(file, "/inputs/settings", key, value);
  write_thresholds(file, run.thresholds);
}

std::vector<std::string> read_texts(const h5::File& file, std::string_view path) {
  const h5::Dataset dataset = h5::Dataset::open(file, dataset_spec(path));
  return texts_of(dataset.read(0, dataset.length()), dataset.number_bytes());
}

RunTables tables_in(const h5::File& file) {
  RunTables tables;
  for (const AnalysisTables* analysis : all_tables())
    if (h5::exists(file, '/' + std::string(analysis->name))) tables.push_back(analysis);
  return tables;
}

std::vector<std::pair<std::string, std::string>> read_settings(const h5::File& file) {
  std::vector<std::pair<std::string, std::string>> settings;
  for (std::string& key : h5::attribute_names(file, "/inputs/settings")) {
    std::string value = h5::read_text_attribute(file, "/inputs/settings", key);
    settings.emplace_back(std::move(key), std::move(value));
  }
  return settings;
}

RunDescription read_run(const h5::File& file) {
  const auto text = [&](const char* name) { return h5::read_text_attribute(file, "/", name); };
  const auto count = [&](const char* name) { return h5::read_count_attribute(file, "/", name); };
  RunDescription run;
  run.software = text("software");
  run.git_commit = text("git_commit");
  run.engine = text("engine");
  run.command_line = text("command_line");
  run.created_utc = text("created_utc");
  run.host = text("host");
  run.config_text = h5::read_text(file, "/inputs/config");
  run.settings = read_settings(file);
  run.accelerations = read_accelerations(file);
  run.analyses = tables_in(file);
  run.thresholds = read_thresholds(file);
  if (h5::has_attribute(file, "/", "shard"))
    run.shard = {{count("shard"), count("shards"), count("shard_block"), count("run_layouts")},
                 text("run_fingerprint")};
  return run;
}

void write_layout_hashes(const h5::File& file, const std::vector<std::string>& hashes) {
  std::string text;
  for (const std::string& hash : hashes) {
    text += hash;
    text.resize(text.size() + kHashBytes - hash.size(), ' ');
  }
  h5::write_text(file, kLayoutHashes, text,
                 "SHA-256 of every layout of the run when it began, 64 characters each; blank if it could not be read");
}

std::vector<std::string> read_layout_hashes(const h5::File& file) {
  const std::string text = h5::read_text(file, kLayoutHashes);
  if (text.size() % kHashBytes != 0) file.fail("has a text of a wrong length (" + kLayoutHashes + ")");
  std::vector<std::string> hashes;
  for (std::size_t begin = 0; begin < text.size(); begin += kHashBytes)
    hashes.emplace_back(trimmed(std::string_view(text).substr(begin, kHashBytes)));
  return hashes;
}

void write_thresholds(const h5::File& file, const Thresholds& thresholds) {
  h5::make_group(file, "/summary");
  const auto number = [&](const std::string& name, double value, const char* units) {
    h5::write_attribute(file, "/summary", name, value);
    h5::write_attribute(file, "/summary", name + "_units", std::string_view(units));
  };
  number("drop_threshold", thresholds.drop, "m");
  number("move_threshold", thresholds.move, "m");
  number("tilt_threshold", thresholds.tilt, "degree");
}

Thresholds read_thresholds(const h5::File& file) {
  const auto number = [&](const char* name) {
    const double limit = h5::read_number_attribute(file, "/summary", name);
    if (!std::isfinite(limit) || limit < 0.0)
      h5::fail(file.path(), fmt::format("is damaged: /summary/{} is no limit", name));
    return limit;
  };
  return {number("drop_threshold"), number("move_threshold"), number("tilt_threshold")};
}

void append_accelerations(ColumnSet& columns, const std::vector<Acceleration>& accelerations) {
  std::uint64_t begin = 0;
  for (const Acceleration& acceleration : accelerations) {
    columns["/inputs/accelerations/name"].append(acceleration.name);
    columns["/inputs/accelerations/sha256"].append(acceleration.sha256);
    columns["/inputs/accelerations/segment_begin"].append(begin);
    columns["/inputs/accelerations/segment_count"].append(static_cast<std::uint32_t>(acceleration.segments.size()));
    begin += acceleration.segments.size();
    for (const Segment& segment : acceleration.segments) {
      columns["/inputs/accelerations/start"].append(segment.start);
      columns["/inputs/accelerations/duration"].append(segment.duration);
      columns["/inputs/accelerations/value"].append(segment.acceleration);
    }
  }
}

void append_layout(ColumnSet& columns, const Layout& layout, std::uint64_t box_begin) {
  columns["/inputs/layouts/name"].append(layout.name);
  columns["/inputs/layouts/sha256"].append(layout.sha256);
  columns["/inputs/layouts/header"].append(layout.header);
  columns["/inputs/layouts/box_begin"].append(box_begin);
  columns["/inputs/layouts/box_count"].append(static_cast<std::uint32_t>(layout.boxes.size()));
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const std::optional<ContainerShape>& own = layout.container;
  columns["/inputs/layouts/container_type"].append(own ? own->type : std::string());
  columns["/inputs/layouts/container_size"].append(own ? own->size : Vec3(Vec3::Constant(kNone)));
  columns["/inputs/layouts/open_sides"].append(own ? setting_kinds::Sides::text(own->open_sides) : std::string());
  columns["/inputs/layouts/drop_sides"].append(own ? setting_kinds::DropSides::text(own->drop_sides) : std::string());
  columns["/inputs/layouts/bed_height"].append(own ? own->bed_height : kNone);
  for (const Box& box : layout.boxes) {
    columns["/inputs/layouts/material_name"].append(box.material.is_number() ? std::string() : box.material.text());
    columns["/inputs/layouts/box_name"].append(box.name);
    columns["/inputs/layouts/mass"].append(box.mass.value_or(kNone));
    columns["/inputs/layouts/centre_of_mass"].append(box.centre_of_mass.value_or(Vec3(Vec3::Constant(kNone))));
    columns["/inputs/layouts/mat"].append(box.mat.value_or(kNone));
    columns["/inputs/layouts/fixed"].append(box.fixed);
    columns["/inputs/layouts/order"].append(box.order ? static_cast<double>(*box.order) : kNone);
    columns["/inputs/layouts/bearing_limit"].append(box.bearing_limit.value_or(kNone));
    columns["/inputs/layouts/corner_min"].append(box.corner_min);
    columns["/inputs/layouts/corner_max"].append(box.corner_max);
    columns["/inputs/layouts/material"].append(static_cast<std::int32_t>(box.material.id()));
  }
}

}  // namespace holdfast::internal
