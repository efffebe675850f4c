#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analyses/analysis.hpp"
#include "api/convert.hpp"
#include "api/memory_run.hpp"
#include "core/engine/engine.hpp"
#include "core/engine/engine_support.hpp"
#include "core/engine/run_inputs.hpp"
#include "core/engine/run_observer.hpp"
#include "core/model/settings.hpp"
#include "holdfast/holdfast.hpp"
#include "parallel/schedulers/workers.hpp"
#include "parallel/screening/screening.hpp"
#include "parallel/screening/stage_costs.hpp"
#include "parallel/screening/world_stream.hpp"

namespace holdfast {

/// What a screen consists of.
struct Screen::State {
  explicit State(const ScreenOptions& given);
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State();

  void add(Acceleration acceleration);

  /// The layouts of a call, which fill `problems`. Throws when one cannot be used and that is to be an error.
  /// @param first index of the first one, for messages
  template <class AnyLayout>
  std::vector<internal::ReadLayout> read(std::span<const AnyLayout> layouts, std::uint64_t first = 0) {
    problems.clear();
    std::vector<internal::ReadLayout> read;
    read.reserve(layouts.size());
    for (std::size_t i = 0; i < layouts.size(); ++i) {
      std::vector<internal::Error> errors;
      const std::string name = name_of(layouts[i].name, first + i);
      read.push_back(internal::read_layout(layouts[i], name, options.unit, settings, errors));
      if (auto unsupported = internal::refuse_unsupported(read.back(), *engine, name))
        errors.push_back(std::move(*unsupported));
      note(errors, i);
    }
    if (options.bad_layouts == BadLayouts::raise && !problems.empty()) throw Error(problems);
    return read;
  }

  internal::ScreeningPlan plan(internal::LayoutSource& layouts, bool series) {
    return {*engine, settings, *workers, layouts, read_accelerations, series, methods_of(analyses)};
  }

  void evaluate(std::vector<internal::ReadLayout> layouts, std::vector<WorldOutcome>& worlds);
  std::vector<bool> holds(std::vector<internal::ReadLayout> layouts);
  std::vector<LayoutMargins> margins(std::vector<internal::ReadLayout> layouts);
  bool record(std::vector<internal::ReadLayout> layouts, const std::string& path, const RecordOptions& record_options);

  /// A `cancel` that comes before a call does nothing to it, unless the screen is closed.
  void forget_cancel() {
    stop.no_more = false;
    stop.drop = false;
    // After that: who closes the screen sets this first, so that one of the two sees the other.
    if (closed) cancel();
  }

  /// Ends the running call early.
  void cancel() {
    stop.no_more = true;
    stop.drop = true;
  }

  /// Throws when there are none.
  void need_accelerations() const;

  /// The layouts in flight; in a process that was forked since, a stream of its own, with nothing in flight.
  internal::WorldStream& stream();
  bool has_room();
  std::uint64_t submit(std::vector<internal::ReadLayout> layout);

  ScreenOptions options;
  internal::Settings settings;
  std::vector<Acceleration> accelerations;
  std::vector<internal::ReadAcceleration> read_accelerations;
  std::unique_ptr<internal::Engine> engine;
  std::optional<internal::Workers> workers;
  std::optional<internal::WorldTaker> taker;
  std::vector<const internal::Analysis*> analyses;  ///< that the settings ask for
  internal::AnalysisMethods world_analyses;         ///< those of worlds alone
  internal::StopRequest stop;
  std::atomic<bool> closed = false;  ///< the running call ends early, and all that follow
  internal::StageCosts costs;
  internal::RunObserver observer;
  std::vector<Problem> problems;  ///< of the layouts of the last call
  /// Of the layouts that `holds` was asked for: in which order they are tried changes no answer.
  std::optional<internal::FailureOrder> failures;
  std::unique_ptr<internal::WorldStream> world_stream;
  std::uint64_t next_ticket = 0;

 private:
  static std::string name_of(std::string_view name, std::uint64_t index) {
    return name.empty() ? "layout " + std::to_string(index) : std::string(name);
  }
  void note(const std::vector<internal::Error>& errors, std::size_t layout);
  std::unique_ptr<internal::WorldStream> make_stream() const;
};

}  // namespace holdfast
