#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "core/engine/engine.hpp"
#include "core/native/collision/broad_phase.hpp"
#include "core/native/collision/pair_table.hpp"
#include "core/native/connectivity.hpp"
#include "core/native/sleeping_bodies.hpp"
#include "core/native/world_invariants.hpp"
#include "core/native/world_memory.hpp"

namespace holdfast::internal::native {

/// One container world: islands of boxes, of which only those that move are stepped.
class NativeWorld {
 public:
  NativeWorld(const WorldBatch& batch, const World& world, const Settings& settings, const NativeOptions& options,
              std::unique_ptr<WorldMemory> memory);

  /// Ends the world, and returns the memory that it was given.
  std::unique_ptr<WorldMemory> release_memory();

  /// Takes the next step inside the phase, or all of them when nothing moves. Returns the time reached, s.
  double advance(const Phase& phase);

  /// Remembers where the world is, and takes it back to there, to begin a phase.
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
  const SideImpulses& side_impulses() const { return side_impulses_; }

  /// The world as `broken_invariants` checks it, which debug builds do after every step.
  WorldView view() const { return {scene_, pairs_, connectivity_, resting_}; }

  const Counters& counters() const { return counters_; }
  Status status() const { return status_; }

 private:
  /// What a step begins from, to take it again.
  struct Start {
    StateColumns state;
    std::vector<std::pair<Vec3, Vec3>> acceleration;  ///< linear and angular, m/s², rad/s²
    SideImpulses side_impulses;
  };

  /// A contact that showed too late in a step, when its bodies overlapped already.
  struct LateContact {
    std::int32_t a, b;
    ContactSet contact;
    std::array<OrientedBox, 2> found_at;
  };

  /// A contact whose bodies may be flush, see `is_narrow`.
  struct NarrowContact {
    std::int32_t a, b;
    ContactSet contact;
  };

  void begin_anew();
  Phase next_part(const Phase& phase) const;
  void begin_phase(const Phase& phase);
  double fall_margin(double acceleration) const;
  void find_farther_contacts(const Vec3& acceleration);
  void find_contacts(const std::vector<std::uint8_t>& moved);
  void update_pair(std::int32_t a, std::int32_t b);
  void take_contact(std::int32_t a, std::int32_t b, const ContactSet& contact);
  void set_contact(std::int32_t a, std::int32_t b, std::int32_t known, const ContactSet& contact);
  void update_sides(std::size_t body, double margin);
  void set_surfaces(Manifold& manifold, const Vec3& normal) const;
  void turn_surfaces(Manifold& manifold, const Vec3& normal) const;
  void end_manifold(std::size_t index);
  void end_separated_from_sleeping();
  StepTerms terms_for(const IslandView& island) const;
  void reset_small_islands();
  bool find_moving();
  bool is_due(const IslandView& island);
  bool prove_rest(const IslandView& island, bool leans);
  bool activate_leaning();
  void set_at_rest(const IslandView& island);
  void find_resting_pushes(const IslandView& island);
  void save(const IslandView& island);
  void restore(std::size_t body);
  bool activate_predicted();
  bool merge_overlapping();
  void mark_failed(std::int32_t a, std::int32_t b);
  void mark_tunnelled(double step);
  void correct_positions();
  void spread_motion();
  void step_islands();
  double take_next_step(const Phase& phase);
  void set_step(double step);
  void take_step(double step, int halvings, int attempt = 0);
  void spread_failure();
  bool wake_what_jams();
  double residual_of(std::size_t body) const;
  void accept_moving();
  void accept_step(double step);
  void retake_step(double step, int halvings, int attempt);
  bool take_back_late_contacts();
  Start start_of_step() const;
  void go_back(const Start& start, const std::vector<std::uint8_t>& moving);
  bool overlaps_with(const std::vector<std::uint8_t>& done) const;
  void finish_step();
  void add_moving_pushes();
  void add_resting_pushes(double duration);
  void add_sleeping_pushes(double duration);
  void push_floor(const std::function<Vec3(std::size_t)>& impulse);

  const World& world_;
  NativeOptions options_;
  Vec3 gravity_;
  ContactSettings contact_;
  Scene scene_;
  StepTerms terms_;
  std::unique_ptr<WorldMemory> memory_;

  PairTable pairs_;  ///< the manifold of body or side a and body b; of two bodies a < b
  SleepingBodies sleeping_;
  std::vector<Vec3> left_;             ///< a body that sleeps: impulse that its contacts leave over in a step, N s
  std::vector<std::uint8_t> resting_;  ///< a body: proved to rest under this phase's acceleration
  std::vector<std::uint8_t> reset_;    ///< a body: where g − a has just changed, its last step is no guess
  std::vector<std::uint8_t> moving_;   ///< a body: stepped in this step; 2: put back to its start, to be stepped again
  std::vector<std::uint8_t> refuted_;  ///< a body: its proof of rest has failed in this step
  std::vector<std::uint8_t> undecided_;          ///< a body: whether it rests in this step is not known yet
  std::vector<std::uint32_t> wait_, next_wait_;  ///< a body: steps until rest is tried again, and the wait after that
  Connectivity connectivity_;
  BroadPhase broad_phase_;
  std::vector<std::uint8_t> near_sides_;  ///< a body that has moved: the sides that it is near, a bit each
  std::vector<Vec3> lower_, upper_;       ///< bounds of the bodies, grown by their speculative margins, m
  double whole_step_unit_ = 1.0;          ///< |g − a| times the phase's step, m/s
  std::vector<std::uint8_t> failed_;      ///< a body: its island has to take the step again
  std::vector<LateContact> late_contacts_;
  std::vector<NarrowContact> narrow_contacts_;
  std::vector<std::uint8_t> ahead_;  ///< a body: has taken the whole step, of which others take halves
  StateColumns before_;              ///< at the start of the step, entries of moving bodies
  std::vector<std::pair<Vec3, Vec3>> before_acceleration_;  ///< likewise, linear and angular, m/s², rad/s²
  std::vector<IslandReport> reports_;                       ///< a moving body: of its island's step
  std::vector<std::uint8_t> merged_, restored_;             ///< an island, a body: put back to the start of the step

  /// Everything that the steps from a time on depend on: members of the same names. The others are found anew in a
  /// step.
  struct Mark {
    Scene scene;
    PairTable pairs;
    StepTerms terms;
    SleepingBodies sleeping;
    std::vector<std::uint8_t> resting;
    std::vector<std::uint32_t> wait, next_wait;
    Vec3 reset_gravity;
  };
  Mark mark_;

  bool rests_ = false;
  double reached_ = 0.0;  ///< time of the world; before the phase: it begins anew, s
  double phase_begin_ = 0.0;
  bool phase_set_ = false;
  bool gravity_changed_ = false;       ///< g − a, or what acts from outside, has changed since the last step
  Vec3 reset_gravity_ = Vec3::Zero();  ///< g − a when all bodies were last reset, m/s²
  bool disturbed_ = false;             ///< a force or a coefficient has changed since the last step
  std::uint64_t phase_step_ = 0;
  SideImpulses side_impulses_;
  Counters counters_;
  Status status_ = Status::ok;
};

}  // namespace holdfast::internal::native
