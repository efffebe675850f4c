#include "analyses/margins/margin_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "core/engine/journey.hpp"
#include "core/engine/series_recorder.hpp"
#include "core/model/verdict.hpp"
#include "core/model/world.hpp"

namespace holdfast::internal {

namespace {

/// What a margin is within.
enum Kind : std::size_t { in_place, within_limits, kinds };

/// A box that goes beyond.
struct Departure {
  std::size_t box = 0;
  double acceleration = 0.0;  ///< with which it has gone, on the average, g; 0 where that is not known
};

/// What became of the load under one acceleration: of each kind the first departure, if there is one.
using Trial = std::array<std::optional<Departure>, kinds>;

/// Accelerations are tried in whole units of a 200th of g, so that 0.5 g and what else norms ask for is among them.
constexpr int kLargest = static_cast<int>(kLargestMargin * kMarginUnits);
constexpr double in_g(int units) { return units / kMarginUnits; }

/// Accelerations of one kind in one direction, in units: the least one that is known not to hold, and the largest one
/// below it that is known to hold. A load that holds a larger one has found its hold on the way, and no load has to get
/// there.
struct Bracket {
  static constexpr int kNone = kLargest + 1;

  int holds = 0;
  int fails = kNone;
  Departure departure;    ///< at `fails`
  std::vector<int> held;  ///< all that are known to hold

  void take(int size, const std::optional<Departure>& beyond) {
    if (!beyond) held.push_back(size);
    if (beyond && size < fails) {
      fails = size;
      departure = *beyond;
    }
    holds = 0;
    for (const int known : held)
      if (known < fails) holds = std::max(holds, known);
  }
  bool is_closed() const { return fails - holds <= 1; }

  /// A share of the margin that has not been tried; nothing when all have.
  std::optional<int> unchecked() const {
    for (const double share : kMarginChecks) {
      const auto wanted = static_cast<int>(std::lround(share * holds));
      const auto is_it = [&](int known) { return std::abs(known - wanted) <= 1; };
      if (wanted > 0 && std::none_of(held.begin(), held.end(), is_it)) return wanted;
    }
    return std::nullopt;
  }
};

class MarginSearch {
 public:
  MarginSearch(const Engine& engine, WorldBatch& batch, const Settings& settings, const std::atomic<bool>& abort)
      : batch_(batch),
        settings_(settings),
        abort_(abort),
        limits_(recording_plan(settings, false).thresholds),
        simulation_(engine.build(batch)),
        start_(batch.state),
        journey_(engine, *batch.worlds.front().acceleration, settings) {}

  std::optional<LayoutMargins> run() {
    if (const std::optional<Departure> unstable = settle()) {
      for (auto* margin : {&margins_.margin, &margins_.margin_within_limits})
        margin->fill(-std::clamp(unstable->acceleration, in_g(1), 1.0));
      for (auto* box : {&margins_.critical_box, &margins_.critical_box_within_limits}) box->fill(id_of(unstable->box));
      return margins_;
    }
    if (aborted()) return std::nullopt;
    simulation_->mark(0);
    start_ = batch_.state;
    for (std::size_t direction = 0; direction < kDirectionCount; ++direction) {
      search(direction);
      if (aborted()) return std::nullopt;
    }
    return margins_;
  }

 private:
  static std::uint32_t id_of(std::size_t box) { return static_cast<std::uint32_t>(box + 1); }

  bool aborted() const { return abort_.load(std::memory_order_relaxed); }

  /// Gravity alone until the load rests. The box that goes beyond a limit, if one does.
  std::optional<Departure> settle() {
    const double begin = journey_.time();
    while (journey_.settles()) {
      if (aborted()) return std::nullopt;
      const double reached = step(journey_.phase());
      if (const auto beyond = find_departure(within_limits, reached - begin)) return beyond;
      journey_.reach(reached, simulation_->rests(0),
                     is_quiet(view(batch_.state, batch_.worlds.front()), settings_.sleeping_threshold));
    }
    return std::nullopt;
  }

