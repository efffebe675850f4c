#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include "api/apply_settings.hpp"
#include "api/engine_loader.hpp"
#include "api/guarded.hpp"
#include "api/memory_run.hpp"
#include "api/screen_closer.hpp"
#include "api/screen_state.hpp"
#include "core/engine/series_recorder.hpp"
#include "core/model/norms.hpp"
#include "holdfast/holdfast.hpp"
#include "io/input/config_reader.hpp"
#include "io/input/layout_reader.hpp"
#include "io/input/text_file.hpp"
#include "parallel/schedulers/scheduler.hpp"
#include "parallel/screening/world_limits.hpp"

namespace holdfast {

using internal::guarded;
using internal::value_or_throw;

namespace {

internal::Settings settings_of(const ScreenOptions& options) {
  std::vector<internal::Error> ignored;
  const internal::TextFile text{.path = "config", .name = "config", .text = options.config};
  internal::Config config = value_or_throw(internal::parse_config(text, ignored));
  internal::apply_settings(config, options.settings);
  internal::Settings& settings = config.settings;
  if (options.norm)
    settings.screening.norm = options.norm->empty() ? "" : value_or_throw(internal::find_norm(*options.norm)).name();
  if (options.engine) internal::apply_setting(settings, {"Screening", "Engine", *options.engine});
  if (options.scheduler) internal::apply_setting(settings, {"Screening", "Scheduler", *options.scheduler});
  if (options.stop_when) internal::apply_setting(settings, {"Screening", "StopWhen", *options.stop_when});
  settings.screening.first_failure = options.first_failure.value_or(settings.screening.first_failure);
  if (options.threads) internal::apply_setting(settings, {"Screening", "Threads", std::to_string(*options.threads)});
  if (const auto error = internal::why_not_built(settings.screening.scheduler)) throw internal::exception_of({*error});
  if (options.accuracy) {
    if (const auto error = internal::set_accuracy(settings, *options.accuracy)) throw internal::exception_of({*error});
  }
  return settings;
}

}  // namespace

Screen::State::State(const ScreenOptions& given) : options(given), settings(settings_of(given)) {
  engine = value_or_throw(internal::make_engine(settings.screening.engine, settings));
  workers.emplace(settings.screening.scheduler, settings.screening.threads);
  taker.emplace(internal::recording_plan(settings, false).thresholds, options.keep_boxes);
  analyses = internal::analyses_of(settings);
  for (const internal::AnalysisMethod* method : internal::methods_of(analyses))
    if (method->of_layout == nullptr) world_analyses.push_back(method);
  world_stream = make_stream();
  if (settings.screening.norm.empty()) return;
  for (Acceleration& acceleration : norm_accelerations(settings.screening.norm)) add(std::move(acceleration));
}

Screen::State::~State() {
  if (world_stream->is_of_parent()) static_cast<void>(world_stream.release());
}

void Screen::State::add(Acceleration acceleration) {
  if (stream().in_flight() > 0)
    throw internal::exception_of(
        {{.file = acceleration.name, .what = "an acceleration cannot be added while layouts are in flight"}});
  internal::Acceleration read = value_or_throw(internal::read_acceleration(acceleration));
  if (const auto error = internal::check_steps(acceleration.name, read, settings, engine->traits().steps_per_second))
    throw internal::exception_of({*error});
  failures.reset();
  read_accelerations.push_back({std::move(read), ""});
  accelerations.push_back(std::move(acceleration));
}

void Screen::State::need_accelerations() const {
  if (accelerations.empty())
    throw internal::exception_of({{.what = "a screen needs at least one acceleration", .accepted = "or a norm"}});
}

void Screen::State::note(const std::vector<internal::Error>& errors, std::size_t layout) {
  for (const internal::Error& error : errors) {
    problems.push_back(internal::problem_of(error));
    problems.back().layout = static_cast<std::ptrdiff_t>(layout);
  }
}

void Screen::State::evaluate(std::vector<internal::ReadLayout> layouts, std::vector<WorldOutcome>& worlds) {
  need_accelerations();
  const std::size_t count = accelerations.size();
  worlds.resize(layouts.size() * count);
  for (std::size_t i = 0; i < worlds.size(); ++i)
    taker->take({.row = {.layout = i / count, .acceleration = i % count}}, worlds[i]);
  if (worlds.empty()) return;
  internal::MemoryLayouts source(std::move(layouts));
  internal::MemorySink sink(worlds, count, *taker);
  internal::ScreeningPlan verdicts_alone = plan(source, options.keep_series);
  verdicts_alone.analyses = world_analyses;
  const internal::ScreeningEnd end = internal::screen_worlds(verdicts_alone, sink, observer, stop, costs);
  if (end.error) throw internal::exception_of({*end.error});
  for (WorldOutcome& world : worlds) internal::mark_cancelled(world);
}

std::vector<bool> Screen::State::holds(std::vector<internal::ReadLayout> layouts) {
  need_accelerations();
  internal::Settings early = settings;
  early.screening.stop_when = internal::StopWhen::moved;
  early.screening.first_failure = true;
  const std::size_t count = accelerations.size();
  std::vector<WorldOutcome> worlds(layouts.size() * count);
  if (worlds.empty()) return {};
  internal::MemoryLayouts source(std::move(layouts));
  const internal::WorldTaker verdicts_alone(internal::recording_plan(settings, false).thresholds, false);
  internal::MemorySink sink(worlds, count, verdicts_alone);
  internal::ScreeningPlan plan{*engine, early, *workers, source, read_accelerations, false};
  if (failures) plan.failures = failures->for_next_run();
  const internal::ScreeningEnd end = internal::screen_worlds(plan, sink, observer, stop, costs);
  if (end.error) throw internal::exception_of({*end.error});
  if (!failures) failures.emplace(count, engine->traits());
  for (std::size_t i = 0; i < worlds.size(); ++i)
    if (internal::rejects(worlds[i].verdict)) failures->count_rejection(i % count);
  std::vector<bool> holds;
  for (auto layout = worlds.begin(); layout != worlds.end(); layout += static_cast<std::ptrdiff_t>(count))
    holds.push_back(std::all_of(layout, layout + static_cast<std::ptrdiff_t>(count),
                                [](const WorldOutcome& world) { return world.verdict == Verdict::stayed; }));
  return holds;
}

Screen::Screen(std::vector<Acceleration> accelerations, const ScreenOptions& options) {
  guarded([&] {
    state_ = std::make_unique<State>(options);
    if (accelerations.empty()) state_->need_accelerations();
    for (Acceleration& acceleration : accelerations) state_->add(std::move(acceleration));
  });
}

Screen::Screen(const ScreenOptions& options) {
  guarded([&] { state_ = std::make_unique<State>(options); });
}

Screen::~Screen() = default;
Screen::Screen(Screen&&) noexcept = default;
Screen& Screen::operator=(Screen&&) noexcept = default;

void Screen::add_acceleration(Acceleration acceleration) {
  guarded([&] { state_->add(std::move(acceleration)); });
}

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
    state_->forget_cancel();
    state_->evaluate(state_->read(layouts), worlds);
  });
}

void Screen::evaluate(std::span<const LayoutView> layouts, std::vector<WorldOutcome>& worlds) {
  guarded([&] {
    state_->forget_cancel();
    state_->evaluate(state_->read(layouts), worlds);
  });
}

std::vector<bool> Screen::holds(std::span<const Layout> layouts) {
  return guarded([&] {
    state_->forget_cancel();
    return state_->holds(state_->read(layouts));
  });
}

std::vector<bool> Screen::holds(std::span<const LayoutView> layouts) {
  return guarded([&] {
    state_->forget_cancel();
    return state_->holds(state_->read(layouts));
  });
}

void Screen::cancel() noexcept {
  state_->cancel();
  state_->world_stream->cancel();
}

bool Screen::cancelled() const noexcept { return state_->stop.drop; }

void internal::ScreenCloser::close(Screen& screen) noexcept {
  screen.state_->closed = true;
  screen.cancel();
}

std::span<const Acceleration> Screen::accelerations() const noexcept { return state_->accelerations; }

std::span<const Problem> Screen::problems() const noexcept { return state_->problems; }

}  // namespace holdfast
