#include "core/native/native_world.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "core/engine/step_plan.hpp"
#include "core/native/contact_kinematics.hpp"
#include "core/native/sampled_step.hpp"

namespace holdfast::internal::native {

namespace {

/// Manifolds of a box, about as many as in a dense packing: memory that is reserved at once costs less than memory that
/// grows.
constexpr std::size_t kLikelyManifolds = 8;

}  // namespace

NativeWorld::NativeWorld(const WorldBatch& batch, const World& world, const Settings& settings,
                         const NativeOptions& options, std::unique_ptr<WorldMemory> memory)
    : world_(world),
      options_(options),
      gravity_(0.0, 0.0, -settings.gravity),
      memory_(std::move(memory)),
      state_(state_of(batch, world, settings, options)),
      step_(state_, memory_->stepper, options_, counters_, status_) {
  state_.scene.manifolds = std::move(memory_->manifolds);
  state_.scene.manifolds.reserve(kLikelyManifolds * state_.scene.bodies.count());
  state_.scene.undo = std::move(memory_->undone);
  state_.begin();
}

std::unique_ptr<WorldMemory> NativeWorld::release_memory() {
  Scene& scene = state_.scene;
  scene.manifolds.clear();
  scene.undo.clear();
  memory_->marked.clear();
  memory_->manifolds = std::move(scene.manifolds);
  memory_->undone = std::move(scene.undo);
  return std::move(memory_);
}

/// The next step begins a phase.
void NativeWorld::begin_anew() {
  phase_begin_.reset();
  reached_ = -std::numeric_limits<double>::infinity();
}

// Manifolds are most of a world: those of the mark stay in memory that is kept from world to world.
void NativeWorld::mark() {
  memory_->marked = state_.scene.manifolds;
  std::vector<Manifold> own = std::exchange(state_.scene.manifolds, {});
  mark_ = Mark{state_, counters_, status_, rests_};
  state_.scene.manifolds = std::move(own);
  begin_anew();
}

void NativeWorld::rewind() {
  std::vector<Manifold> own = std::exchange(state_.scene.manifolds, {});
  own = memory_->marked;
  state_ = mark_->state;
  state_.scene.manifolds = std::move(own);
  counters_ = mark_->counters;
  status_ = mark_->status;
  rests_ = mark_->rests;
  begin_anew();
}

/// Whether some body follows each push, and not their mean: it turns, or touches nothing, or a sample lifts it.
/// @param slow m/s: what turns no faster rests
bool NativeWorld::follows_pushes(const Phase& phase, double slow) const {
  const Bodies& bodies = state_.scene.bodies;
  const auto lifts = [&](const Phase& sample) { return gravity_.z() >= sample.acceleration.z(); };
  if (std::any_of(phase.samples.begin(), phase.samples.end(), lifts)) return true;
  std::vector<std::uint8_t> touches(bodies.count(), 0);
  for (const Manifold& manifold : state_.scene.manifolds) {
    if (!manifold.active) continue;
    for (const std::int32_t body : {manifold.a, manifold.b})
      if (body >= 0) touches[at(body)] = 1;
  }
  for (std::size_t i = 0; i < bodies.count(); ++i)
    if (bodies.activity[i] != Activity::fixed && (touches[i] == 0 || bodies.largest_rotational_speed(i) > slow))
      return true;
  return false;
}

/// Of a phase that is sampled, what the next step takes with the mean of its samples.
Phase NativeWorld::next_part(const Phase& phase) const {
  if (phase.samples.empty()) return phase;
  const Bodies& bodies = state_.scene.bodies;
  const double slow = kNegligible * state_.terms.longest_step * gravity_.norm();
  std::vector<LoneBlock> blocks;
  if (follows_pushes(phase, slow)) blocks.emplace_back();
  for (const Manifold& manifold : state_.scene.manifolds) {
    if (!manifold.active || manifold.contact.count == 0 || manifold.friction == 0.0) continue;
    if (!supports(bodies, manifold)) continue;
    LoneBlock block{manifold.friction, manifold.kinetic_friction, Vec3::Zero()};
    block.slip = relative_velocity(bodies, manifold, manifold.contact.points[0]);
    block.slip.z() = 0.0;
    // What sticks slips by what solves leave; what walks by micrometres slips by more.
    if (block.slip.norm() <= kNegligible * slow) block.slip = Vec3::Zero();
    if (std::find(blocks.begin(), blocks.end(), block) == blocks.end()) blocks.push_back(block);
  }
  const bool goes_on = phase.begin < reached_ && reached_ < phase.end;
  return native::next_part(phase, goes_on ? reached_ : phase.begin, gravity_, blocks);
}

void NativeWorld::begin_phase(const Phase& phase) {
  if (phase_begin_ == phase.begin && !disturbed_) return;
  phase_begin_ = phase.begin;
  phase_step_ = 0;
  const Vec3 effective_gravity = gravity_ - phase.acceleration;
  const std::vector<std::uint8_t> resting = state_.scene.bodies.marked(Activity::resting);
  const Change change = state_.rest.note(state_.scene.bodies, state_.terms, effective_gravity, disturbed_);
  if (change == Change::none) return;
  disturbed_ = false;
  state_.terms.gravity_change = effective_gravity - state_.terms.effective_gravity;
  state_.terms.effective_gravity = effective_gravity;
  state_.terms.changes_on = phase.begin < state_.terms.changed + kToAndFro;
  state_.terms.changed = phase.begin;
  find_farther_contacts(phase.acceleration);
  if (change == Change::much)
    state_.sleeping.reset(state_.scene);
  else
    state_.sleeping.forget(resting);
}

/// Looks for contacts as far away as the accelerations from now on ask for, where that is farther than before: nobody
/// has announced those that a caller sets, nor what forces from outside give.
void NativeWorld::find_farther_contacts(const Vec3& acceleration) {
  const Bodies& bodies = state_.scene.bodies;
  double largest_push = 0.0;
  for (std::size_t i = 0; i < bodies.count(); ++i) {
    if (bodies.activity[i] == Activity::fixed || bodies.pushed[i].force == Vec3::Zero()) continue;
    const Vec3 turn = bodies.inertia(i).inverse() * bodies.torque(i);
    largest_push =
        std::max(largest_push, bodies.pushed[i].force.norm() / bodies.mass[i] + bodies.radius[i] * turn.norm());
  }
  const double margin = fall_in_step(state_.terms, -gravity_.z() + (acceleration.norm() + largest_push));
  if (margin <= state_.terms.fall_margin) return;
  state_.terms.fall_margin = margin;
  state_.find_contacts(std::vector<std::uint8_t>(bodies.count(), 1));
}

void NativeWorld::set_force(std::size_t box, const BoxForce& force) {
  Bodies& bodies = state_.scene.bodies;
  const auto body = std::find(bodies.world_box.begin(), bodies.world_box.end(), box) - bodies.world_box.begin();
  bodies.pushed[static_cast<std::size_t>(body)] = force;
  disturbed_ = true;
}

void NativeWorld::set_friction(const ContactSettings& contact) {
  state_.contacts.set_law(state_.scene, contact);
  disturbed_ = true;
}

double NativeWorld::advance(const Phase& phase) {
  reached_ = take_next_step(next_part(phase));
  // A state that is not finite is no bug: the caller ends the world there.
  assert(!has_finite_state(view()) || broken_invariants(view()).empty());
  return reached_;
}

double NativeWorld::take_next_step(const Phase& phase) {
  SideForces& side_forces = state_.scene.side_forces;
  side_forces.begin_sum();
  begin_phase(phase);
  const StepPlan plan(phase, 1.0 / state_.terms.longest_step);
  state_.terms.set_step(plan.step());
  state_.terms.to_and_fro = std::max(phase.begin, reached_) < state_.terms.changed + kToAndFro;
  state_.sleeping.wake(state_.scene);
  state_.rest.decide(state_.scene, state_.terms, state_.islands, options_.freeze, memory_->stepper.rest_proof(),
                     counters_);
  rests_ = !state_.scene.bodies.any(Activity::moving);
  const std::uint64_t steps = rests_ && options_.jump ? plan.step_count() - phase_step_ : 1;
  if (rests_) {
    state_.rest.add_pushes(state_.scene, state_.terms, plan.step() * static_cast<double>(steps),
                           memory_->stepper.rest_proof());
    counters_.steps_skipped += steps;
  } else {
    step_.correct_positions();
    let_sleep();
    step_.take(plan.step());
    state_.sleeping.note(state_.scene, state_.terms);
  }
  state_.rest.end_step();
  counters_.steps += steps;
  phase_step_ += steps;
  return phase_step_ == plan.step_count() ? phase.end : plan.end_of(phase_step_ - 1);
}

/// Lets slow bodies sleep in the step.
void NativeWorld::let_sleep() {
  if (!options_.sleep || !state_.sleeping.choose(state_.scene, state_.terms, state_.islands)) return;
  state_.contacts.end_separated_from_sleeping(state_.scene);
  state_.find_islands();
}

void NativeWorld::read_back(StateColumns& state) const {
  const std::vector<std::uint32_t>& box = state_.scene.bodies.world_box;
  for_each_state_column(
      [&](const char*, const auto& from, auto& to) {
        for (std::size_t i = 0; i < box.size(); ++i) to[world_.box_begin + box[i]] = from[i];
      },
      state_.scene.bodies.state, state);
}

}  // namespace holdfast::internal::native
