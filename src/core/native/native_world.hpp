#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "core/engine/engine.hpp"
#include "core/native/step_transaction.hpp"
#include "core/native/world_invariants.hpp"
#include "core/native/world_memory.hpp"
#include "core/native/world_state.hpp"

namespace holdfast::internal::native {

/// One container world: islands of boxes, of which only those that move are stepped.
class NativeWorld {
 public:
  NativeWorld(const WorldBatch& batch, const World& world, const Settings& settings, const NativeOptions& options,
              std::unique_ptr<WorldMemory> memory);
  NativeWorld(const NativeWorld&) = delete;
  NativeWorld& operator=(const NativeWorld&) = delete;

  /// Ends the world, and returns the memory that it was given.
  std::unique_ptr<WorldMemory> release_memory();

  /// Takes the next step inside the phase, or all of them when nothing moves. Returns the time reached, s.
  double advance(const Phase& phase);

  /// Remembers where the world is, and takes it back to there, to begin a phase: all that it tells is as it was.
  void mark();
  void rewind();

  /// Changes what acts from now on; the next step begins a phase.
  void set_force(std::size_t box, const BoxForce& force);
  void set_friction(const ContactSettings& contact);

  /// True when every body was proved to rest in the last `advance`.
  bool rests() const { return rests_; }

  /// Writes the world's range of the columns.
  void read_back(StateColumns& state) const;

  /// Of the boxes on the sides in the last `advance`, where the settings ask for wall forces.
  const SideImpulses& side_impulses() const { return state_.scene.side_forces.sum(); }

  /// The world as `broken_invariants` checks it, which debug builds do after every step.
  WorldView view() const { return {state_.scene, state_.contacts.pairs(), state_.islands}; }

  const Counters& counters() const { return counters_; }
  Status status() const { return status_; }

 private:
  void begin_anew();
  bool follows_pushes(const Phase& phase, double slow) const;
  Phase next_part(const Phase& phase) const;
  void begin_phase(const Phase& phase);
  void find_farther_contacts(const Vec3& acceleration);
  double take_next_step(const Phase& phase);
  void let_sleep();

  const World& world_;
  NativeOptions options_;
  Vec3 gravity_;
  std::unique_ptr<WorldMemory> memory_;
  WorldState state_;
  Counters counters_;
  Status status_ = Status::ok;
  StepTransaction step_;

  /// Where the world was when it was marked; its manifolds are `WorldMemory::marked`.
  struct Mark {
    WorldState state;
    Counters counters;
    Status status;
    bool rests;
  };
  std::optional<Mark> mark_;

  bool rests_ = false;
  bool disturbed_ = false;             ///< a force or a coefficient has changed since the last step
  double reached_ = 0.0;               ///< time of the world; before the phase: it begins anew, s
  std::optional<double> phase_begin_;  ///< of the phase that is under way, s
  std::uint64_t phase_step_ = 0;
};

}  // namespace holdfast::internal::native
