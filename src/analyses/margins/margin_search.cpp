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
class Bracket {
 public:
  void take(int size, const std::optional<Departure>& beyond) {
    if (!beyond) {
      held_.push_back(size);
      distance_ = std::clamp(2 * distance_, 1, kLargest);
    } else if (size < fails_) {
      fails_above_ = fails_;
      departure_above_ = departure_;
      fails_ = size;
      departure_ = *beyond;
      distance_ = 0;
    }
    holds_ = 0;
    for (const int known : held_)
      if (known < fails_) holds_ = std::max(holds_, known);
  }

  /// The acceleration to try next; nothing where the margin is found.
  std::optional<int> next() const {
    if (fails_ - holds_ <= 1) return unchecked();
    if (fails_ == kNone) return kLargest;
    if (distance_ == 0) return std::max(holds_ + 1, std::min(secant(), fails_ - 1));
    return std::min(holds_ + distance_, (holds_ + fails_) / 2);
  }

  double margin() const { return in_g(holds_); }
  /// The box that goes beyond first where the load just no longer holds; null where it holds all that is tried.
  const Departure* departure() const { return fails_ == kNone ? nullptr : &departure_; }

 private:
  static constexpr int kNone = kLargest + 1;

  /// Where boxes no longer go beyond, by the line through the two least accelerations that do not hold; through the
  /// least one alone as where a box slides. The last unit below, so that this holds and the next trial ends the search.
  int secant() const {
    if (departure_.acceleration <= 0.0) return (holds_ + fails_) / 2;
    const double rise = departure_above_.acceleration - departure_.acceleration;
    const double slope = fails_above_ < kNone && rise > 0.0 ? rise / in_g(fails_above_ - fails_) : 1.0;
    return static_cast<int>(std::floor(fails_ - departure_.acceleration / slope * kMarginUnits));
  }

  /// A share of the margin that has not been tried; nothing when all have.
  std::optional<int> unchecked() const {
    for (const double share : kMarginChecks) {
      const auto wanted = static_cast<int>(std::lround(share * holds_));
      const auto is_it = [&](int known) { return std::abs(known - wanted) <= 1; };
      if (wanted > 0 && std::none_of(held_.begin(), held_.end(), is_it)) return wanted;
    }
    return std::nullopt;
  }

  int holds_ = 0;
  int fails_ = kNone;
  Departure departure_;        ///< at `fails_`
  int fails_above_ = kNone;    ///< the next larger one that is known not to hold
  Departure departure_above_;  ///< there
  int distance_ = 0;           ///< of the next trial above one that holds; 0: the last trial did not hold
  std::vector<int> held_;      ///< all that are known to hold
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

  /// @param first, last directions that are searched, with both ends
  std::optional<LayoutMargins> run(std::size_t first, std::size_t last) {
    if (const std::optional<Departure> unstable = settle()) {
      for (auto* margin : {&margins_.margin, &margins_.margin_within_limits})
        margin->fill(-std::clamp(unstable->acceleration, in_g(1), 1.0));
      for (auto* box : {&margins_.critical_box, &margins_.critical_box_within_limits}) box->fill(id_of(unstable->box));
      return margins_;
    }
    if (aborted()) return std::nullopt;
    simulation_->mark(0);
    start_ = batch_.state;
    for (std::size_t direction = first; direction <= last; ++direction) {
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

  /// What is tried for the margin within the limits comes first, since a load that is followed that far has left its
  /// place on the way.
  void search(std::size_t direction) {
    std::array<Bracket, kinds> brackets;
    for (;;) {
      Kind kind = within_limits;
      std::optional<int> wanted = brackets[kind].next();
      if (!wanted) wanted = brackets[kind = in_place].next();
      if (!wanted) break;
      const Trial trial = run_trial(push_acceleration(direction, in_g(*wanted)), kind);
      if (aborted()) return;
      brackets[in_place].take(*wanted, trial[in_place]);
      // A load that leaves its place has not been followed any further.
      if (kind == within_limits || !trial[in_place] || trial[within_limits])
        brackets[within_limits].take(*wanted, trial[within_limits]);
    }
    const auto critical = [&](Kind kind) {
      const Departure* departure = brackets.at(kind).departure();
      return departure == nullptr ? 0 : id_of(departure->box);
    };
    margins_.margin.at(direction) = brackets[in_place].margin();
    margins_.margin_within_limits.at(direction) = brackets[within_limits].margin();
    margins_.critical_box.at(direction) = critical(in_place);
    margins_.critical_box_within_limits.at(direction) = critical(within_limits);
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

std::optional<LayoutMargins> search_directions(std::size_t first, std::size_t last, const Engine& engine,
                                               const Layout& layout, const Settings& settings,
                                               const std::atomic<bool>& abort) {
  const Acceleration gravity = gravity_alone();
  WorldBatch batch;
  append_world(batch, layout, gravity, settings);
  return MarginSearch(engine, batch, settings, abort).run(first, last);
}

}  // namespace

std::optional<LayoutMargins> find_margins(const Engine& engine, const Layout& layout, const Settings& settings,
                                          const std::atomic<bool>& abort) {
  return search_directions(0, kDirectionCount - 1, engine, layout, settings, abort);
}

std::optional<LayoutMargins> find_margin(std::size_t direction, const Engine& engine, const Layout& layout,
                                         const Settings& settings, const std::atomic<bool>& abort) {
  return search_directions(direction, direction, engine, layout, settings, abort);
}

}  // namespace holdfast::internal
