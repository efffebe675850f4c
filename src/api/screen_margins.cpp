#include <utility>
#include <vector>

#include "analyses/margins/margins.hpp"
#include "api/guarded.hpp"
#include "api/memory_run.hpp"
#include "api/screen_state.hpp"
#include "holdfast/holdfast.hpp"

namespace holdfast {

namespace {

/// Takes the margins of layouts, and drops their worlds.
class MarginSink final : public internal::ResultSink {
 public:
  explicit MarginSink(std::vector<LayoutMargins>& margins) : margins_(margins) {}

  std::unique_ptr<internal::SinkUnit> place(internal::UnitRecord& unit) override {
    for (const internal::LayoutRecord& layout : unit.layouts) margins_[layout.index] = public_margins(layout.found);
    return std::make_unique<internal::DoneUnit>();
  }

  static LayoutMargins public_margins(const internal::Findings& findings) {
    const auto& found = findings.value<internal::LayoutMargins>();
    const auto& spread = findings.value<internal::MarginSpread>();
    return {.margin = found.margin,
            .critical_box = found.critical_box,
            .margin_within_limits = found.margin_within_limits,
            .critical_box_within_limits = found.critical_box_within_limits,
            .trials = found.trials,
            .cpu_seconds = found.cpu_seconds + spread.cpu_seconds,
            .spread = {spread.low, spread.median, spread.high}};
  }

 private:
  std::vector<LayoutMargins>& margins_;
};

}  // namespace

std::vector<LayoutMargins> Screen::State::margins(std::vector<internal::ReadLayout> layouts) {
  if (const auto error = internal::kMargins.why_not(*engine, settings)) throw internal::exception_of({*error});
  std::vector<LayoutMargins> margins(layouts.size());
  for (LayoutMargins& unknown : margins) unknown = MarginSink::public_margins({});
  internal::MemoryLayouts source(std::move(layouts));
  MarginSink sink(margins);
  const std::vector<internal::ReadAcceleration> gravity = {{internal::gravity_alone(), ""}};
  internal::AnalysisMethods methods = {&internal::kMargins.method};
  if (settings.screening.replicas > 0) methods.push_back(&internal::kMarginSpread.method);
  const internal::ScreeningEnd end = internal::screen_worlds(
      {*engine, settings, *workers, source, gravity, false, methods}, sink, observer, stop, costs);
  if (end.error) throw internal::exception_of({*end.error});
  return margins;
}

std::vector<LayoutMargins> Screen::margins(std::span<const Layout> layouts) {
  return internal::guarded([&] {
    state_->forget_cancel();
    return state_->margins(state_->read(layouts));
  });
}

std::vector<LayoutMargins> Screen::margins(std::span<const LayoutView> layouts) {
  return internal::guarded([&] {
    state_->forget_cancel();
    return state_->margins(state_->read(layouts));
  });
}

}  // namespace holdfast
