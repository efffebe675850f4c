#include "analyses/margins/margin_search.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "core/model/world.hpp"

namespace holdfast::internal {

namespace {

/// A box that has this acceleration is too far away just when the patience ends, g.
constexpr double kLeastAcceleration =
    2.0 * kMarginDisplacement / (kMarginPatience * kMarginPatience * kStandardGravity);

/// What became of the load under one acceleration.
struct Trial {
  bool holds = false;
  std::size_t box = 0;        ///< where it does not hold: the box that is farthest from where it was
  double acceleration = 0.0;  ///< of that box, on the average, g; 0 where none went far and some still move
};

class MarginSearch {
 public:
  MarginSearch(const Engine& engine, WorldBatch& batch, const std::atomic<bool>& abort)
      : batch_(batch), abort_(abort), simulation_(engine.build(batch)), start_(batch.state) {}

  std::optional<LayoutMargins> run() {
    const Trial gravity = run_trial(Vec3::Zero());
    if (aborted()) return std::nullopt;
    if (!gravity.holds) {
      margins_.margin.fill(-std::clamp(gravity.acceleration, kLeastAcceleration, 1.0));
      margins_.critical_box.fill(id_of(gravity.box));
      return margins_;
    }
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

  void search(std::size_t direction) {
    double holds = 0.0;
    double fails = kLargestMargin;
    double wanted = 0.5 * kLargestMargin;
    double stride = kMarginWidth;
    bool any_failed = false;
    // The largest acceleration is not known to fail before it is tried.
    while ((!any_failed && holds < kLargestMargin) || (any_failed && fails - holds > kMarginWidth)) {
      const Trial trial = run_trial(push_acceleration(direction, wanted));
      if (aborted()) return;
      if (!trial.holds) {
        any_failed = true;
        fails = wanted;
        margins_.critical_box.at(direction) = id_of(trial.box);
        stride = kMarginWidth;
        // As far below the estimate as the bracket is to be wide, so that this holds and the next one ends the search.
        wanted = fails - trial.acceleration - 0.5 * kMarginWidth;
        if (trial.acceleration == 0.0 || wanted <= holds || wanted > fails - 0.5 * kMarginWidth)
          wanted = 0.5 * (holds + fails);
      } else {
        holds = wanted;
        wanted = any_failed ? std::min(holds + stride, 0.5 * (holds + fails)) : kLargestMargin;
        if (any_failed && fails - holds <= 2.0 * kMarginWidth) wanted = 0.5 * (holds + fails);
        stride *= 2.0;
      }
    }
    margins_.margin.at(direction) = holds;
  }

  /// Applies a constant acceleration of the container to the load where it was marked; leaves the batch at the end.
  Trial run_trial(const Vec3& acceleration) {
    if (margins_.trials++ > 0) simulation_->rewind(0);
    const Phase phase{0.0, kMarginPatience, acceleration};
    AdvanceRequest request{0, phase, 0.0};
    while (request.reached < phase.end) {
      if (aborted()) return {};
      request.output_time = request.reached;
      simulation_->advance({&request, 1});
      simulation_->read_back(0, batch_.state);
      if (const std::optional<Trial> failure = find_departure(request.reached)) return *failure;
    }
    return {.holds = is_at_rest()};
  }

  /// The box that is farthest from where it was, if it is too far.
  std::optional<Trial> find_departure(double time) const {
    const std::vector<Vec3>& now = batch_.state.position;
    Trial trial;
    double farthest = kMarginDisplacement;
    for (std::size_t box = 0; box < now.size(); ++box) {
      const double distance = (now[box] - start_.position[box]).norm();
      if (!std::isfinite(distance)) return Trial{.box = box};
      if (distance <= farthest) continue;
      farthest = distance;
      trial.box = box;
      trial.acceleration = 2.0 * distance / (time * time) / kStandardGravity;
    }
    if (trial.acceleration == 0.0) return std::nullopt;
    return trial;
  }

  bool is_at_rest() const {
    const auto none = [](const Vec3& v) { return v == Vec3::Zero(); };
    const StateColumns& state = batch_.state;
    return std::all_of(state.velocity.begin(), state.velocity.end(), none) &&
           std::all_of(state.angular_velocity.begin(), state.angular_velocity.end(), none);
  }

  WorldBatch& batch_;
  const std::atomic<bool>& abort_;
  std::unique_ptr<Simulation> simulation_;
  StateColumns start_;  ///< where a trial begins
  LayoutMargins margins_;
};

}  // namespace

std::optional<LayoutMargins> find_margins(const Engine& engine, const Layout& layout, const Settings& settings,
                                          const std::atomic<bool>& abort) {
  // What engines take from it is how strong accelerations may become.
  Acceleration strongest;
  strongest.segments.push_back({0.0, kMarginPatience, push_acceleration(0, kLargestMargin)});
  const Layout* const layouts[] = {&layout};
  const Acceleration* const accelerations[] = {&strongest};
  WorldBatch batch = make_batch(layouts, accelerations, settings);
  return MarginSearch(engine, batch, abort).run();
}

}  // namespace holdfast::internal
