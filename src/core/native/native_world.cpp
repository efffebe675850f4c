#include "core/native/native_world.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <tuple>

#include "core/engine/step_plan.hpp"
#include "core/model/container_panels.hpp"
#include "core/native/contact_kinematics.hpp"
#include "core/native/sampled_step.hpp"

namespace holdfast::internal::native {

namespace {

/// Manifolds of a box, about as many as in a dense packing: memory that is reserved at once costs less than memory that
/// grows.
constexpr std::size_t kLikelyManifolds = 8;

std::vector<Side> sides_of(const ContainerSettings& container, const std::vector<OrientedBox>& boxes) {
  std::vector<Side> sides;
  for (const Panel& panel : container_panels(container, kWallThickness)) {
    Side& made = sides.emplace_back();
    made.index = panel.side;
    made.space = {panel.normal, panel.offset};
    made.surface = panel.surface;
    if (panel.ends) made.block = OrientedBox{.centre = panel.centre, .half_extents = panel.half_extents};
    made.play.assign(boxes.size(), 0.0);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const ContactSet contact =
          made.block ? contact_of(*made.block, boxes[i], kLeastPlay, {}) : contact_of(made.space, boxes[i], kLeastPlay);
      // A box on the edge of a wall is not beside it.
      if (contact.count > 0 && contact.normal.dot(panel.normal) > 0.5)
        made.play[i] = side_play(panel.surface.kind, contact.nearest_gap());
    }
  }
  return sides;
}

/// Steps per second that the thinnest upright box needs, 1/s; see `kThinSteps`.
double least_steps_per_second(const Bodies& bodies, double gravity) {
  double extent = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < bodies.count(); ++i)
    if (bodies.fixed[i] == 0) extent = std::min(extent, 2.0 * bodies.shape[i].half_extents.head<2>().minCoeff());
  return kThinSteps * std::sqrt(0.5 * gravity / extent);
}

}  // namespace

NativeWorld::NativeWorld(const WorldBatch& batch, const World& world, const Settings& settings,
                         const NativeOptions& options, std::unique_ptr<WorldMemory> memory)
    : world_(world),
      options_(options),
      gravity_(0.0, 0.0, -settings.gravity),
      contact_(world.contact),
      memory_(std::move(memory)) {
  scene_.bodies = bodies_of(batch, world);
  options_.steps_per_second =
      std::max(options_.steps_per_second, least_steps_per_second(scene_.bodies, settings.gravity));
  scene_.sides = sides_of(world.container, scene_.bodies.shape);
  scene_.notes_pushes = settings.screening.measures_walls();
  const std::size_t count = scene_.bodies.count();
  scene_.manifolds = std::move(memory_->manifolds);
  scene_.undo = std::move(memory_->undone);
  scene_.manifolds.reserve(kLikelyManifolds * count);
  sleeping_ = SleepingBodies(count);
  resting_.assign(count, 0);
  reset_.assign(count, 0);
  moving_.assign(count, 0);
  failed_.assign(count, 0);
  ahead_.assign(count, 0);
  refuted_.assign(count, 0);
  undecided_.assign(count, 0);
  wait_.assign(count, 0);
  next_wait_.assign(count, 0);
  before_ = scene_.bodies.state;
  before_acceleration_.resize(count);
  reports_.resize(count);

  double strongest = 0.0;
  for (const Segment& segment : world.acceleration->segments)
    strongest = std::max(strongest, segment.acceleration.norm());
  terms_.longest_step = 1.0 / options_.steps_per_second;
  terms_.fall_margin = fall_margin(strongest);
  find_contacts(std::vector<std::uint8_t>(count, 1));
  for (Manifold& manifold : scene_.manifolds) {
    const auto& points = manifold.contact.points;
    manifold.active = supports(scene_.bodies, manifold) &&
                      std::any_of(points.begin(), points.begin() + manifold.contact.count,
                                  [](const ContactPoint& p) { return p.gap <= kContactTolerance; });
  }
  connectivity_.find(scene_.bodies, scene_.manifolds);
}

std::unique_ptr<WorldMemory> NativeWorld::release_memory() {
  scene_.manifolds.clear();
  scene_.undo.clear();
  memory_->manifolds = std::move(scene_.manifolds);
  memory_->undone = std::move(scene_.undo);
  return std::move(memory_);
}

/// What a body moves in a step under gravity and an acceleration in the worst direction, m.
double NativeWorld::fall_margin(double acceleration) const {
  return terms_.longest_step * terms_.longest_step * (-gravity_.z() + acceleration);
}

/// The next step begins a phase.
void NativeWorld::begin_anew() {
  phase_set_ = false;
  reached_ = -std::numeric_limits<double>::infinity();
}

void NativeWorld::mark() {
  mark_ = {scene_, pairs_, terms_, sleeping_, resting_, wait_, next_wait_, reset_gravity_};
  begin_anew();
}

void NativeWorld::rewind() {
  scene_ = mark_.scene;
  pairs_ = mark_.pairs;
  terms_ = mark_.terms;
  sleeping_ = mark_.sleeping;
  resting_ = mark_.resting;
  reset_gravity_ = mark_.reset_gravity;
  wait_ = mark_.wait;
  next_wait_ = mark_.next_wait;
  begin_anew();
}

