#include "fuzz/fuzz_targets.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/serve/layout_request.hpp"
#include "core/base/error_list.hpp"
#include "core/model/layout_check.hpp"
#include "core/model/setting_table.hpp"
#include "io/input/acceleration_reader.hpp"
#include "io/input/config_reader.hpp"
#include "io/input/input_paths.hpp"
#include "io/input/layout_reader.hpp"
#include "io/loads/load_file.hpp"
#include "io/loads/load_json.hpp"

namespace fuzz {

namespace {

using namespace holdfast::internal;

constexpr std::size_t kMostMessageBytes = 2000;
constexpr int kNumbersPerBox = 7;
constexpr std::size_t kMostNameBytes = 300;

void require(bool holds, const char* what) {
  if (!holds) throw std::logic_error(what);
}

TextFile file_of(std::string_view text) {
  return {.path = "folder/input.txt", .name = "input.txt", .text = std::string(text), .sha256 = std::string(64, '0')};
}

/// A message is a line that a terminal can show, however hostile the input.
void check_message(const Error& error) {
  const std::string message = error.message();
  require(message.size() < kMostMessageBytes, "a message is too long");
  for (const char letter : message) {
    const auto byte = static_cast<unsigned char>(letter);
    require(byte >= 0x20U && byte != 0x7FU, "a message has a control character");
  }
  require(error.line >= 0 && error.column >= 0, "a message has no place");
}

template <class T>
void check_errors(const Result<T>& result, const std::vector<Error>& warnings) {
  for (const Error& warning : warnings) check_message(warning);
  if (result) return;
  require(!result.errors().empty(), "refused without a reason");
  require(result.errors().size() <= ErrorList::kMost + 1, "too many errors");
  for (const Error& error : result.errors()) check_message(error);
}

void check_box(const Box& box) {
  require(box.corner_min.allFinite() && box.corner_max.allFinite(), "a corner is not finite");
  require((box.corner_max - box.corner_min).minCoeff() > kLayoutTolerance, "a box has no extent");
  require(box.material.is_number() && box.material.id() >= 0 && box.line > 0, "a box has no material or line");
}

/// Where a mistake in a box is looked up after the line was read.
void check_columns(std::string_view line, const LayoutRequest& request) {
  const auto boxes = static_cast<std::ptrdiff_t>(request.places.size());
  for (std::ptrdiff_t box = 0; box < boxes; ++box) {
    const bool is_object = request.number_places.contains(static_cast<std::size_t>(box));
    long before = 0;
    for (int number = -1; number < kNumbersPerBox; ++number) {
      if (is_object) {
        const long place = column_of(line, request, box, number);
        require(place >= 1 && place <= static_cast<long>(line.size()), "a number is not in the line");
        continue;
      }
      const long column = column_of(line, request, box, number);
      require(column > before && column <= static_cast<long>(line.size()), "a number has no column of its own");
      before = column;
    }
  }
}

void check_request(std::string_view line) {
  const std::vector<std::string> accelerations = {"brake.txt", "corner.txt"};
  const auto [request, error] = read_request(line, accelerations);
  require(nlohmann::json::accept(request.id), "an id is not JSON");
  require(request.id.find_first_of("\r\n") == std::string::npos, "an id ends the line of the answer");
  if (error) {
    // The answer escapes what a terminal could not show.
    require(error->message().size() < kMostMessageBytes, "a message is too long");
    require(error->column >= 1 && error->column <= static_cast<long>(line.size()) + 1, "a mistake is not in the line");
    require(error->box >= 0 && error->box_number >= 0, "a mistake is in no box");
    return;
  }
  if (request.layout)
    require(request.layout->boxes.size() == request.places.size() && request.numbers.empty(), "a box is lost");
  else
    require(request.numbers.size() == kNumbersPerBox * request.places.size(), "a box has not seven numbers");
  for (const std::string& name : request.box_names()) require(name.size() <= 120, "a name is too long");
  for (const double number : request.numbers) require(std::isfinite(number), "a number is not finite");
  for (const std::size_t index : request.options.accelerations)
    require(index < accelerations.size(), "an acceleration is none of those that are there");
  check_columns(line, request);
}

}  // namespace

void read_layout(std::string_view text) {
  classify(text);
  const TextFile file = file_of(text);
  Settings settings;
  for (const UpAxis up : {UpAxis::z, UpAxis::y}) {
    settings.up_axis = up;
    settings.container.open_sides = up == UpAxis::z ? std::vector<std::string>{} : std::vector<std::string>{"rear"};
    std::vector<Error> warnings;
    const Result<Layout> layout = parse_layout(file, settings, warnings);
    check_errors(layout, warnings);
    if (!layout) continue;
    require(!layout->boxes.empty() && layout->boxes.size() <= kMostBoxes, "no boxes, or too many");
    for (const Box& box : layout->boxes) check_box(box);
  }
}

void read_load_file(std::string_view text) {
  classify(text);
  const TextFile file = file_of(text);
  Settings settings;
  for (const char* const format : {"", "planner", "py3dbp"}) {
    settings.loads.format = format;
    const Result<LoadsOfFile> loads = read_loads(file, settings);
    if (!loads) {
      check_errors(loads, {});
      continue;
    }
    require(!loads->loads.empty(), "neither loads nor an error");
    for (const Error& note : loads->notes) check_message(note);
    for (const ReadLoad& load : loads->loads) {
      require(!load.layout.name.empty() && load.layout.name.size() <= kMostNameBytes, "a name is too long, or none");
      for (const Error& error : load.errors) check_message(error);
      for (const Error& warning : load.warnings) check_message(warning);
      require(load.errors.size() <= ErrorList::kMost + 1, "too many errors");
      require(load.errors.empty() != load.layout.boxes.empty(), "a load has either boxes or errors");
      require(container_of(settings, load.layout).size.minCoeff() > 0.0, "a container has no size");
      for (const Box& box : load.layout.boxes) {
        require((box.corner_max - box.corner_min).minCoeff() > kLayoutTolerance, "a box has no extent");
        require(!box.mass || (*box.mass > 0.0 && std::isfinite(*box.mass)), "a mass is none");
        require(box.name.size() <= kMostNameBytes, "a name is too long");
      }
      if (!load.errors.empty()) continue;
      // A load is the same when it is written and read again.
      const std::string text_again = "{\"holdfast\": 1}\n" + load_line(load.layout) + '\n';
      const Result<LoadsOfFile> again = read_loads(file_of(text_again), settings);
      require(bool(again) && again->loads.size() == 1 && again->loads[0].errors.empty(), "what is written is not read");
      require(canonical_json(again->loads[0].layout) == canonical_json(load.layout),
              "a load changes when it is written");
    }
  }
}

void read_acceleration(std::string_view text) {
  classify(text);
  std::vector<Error> warnings;
  const Result<Acceleration> acceleration = parse_acceleration(file_of(text), warnings);
  check_errors(acceleration, warnings);
  if (!acceleration) return;
  require(!acceleration->segments.empty(), "no segments");
  double end = 0.0;
  for (const Segment& segment : acceleration->segments) {
    require(segment.start >= end && segment.duration > 0.0, "segments overlap");
    require(segment.acceleration.allFinite(), "an acceleration is not finite");
    end = segment.start + segment.duration;
  }
  require(std::isfinite(end) && acceleration->end_time() == end, "the end is not finite");
  // Phases are what a motion is used for.
  double reached = 0.0;
  for (const Phase& phase : phases_of(*acceleration, end)) {
    require(phase.begin == reached && phase.end > phase.begin, "phases leave gaps");
    reached = phase.end;
  }
  require(reached == end, "phases end early");
}

void read_config(std::string_view text) {
  classify(text);
  std::vector<Error> warnings;
  const Result<Config> config = parse_config(file_of(text), warnings);
  check_errors(config, warnings);
  if (!config) return;
  require(check_settings(config->settings).empty(), "accepted settings contradict each other");
  effective_settings(config->settings);
}

void read_requests(std::string_view text) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    check_request(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

}  // namespace fuzz
