#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/native/island/island_stepper.hpp"
#include "core/native/world_state.hpp"

namespace holdfast::internal::native {

/// Takes steps of a world whose moving bodies are known: its islands one after the other, merged where they meet. A
/// step is accepted, or taken again from its start by those islands that have failed: with the contacts that have shown
/// too late, and in two halves where that does not help.
class StepTransaction {
 public:
  /// @param world,stepper,counters,status have to outlive this
  StepTransaction(WorldState& world, IslandStepper& stepper, const NativeOptions& options, Counters& counters,
                  Status& status);

  /// Takes overlaps out of the islands that move.
  void correct_positions();

  /// Takes a step.
  /// @param step length, s
  void take(double step);

 private:
  /// What a step begins from, to take it again.
  struct Start {
    StateColumns state;
    std::vector<LastStep> last_step;
    std::vector<Activity> activity;
    SideImpulses side_impulses;
  };

  void save(const IslandView& island);
  void restore(std::size_t body);
  Start start_of_step() const;
  void go_back(const Start& start);

  void attempt(double step, int halvings, int attempts);
  bool activate_predicted();
  void spread_motion();
  void step_islands();
  bool merge_overlapping();
  bool spread_failure();
  void retake(double step, int halvings, int attempts);
  bool overlap_with(const std::vector<std::uint8_t>& done) const;
  void accept(const std::vector<std::uint8_t>& moved);
  double residual_of(std::size_t body) const;
  bool moves(const IslandView& island) const;

  WorldState& world_;
  Scene& scene_;
  IslandStepper& stepper_;
  NativeOptions options_;
  Counters& counters_;
  Status& status_;
  double unit_ = 1.0;                            ///< |g − a| times the whole step, m/s
  StateColumns before_;                          ///< at the start of the step, entries of moving bodies
  std::vector<LastStep> before_last_step_;       ///< likewise
  std::vector<IslandReport> reports_;            ///< a moving body: of its island's step
  std::vector<std::uint8_t> failed_;             ///< a body: its island has to take the step again
  std::vector<std::uint8_t> unsolved_;           ///< a body: a solve of its island has failed in this step
  std::vector<std::uint8_t> merged_, restored_;  ///< an island, a body: put back to the start of the step
};

}  // namespace holdfast::internal::native
