#include <cstddef>
#include <new>
#include <optional>
#include <string_view>
#include <utility>

#include "api/convert.hpp"
#include "api/engine_loader.hpp"
#include "api/memory_run.hpp"
#include "api/recorded_run.hpp"
#include "api/version.hpp"
#include "core/engine/series_recorder.hpp"
#include "core/model/setting_table.hpp"
#include "holdfast/holdfast.hpp"
#include "io/input/acceleration_reader.hpp"
#include "io/input/config_reader.hpp"
#include "io/input/layout_reader.hpp"
#include "io/input/text_file.hpp"
#include "parallel/schedulers/scheduler.hpp"

namespace holdfast {

using internal::value_or_throw;

namespace {

/// Runs a call of the library: whatever goes wrong in it becomes an `Error`.
template <class Work>
auto guarded(Work&& work) -> decltype(work()) {
  try {
    return work();
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw internal::exception_of({internal::out_of_memory("")});
  } catch (const std::exception& error) {
    throw internal::exception_of({{.what = "the system refused", .value = error.what()}});
  }
}

/// Sets a key as a config.ini would.
void set(internal::Settings& settings, const char* section, const char* name, const std::string& value) {
  const internal::SettingKey& key = *internal::find_setting(section, name);
  if (key.set(settings, 0, value)) return;
  throw internal::exception_of({{.what = std::string("not a value of [") + section + "] " + name,
                                 .value = value,
                                 .accepted = "accepted are " + std::string(key.accepted)}});
}

internal::Settings settings_of(const ScreenOptions& options) {
  std::vector<internal::Error> ignored;
  const internal::TextFile text{.path = "config", .name = "config", .text = options.config};
  internal::Settings settings = value_or_throw(internal::parse_config(text, ignored)).settings;
  if (options.engine) set(settings, "Screening", "Engine", *options.engine);
  if (options.scheduler) set(settings, "Screening", "Scheduler", *options.scheduler);
  if (options.threads) set(settings, "Screening", "Threads", std::to_string(*options.threads));
  if (const auto error = internal::why_not_built(settings.screening.scheduler)) throw internal::exception_of({*error});
  if (options.accuracy) {
    if (const auto error = internal::set_accuracy(settings, *options.accuracy)) throw internal::exception_of({*error});
  }
  return settings;
}

/// SHA-256 of the numbers of a layout, which a file of its own would have.
std::string hash_of(const internal::Layout& layout) {
  std::string bytes;
  const auto append = [&](const void* data, std::size_t size) { bytes.append(static_cast<const char*>(data), size); };
  for (const internal::Box& box : layout.boxes) {
    append(box.corner_min.data(), 3 * sizeof(double));
    append(box.corner_max.data(), 3 * sizeof(double));
    append(&box.material, sizeof box.material);
  }
  return internal::sha256_of(bytes);
}

std::string hash_of(const internal::Acceleration& acceleration) {
  std::string bytes;
  const auto append = [&](const double* data, std::size_t count) {
    bytes.append(reinterpret_cast<const char*>(data), count * sizeof(double));
  };
  for (const internal::Segment& segment : acceleration.segments) {
    append(&segment.start, 1);
    append(&segment.duration, 1);
    append(segment.acceleration.data(), 3);
  }
  return internal::sha256_of(bytes);
}

}  // namespace

const char* version() noexcept { return internal::kVersion; }

Acceleration read_acceleration(const std::string& path) {
  return guarded([&] {
    const internal::TextFile file = value_or_throw(internal::read_text_file(path));
    std::vector<internal::Error> warnings;
    return internal::public_acceleration(value_or_throw(internal::parse_acceleration(file, warnings)));
  });
}

std::vector<EngineInfo> engines() {
  return guarded([] {
    std::vector<EngineInfo> infos;
    for (const internal::EngineEntry& entry : internal::engine_registry()) {
      const auto missing = internal::why_not_loadable(entry);
      infos.push_back({std::string(entry.name), std::string(entry.sentence), missing ? missing->message() : ""});
    }
    return infos;
  });
}

struct Screen::State {
  ScreenOptions options;
  internal::Settings settings;
  std::vector<Acceleration> accelerations;
  std::vector<internal::ReadAcceleration> read_accelerations;
  std::unique_ptr<internal::Engine> engine;
  std::optional<internal::Workers> workers;
  internal::Thresholds thresholds;
  internal::StopRequest stop;
  internal::StageCosts costs;
  internal::RunObserver observer;

  /// The layouts of a call. Throws when one cannot be used and that is to be an error.
  std::vector<internal::ReadLayout> read(std::span<const Layout> layouts) const {
    std::vector<internal::ReadLayout> read;
    read.reserve(layouts.size());
    std::vector<internal::Error> errors;
    for (const Layout& layout : layouts) read.push_back(internal::read_layout(layout, options.unit, settings, errors));
    if (options.bad_layouts == BadLayouts::raise && !errors.empty()) throw internal::exception_of(errors);
    return read;
  }