/// Of a phase that is sampled, what the next step takes with the mean of its samples.
Phase NativeWorld::next_part(const Phase& phase) const {
  if (phase.samples.empty()) return phase;
  const Bodies& bodies = scene_.bodies;
  const double slow = kSlipShare * terms_.longest_step * gravity_.norm();
  std::vector<LoneBlock> blocks;
  for (const Manifold& manifold : scene_.manifolds) {
    if (!manifold.active || manifold.contact.count == 0 || manifold.friction == 0.0) continue;
    if (!supports(bodies, manifold)) continue;
    LoneBlock block{manifold.friction, manifold.kinetic_friction, Vec3::Zero()};
    block.slip = relative_velocity(bodies, manifold, manifold.contact.points[0]);
    block.slip.z() = 0.0;
    if (block.slip.norm() <= slow) block.slip = Vec3::Zero();
    if (std::find(blocks.begin(), blocks.end(), block) == blocks.end()) blocks.push_back(block);
  }
  const bool goes_on = phase.begin < reached_ && reached_ < phase.end;
  return native::next_part(phase, goes_on ? reached_ : phase.begin, gravity_, blocks);
}

void NativeWorld::begin_phase(const Phase& phase) {
  if (phase_set_ && !disturbed_ && phase.begin == phase_begin_) return;
  phase_set_ = true;
  phase_begin_ = phase.begin;
  phase_step_ = 0;
  const Vec3 effective_gravity = gravity_ - phase.acceleration;
  gravity_changed_ = disturbed_ || effective_gravity != terms_.effective_gravity;
  if (!gravity_changed_) return;
  terms_.effective_gravity = effective_gravity;
  terms_.changed = phase.begin;
  find_farther_contacts(phase.acceleration);
  const double change = (effective_gravity - reset_gravity_).norm();
  if (disturbed_ || change > kLittleChange * effective_gravity.norm()) {
    disturbed_ = false;
    reset_gravity_ = effective_gravity;
    std::fill(reset_.begin(), reset_.end(), 1);
    sleeping_.reset(scene_);
    std::fill(wait_.begin(), wait_.end(), 0);
    std::fill(next_wait_.begin(), next_wait_.end(), 0);
  } else {
    reset_ = resting_;
    sleeping_.forget(resting_);
  }
  std::fill(resting_.begin(), resting_.end(), 0);
}

/// Looks for contacts as far away as the accelerations from now on ask for, where that is farther than before: nobody
/// has announced those that a caller sets, nor what forces from outside give.
void NativeWorld::find_farther_contacts(const Vec3& acceleration) {
  const Bodies& bodies = scene_.bodies;
  double largest_push = 0.0;
  for (std::size_t i = 0; i < bodies.count(); ++i) {
    if (bodies.fixed[i] != 0 || bodies.pushed[i].force == Vec3::Zero()) continue;
    const Vec3 turn = bodies.inertia(i).inverse() * bodies.torque(i);
    largest_push =
        std::max(largest_push, bodies.pushed[i].force.norm() / bodies.mass[i] + bodies.radius[i] * turn.norm());
  }
  const double margin = fall_margin(acceleration.norm() + largest_push);
  if (margin <= terms_.fall_margin) return;
  terms_.fall_margin = margin;
  find_contacts(std::vector<std::uint8_t>(bodies.count(), 1));
}

void NativeWorld::set_force(std::size_t box, const BoxForce& force) {
  Bodies& bodies = scene_.bodies;
  const auto body = std::find(bodies.world_box.begin(), bodies.world_box.end(), box) - bodies.world_box.begin();
  bodies.pushed[static_cast<std::size_t>(body)] = force;
  disturbed_ = true;
}

void NativeWorld::set_friction(const ContactSettings& contact) {
  contact_ = contact;
  for (Manifold& manifold : scene_.manifolds) {
    set_surfaces(manifold, manifold.contact.normal);
    forget_forces(manifold);
  }
  disturbed_ = true;
}

double NativeWorld::advance(const Phase& phase) {
  reached_ = take_next_step(next_part(phase));
  // A state that is not finite is no bug: the caller ends the world there.
  assert(!has_finite_state(view()) || broken_invariants(view()).empty());
  return reached_;
}

double NativeWorld::take_next_step(const Phase& phase) {
  side_impulses_ = {};
  begin_phase(phase);
  const StepPlan plan(phase, options_.steps_per_second);
  set_step(plan.step());
  terms_.to_and_fro = std::max(phase.begin, reached_) < terms_.changed + kToAndFro;
  whole_step_unit_ = terms_.velocity_unit > 0.0 ? terms_.velocity_unit : 1.0;
  sleeping_.wake(scene_);
  const bool any_moving = find_moving();
  rests_ = !any_moving;
  if (!any_moving && options_.jump) {
    const std::uint64_t left = plan.step_count() - phase_step_;
    add_resting_pushes(plan.step() * static_cast<double>(left));
    counters_.steps += left;
    counters_.steps_skipped += left;
    phase_step_ = plan.step_count();
    gravity_changed_ = false;
    return phase.end;
  }
  if (any_moving) {
    correct_positions();
    if (options_.sleep && sleeping_.choose(scene_, terms_, connectivity_, moving_)) {
      end_separated_from_sleeping();
      connectivity_.find(scene_.bodies, scene_.manifolds);
      if (scene_.notes_pushes)
        push_floor([&](std::size_t i) -> Vec3 { return scene_.bodies.mass[i] * sleeping_.stopped()[i]; });
    }
    take_step(plan.step(), 0);
    sleeping_.note(scene_, terms_, moving_);
  } else {
    add_resting_pushes(plan.step());
  }
  gravity_changed_ = false;
  ++counters_.steps;
  if (!any_moving) ++counters_.steps_skipped;
  return plan.end_of(phase_step_++);
}

void NativeWorld::read_back(StateColumns& state) const {
  const std::vector<std::uint32_t>& box = scene_.bodies.world_box;
  for_each_state_column(
      [&](const char*, const auto& from, auto& to) {
        for (std::size_t i = 0; i < box.size(); ++i) to[world_.box_begin + box[i]] = from[i];
      },
      scene_.bodies.state, state);
}

}  // namespace holdfast::internal::native