  void search(std::size_t direction) {
    std::array<Bracket, kinds> brackets;
    for (const Kind kind : {in_place, within_limits}) {
      Bracket& bracket = brackets.at(kind);
      int stride = 1;
      // The other kind's trials may have closed it, or told where to look.
      int wanted = kLargest;
      if (kind == in_place) wanted = kLargest / 2;
      if (kind == within_limits && bracket.fails <= kLargest) wanted = next_below(bracket);
      for (;;) {
        if (bracket.is_closed()) {
          const std::optional<int> unchecked = bracket.unchecked();
          if (!unchecked) break;
          wanted = *unchecked;
        }
        const Trial trial = run_trial(push_acceleration(direction, in_g(wanted)), kind);
        if (aborted()) return;
        brackets[in_place].take(wanted, trial[in_place]);
        // A load that leaves its place has not been followed any further.
        if (kind == within_limits || !trial[in_place] || trial[within_limits])
          brackets[within_limits].take(wanted, trial[within_limits]);
        if (trial.at(kind)) {
          stride = 1;
          wanted = next_below(bracket);
        } else if (bracket.fails == Bracket::kNone) {
          wanted = kLargest;
        } else {
          wanted = std::min(bracket.holds + stride, (bracket.holds + bracket.fails) / 2);
          stride *= 2;
        }
      }
    }
    margins_.margin.at(direction) = in_g(brackets[in_place].holds);
    margins_.margin_within_limits.at(direction) = in_g(brackets[within_limits].holds);
    if (brackets[in_place].fails != Bracket::kNone)
      margins_.critical_box.at(direction) = id_of(brackets[in_place].departure.box);
    if (brackets[within_limits].fails != Bracket::kNone)
      margins_.critical_box_within_limits.at(direction) = id_of(brackets[within_limits].departure.box);
  }

  /// Where the margin is by the departure at the upper end of the bracket: the last unit below, so that this holds and
  /// the next trial ends the search. The middle where the departure tells nothing.
  static int next_below(const Bracket& bracket) {
    const double wanted = std::floor(bracket.fails - bracket.departure.acceleration * kMarginUnits);
    const bool usable = bracket.departure.acceleration > 0.0 && wanted > bracket.holds && wanted < bracket.fails;
    return usable ? static_cast<int>(wanted) : (bracket.holds + bracket.fails) / 2;
  }

  double step(const Phase& phase) {
    AdvanceRequest request{0, phase};
    simulation_->advance({&request, 1});
    simulation_->read_back(0, batch_.state);
    return request.reached;
  }

  /// Applies a constant acceleration of the container to the load where it was marked, until a box goes beyond what the
  /// kind allows; leaves the batch at the end.
  Trial run_trial(const Vec3& acceleration, Kind kind) {
    ++margins_.trials;
    simulation_->rewind(0);
    const Phase phase{0.0, kMarginDuration, acceleration};
    Trial trial;
    for (double reached = 0.0; reached < phase.end;) {
      if (aborted()) return trial;
      reached = step(phase);
      if (simulation_->rests(0)) break;
      for (const Kind each : {in_place, within_limits})
        if (!trial.at(each)) trial.at(each) = find_departure(each, reached);
      if (trial.at(kind)) break;
    }
    return trial;
  }

  /// The first box that is beyond what the kind allows, if any is, and how the farthest one has got there.
  /// @param time since it was at its start, s
  std::optional<Departure> find_departure(Kind kind, double time) const {
    const StateColumns& now = batch_.state;
    std::optional<Departure> departure;
    double farthest = 0.0;
    for (std::size_t box = 0; box < now.position.size(); ++box) {
      const Vec3 moved_by = now.position[box] - start_.position[box];
      if (!moved_by.allFinite()) return Departure{.box = box};
      const double distance = moved_by.norm();
      const Rotation turn = now.orientation[box] * start_.orientation[box].conjugate();
      const bool beyond =
          kind == in_place
              ? distance > kMarginDisplacement
              : is_beyond({static_cast<float>(distance), static_cast<float>(-moved_by.z()), tilt_of(turn)}, limits_);
      if (!beyond) continue;
      if (!departure) departure = Departure{.box = box};
      farthest = std::max(farthest, distance);
    }
    if (departure) departure->acceleration = 2.0 * farthest / (time * time) / kStandardGravity;
    return departure;
  }

  WorldBatch& batch_;
  const Settings& settings_;
  const std::atomic<bool>& abort_;
  Thresholds limits_;
  std::unique_ptr<Simulation> simulation_;
  StateColumns start_;  ///< where a trial begins
  Journey journey_;
  LayoutMargins margins_;
};

}  // namespace

std::optional<LayoutMargins> find_margins(const Engine& engine, const Layout& layout, const Settings& settings,
                                          const std::atomic<bool>& abort) {
  const Acceleration gravity = gravity_alone();
  WorldBatch batch;
  append_world(batch, layout, gravity, settings);
  return MarginSearch(engine, batch, settings, abort).run();
}

}  // namespace holdfast::internal