  internal::ScreeningPlan plan(internal::LayoutSource& layouts, bool series) {
    return {*engine, settings, *workers, layouts, read_accelerations, series};
  }

  /// A `cancel` that comes before a call does nothing to it.
  void forget_cancel() {
    stop.no_more = false;
    stop.drop = false;
  }
};

Screen::Screen(std::vector<Acceleration> accelerations, const ScreenOptions& options) {
  guarded([&] {
    state_ = std::make_unique<State>();
    state_->options = options;
    state_->settings = settings_of(options);
    if (accelerations.empty()) throw internal::exception_of({{.what = "a screen needs at least one acceleration"}});
    for (const Acceleration& acceleration : accelerations)
      state_->read_accelerations.push_back({value_or_throw(internal::read_acceleration(acceleration)), ""});
    state_->accelerations = std::move(accelerations);
    state_->engine = value_or_throw(internal::make_engine(state_->settings.screening.engine, state_->settings));
    state_->workers.emplace(state_->settings.screening.scheduler, state_->settings.screening.threads);
    state_->thresholds = internal::recording_plan(state_->settings, false).thresholds;
  });
}

Screen::~Screen() = default;
Screen::Screen(Screen&&) noexcept = default;
Screen& Screen::operator=(Screen&&) noexcept = default;

Layout Screen::read_layout(const std::string& path) const {
  return guarded([&] {
    const internal::TextFile file = value_or_throw(internal::read_text_file(path));
    std::vector<internal::Error> warnings;
    return internal::public_layout(value_or_throw(internal::parse_layout(file, state_->settings, warnings)),
                                   state_->options.unit);
  });
}

std::vector<WorldOutcome> Screen::evaluate(std::span<const Layout> layouts) {
  std::vector<WorldOutcome> worlds;
  evaluate(layouts, worlds);
  return worlds;
}

void Screen::evaluate(std::span<const Layout> layouts, std::vector<WorldOutcome>& worlds) {
  guarded([&] {
    State& state = *state_;
    state.forget_cancel();
    const std::size_t count = state.accelerations.size();
    internal::MemoryLayouts source(state.read(layouts));
    worlds.resize(layouts.size() * count);
    for (std::size_t i = 0; i < worlds.size(); ++i)
      internal::fill_world({.layout = i / count, .acceleration = i % count}, state.thresholds, false, worlds[i]);
    if (worlds.empty()) return;
    internal::MemorySink sink(worlds, count, state.thresholds, state.options.keep_boxes);
    const internal::ScreeningEnd end = internal::screen_worlds(state.plan(source, state.options.keep_series), sink,
                                                               state.observer, state.stop, state.costs);
    if (end.error) throw internal::exception_of({*end.error});
    for (WorldOutcome& world : worlds)
      if (world.stop_reason == StopReason::not_run && world.status == status::ok) world.message = "cancelled";
  });
}

bool Screen::record(std::span<const Layout> layouts, const std::string& path, const RecordOptions& options) {
  return guarded([&] {
    State& state = *state_;
    state.forget_cancel();
    if (layouts.empty()) throw internal::exception_of({{.file = path, .what = "a results file needs a layout"}});
    if (options.resume && options.overwrite)
      throw internal::exception_of({{.file = path, .what = "a run cannot both resume and overwrite"}});
    std::vector<internal::ReadLayout> read = state.read(layouts);
    std::vector<std::string> names;
    std::vector<std::string> hashes;
    for (internal::ReadLayout& layout : read) {
      if (layout.error.empty()) layout.layout.sha256 = hash_of(layout.layout);
      names.push_back(layout.layout.name);
      hashes.push_back(layout.layout.sha256);
    }
    for (internal::ReadAcceleration& acceleration : state.read_accelerations)
      acceleration.acceleration.sha256 = hash_of(acceleration.acceleration);
    internal::Recording recording{
        .path = path,
        .description = internal::describe_run(state.settings, std::move(names), std::move(hashes),
                                              state.read_accelerations, options.series)};
    recording.description.command_line = options.command_line;
    recording.description.config_text = state.options.config;
    if (options.resume) recording.existing = internal::ExistingResults::resume;
    if (options.overwrite) recording.existing = internal::ExistingResults::overwrite;
    std::optional<internal::Error> unprotected;
    const internal::OutputLock lock = value_or_throw(internal::OutputLock::take(path, unprotected));
    internal::MemoryLayouts source(std::move(read));
    const internal::RecordedEnd end = internal::record_run(state.plan(source, options.series), recording, lock,
                                                           state.observer, state.stop, state.costs);
    if (!end.errors.empty()) throw internal::exception_of(end.errors);
    return end.kind == internal::RecordedEnd::Kind::complete;
  });
}

void Screen::cancel() noexcept {
  state_->stop.no_more = true;
  state_->stop.drop = true;
}

std::span<const Acceleration> Screen::accelerations() const noexcept { return state_->accelerations; }

}  // namespace holdfast
