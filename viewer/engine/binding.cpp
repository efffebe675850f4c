// What the page calls beside the C interface of the library: its inputs as texts, and a whole world with its verdict.

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "api/convert.hpp"
#include "api/version.hpp"
#include "core/engine/series_recorder.hpp"
#include "core/engine/simulate.hpp"
#include "core/model/world.hpp"
#include "io/input/acceleration_reader.hpp"
#include "io/input/layout_reader.hpp"
#include "page_call.hpp"

using namespace holdfast::internal;

namespace holdfast::internal {

namespace {

void append(const Vec3& vector) { page_answer.numbers.insert(page_answer.numbers.end(), vector.begin(), vector.end()); }

// The page gets the fields of a world that a structure of C has: all but the message, which is no number.
#define FIELD_ROW(scope, type, name, ...) HOLDFAST_IF_C_##scope("field " #type " " #name "\n")
#define FIELD_NUMBERS(scope, type, name, ...) HOLDFAST_IF_C_##scope(append_field(#type, world.name);)
#define VERDICT_ROW(name, c_name, code, sentence) "verdict " #code " " #name "\n"
#define STOP_REASON_ROW(name, c_name, code, sentence) "stop_reason " #code " " #name "\n"

/// Appends a number; a hash as its upper and its lower half, since one number has too few bits.
template <class Value>
void append_field(std::string_view type, Value value) {
  std::vector<double>& numbers = page_answer.numbers;
  if (type != "hash") return numbers.push_back(static_cast<double>(value));
  const auto hash = static_cast<std::uint64_t>(value);
  numbers.push_back(static_cast<double>(hash >> 32));
  numbers.push_back(static_cast<double>(hash & 0xffffffffU));
}

}  // namespace

void append(const holdfast::WorldOutcome& world){HOLDFAST_WORLD_FIELDS(FIELD_NUMBERS)}

std::vector<holdfast::Setting> given_settings(const holdfast_settings* handle) {
  std::vector<holdfast::Setting> settings;
  const int status = with_settings(handle, [&](const std::vector<holdfast::Setting>& given) {
    settings = given;
    return static_cast<int>(HOLDFAST_OK);
  });
  if (status != HOLDFAST_OK) throw BadArgument{"the settings are not to be had"};
  return settings;
}

Settings settings_of(const holdfast_settings* handle) {
  Config config;
  apply_settings(config, given_settings(handle));
  return config.settings;
}

TextFile file_of(const char* name, const char* text) {
  return {.path = required(name, "name"), .name = name, .text = required(text, "text")};
}

std::unique_ptr<Engine> engine_of(const Settings& settings) {
  const EngineEntry* entry = find_engine(settings.screening.engine);
  if (entry == nullptr || entry->make == nullptr) throw BadArgument{"the page has the engines native and native-plain"};
  std::unique_ptr<Engine> engine = value_or_throw(entry->make(settings));
  if (const auto error = why_unsupported(*engine, settings)) throw exception_of({*error});
  return engine;
}

WorldRecord simulate_world(const Engine& engine, const Layout& layout, const Acceleration& acceleration,
                           const Settings& settings, bool series) {
  const Layout* const layouts[] = {&layout};
  const Acceleration* const accelerations[] = {&acceleration};
  WorldBatch batch = make_batch(layouts, accelerations, settings);
  SeriesRecorder recorder(plan_for(recording_plan(settings, series), acceleration));
  Recorder* const recorders[] = {&recorder};
  simulate(engine, batch, settings, recorders, std::atomic<bool>(false));
  return recorder.take();
}

}  // namespace holdfast::internal

const char* holdfast_version() { return kVersion; }

/// Why the last call of a function of these files failed.
EXPORTED const char* page_message() { return page_answer.message.c_str(); }

/// Numbers that the last call has read or found.
EXPORTED const double* page_numbers() { return page_answer.numbers.data(); }
EXPORTED std::size_t page_number_count() { return page_answer.numbers.size(); }

/// The text that it has left, and the columns of its numbers: a line for each, its name and how many they are.
EXPORTED const char* page_text() { return page_answer.text.c_str(); }
EXPORTED const char* page_columns() { return page_answer.columns.c_str(); }

/// Reads the text of a layout file into rows of seven numbers, m.
/// @param name what messages call it
EXPORTED int page_read_layout(const holdfast_settings* settings, const char* name, const char* text) {
  return call([&] {
    std::vector<Error> warnings;
    const Layout layout = value_or_throw(parse_layout(file_of(name, text), settings_of(settings), warnings));
    for (const Box& box : layout.boxes) {
      append(box.corner_min);
      append(box.corner_max);
      page_answer.numbers.push_back(box.material.id());
    }
  });
}

/// Reads the text of an acceleration file into rows of five numbers.
EXPORTED int page_read_acceleration(const char* name, const char* text) {
  return call([&] {
    std::vector<Error> warnings;
    const Acceleration acceleration = value_or_throw(parse_acceleration(file_of(name, text), warnings));
    for (const Segment& segment : acceleration.segments) {
      page_answer.numbers.push_back(segment.start);
      page_answer.numbers.push_back(segment.duration);
      append(segment.acceleration);
    }
  });
}

/// What the numbers of a world are, in their order, a line for each: "field", its type and its name. Then the names of
/// codes: type, code and name.
EXPORTED const char* page_outcome_rows() {
  return HOLDFAST_WORLD_FIELDS(FIELD_ROW) HOLDFAST_VERDICTS(VERDICT_ROW) HOLDFAST_STOP_REASONS(STOP_REASON_ROW);
}

/// Simulates a world to its end, as `holdfast screen` does, into numbers that `page_outcome_rows` explains.
EXPORTED int page_screen(const holdfast_settings* handle, const double* boxes, std::size_t box_count,
                         const double* segments, std::size_t segment_count) {
  return call([&] {
    const Settings settings = settings_of(handle);
    const std::unique_ptr<Engine> engine = engine_of(settings);
    std::vector<Error> errors;
    const Layout layout = read_layout(layout_of("the layout", boxes, box_count), "the layout",
                                      holdfast::LengthUnit::metre, settings, errors)
                              .layout;
    if (!errors.empty()) throw exception_of(errors);
    const Acceleration acceleration =
        value_or_throw(read_acceleration(acceleration_of("the acceleration", segments, segment_count)));
    holdfast::WorldOutcome world;
    fill_world(simulate_world(*engine, layout, acceleration, settings, false),
               recording_plan(settings, false).thresholds, false, world);
    append(world);
  });
}
