#include "io/results/results_inputs.hpp"

#include <string>
#include <string_view>

#include "io/input/text_lines.hpp"

namespace holdfast::internal {

namespace {

const std::string kLayoutHashes = "/inputs/layout_hashes";
constexpr std::size_t kHashBytes = 64;  // SHA-256, hexadecimal

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

  h5::make_group(file, "/inputs/settings");
  h5::write_text(file, "/inputs/config", run.config_text, "configuration file as used");
  for (const auto& [key, value] : run.settings) h5::write_attribute(file, "/inputs/settings", key, value);
  write_thresholds(file, run.thresholds);
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
  const auto number = [&](const char* name) { return h5::read_number_attribute(file, "/summary", name); };
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
  for (const Box& box : layout.boxes) {
    columns["/inputs/layouts/corner_min"].append(box.corner_min);
    columns["/inputs/layouts/corner_max"].append(box.corner_max);
    columns["/inputs/layouts/material"].append(static_cast<std::int32_t>(box.material));
  }
}

}  // namespace holdfast::internal
