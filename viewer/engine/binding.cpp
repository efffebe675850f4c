// What the page calls beside the C interface of the library: its inputs as texts, and a whole world with its verdict.

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "api/apply_settings.hpp"
#include "api/c_arguments.hpp"
#include "api/c_settings.hpp"
#include "api/convert.hpp"
#include "api/version.hpp"
#include "core/engine/engine_registry.hpp"
#include "core/engine/engine_support.hpp"
#include "core/engine/series_recorder.hpp"
#include "core/engine/simulate.hpp"
#include "core/model/world.hpp"
#include "holdfast/holdfast.h"
#include "io/input/acceleration_reader.hpp"
#include "io/input/layout_reader.hpp"

using namespace holdfast::internal;

#define EXPORTED extern "C" __attribute__((visibility("default")))

namespace {

// The page has one thread. What a call leaves here is there until the next one.
std::string message;
std::vector<double> rows;

template <class Work>
int call(Work&& work) noexcept {
  message.clear();
  rows.clear();
  try {
    work();
    return HOLDFAST_OK;
  } catch (const BadArgument& bad) {
    message = bad.what;
    return HOLDFAST_BAD_ARGUMENT;
  } catch (const std::exception& error) {
    message = error.what();
    return HOLDFAST_ERROR;
  }
}

/// The settings behind a handle, where the default of `holdfast_world_new` is that of the page too.
Settings settings_of(const holdfast_settings* handle) {
  Settings settings;
  const int status = with_settings(handle, [&](const std::vector<holdfast::Setting>& given) {
    apply_settings(settings, given);
    return static_cast<int>(HOLDFAST_OK);
  });
  if (status != HOLDFAST_OK) throw BadArgument{"the settings are not to be had"};
  return settings;
}

TextFile file_of(const char* name, const char* text) {
  return {.path = required(name, "name"), .name = name, .text = required(text, "text")};
}

void append(const Vec3& vector) { rows.insert(rows.end(), vector.begin(), vector.end()); }

// The page gets the fields of a world that a structure of C has: all but the message, which is no number.
#define FIELD_ROW(scope, type, name, ...) HOLDFAST_IF_C_##scope("field " #type " " #name "\n")
#define FIELD_NUMBERS(scope, type, name, ...) HOLDFAST_IF_C_##scope(append_field(#type, world.name);)
#define VERDICT_ROW(name, c_name, code, sentence) "verdict " #code " " #name "\n"
#define STOP_REASON_ROW(name, c_name, code, sentence) "stop_reason " #code " " #name "\n"

/// Appends a number; a hash as its upper and its lower half, since one number has too few bits.
template <class Value>
void append_field(std::string_view type, Value value) {
  if (type != "hash") return rows.push_back(static_cast<double>(value));
  const auto hash = static_cast<std::uint64_t>(value);
  rows.push_back(static_cast<double>(hash >> 32));
  rows.push_back(static_cast<double>(hash & 0xffffffffU));
}

void append(const holdfast::WorldOutcome& world) { HOLDFAST_WORLD_FIELDS(FIELD_NUMBERS) }

}  // namespace

const char* holdfast_version() { return kVersion; }

/// Why the last call of a function of this file failed.
EXPORTED const char* page_message() { return message.c_str(); }

/// Numbers that the last call of a function of this file has read.
EXPORTED const double* page_numbers() { return rows.data(); }
EXPORTED std::size_t page_number_count() { return rows.size(); }

/// Reads the text of a layout file into rows of seven numbers, m.
/// @param name what messages call it
EXPORTED int page_read_layout(const holdfast_settings* settings, const char* name, const char* text) {
  return call([&] {
    std::vector<Error> warnings;
    const Layout layout = value_or_throw(parse_layout(file_of(name, text), settings_of(settings), warnings));
    for (const Box& box : layout.boxes) {
      append(box.corner_min);
      append(box.corner_max);
      rows.push_back(box.material.id());
    }
  });
}

/// Reads the text of an acceleration file into rows of five numbers.
EXPORTED int page_read_acceleration(const char* name, const char* text) {
  return call([&] {
    std::vector<Error> warnings;
    const Acceleration acceleration = value_or_throw(parse_acceleration(file_of(name, text), warnings));
    for (const Segment& segment : acceleration.segments) {
      rows.push_back(segment.start);
      rows.push_back(segment.duration);
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
    const EngineEntry* entry = find_engine(settings.screening.engine);
    if (entry == nullptr || entry->make == nullptr)
      throw BadArgument{"the page has the engines native and native-plain"};
    const std::unique_ptr<Engine> engine = value_or_throw(entry->make(settings));
    if (const auto error = why_unsupported(*engine, settings)) throw exception_of({*error});
    std::vector<Error> errors;
    const Layout layout = read_layout(layout_of("the layout", boxes, box_count), "the layout",
                                      holdfast::LengthUnit::metre, settings, errors)
                              .layout;
    if (!errors.empty()) throw exception_of(errors);
    const Acceleration acceleration =
        value_or_throw(read_acceleration(acceleration_of("the acceleration", segments, segment_count)));
    const Layout* const layouts[] = {&layout};
    const Acceleration* const accelerations[] = {&acceleration};
    WorldBatch batch = make_batch(layouts, accelerations, settings);
    const RecordingPlan plan = recording_plan(settings, false);
    SeriesRecorder recorder(plan);
    Recorder* const recorders[] = {&recorder};
    simulate(*engine, batch, settings, recorders, std::atomic<bool>(false));
    holdfast::WorldOutcome world;
    fill_world(recorder.take(), plan.thresholds, false, world);
    append(world);
  });
}
