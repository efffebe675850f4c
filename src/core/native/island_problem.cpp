// What a solve of an island is made of: bodies, their velocities without contacts, and the patches of contacts.

#include "core/native/island.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/native/island_motion.hpp"
#include "core/native/rotation_step.hpp"

namespace holdfast::internal::native {

namespace {

/// Impacts below this share of |g − a| h do not rebound: rest would otherwise never come.
constexpr double kReboundShare = 2.0;

/// Points of a contact that was pressed in the last step count as touching in a proof of rest up to this gap, m: bodies
/// that come to rest rock by a few micrometres for some steps. With 0.1 µm loads under the road accelerations took 15 %
/// more time at `screening`, with 50 µm 2 % less.
constexpr double kPressedTouch = 1.01e-5;

/// Slip above this many times |g − a| h does not end within the step: friction opposes its mean over the step.
constexpr double kLastingSlip = 3.0;

}  // namespace

void IslandStepper::load(const Scene& scene, const IslandView& island, const StepTerms& terms, Purpose purpose,
                         double step) {
  const Bodies& bodies = scene.bodies;
  place_.resize(bodies.count());
  // First by position in the island, for the pairs; then by place in the factor.
  for (std::size_t i = 0; i < island.bodies.size(); ++i) place_[island.bodies[i]] = static_cast<std::int32_t>(i);
  pairs_.clear();
  for (const std::uint32_t index : island.manifolds) {
    const Manifold& manifold = scene.manifolds[index];
    if (!manifold.active || is_fixed(bodies, manifold.a) || is_fixed(bodies, manifold.b)) continue;
    pairs_.emplace_back(place_[at(manifold.a)], place_[at(manifold.b)]);
  }
  solver_.begin();
  solver_.factor.analyse(island.bodies.size(), pairs_);
  fixed_ = static_cast<std::int32_t>(island.bodies.size());
  solver_.bodies.resize(island.bodies.size());
  for (std::size_t i = 0; i < island.bodies.size(); ++i) {
    const std::uint32_t body = island.bodies[i];
    const std::uint32_t place = solver_.factor.place(i);
    place_[body] = static_cast<std::int32_t>(place);
    solver_.bodies[place] = {bodies.mass[body], bodies.inertia(body), bodies.radius[body]};
  }
  solver_.free_velocity.assign(island.bodies.size(), BodyVector{});
  solver_.velocity.assign(island.bodies.size() + 1, BodyVector{});
  turn_mid_.resize(island.bodies.size());
  turn_end_.resize(island.bodies.size());
  turning_.assign(island.bodies.size() + 1, 0);
  solver_.load_unit = terms.pull.norm() * step;

  for (const std::uint32_t body : island.bodies) {
    const auto place = at(place_[body]);
    const StateColumns& state = bodies.state;
    if (purpose == Purpose::rest) solver_.free_velocity[place] = body_vector(step * terms.pull, Vec3::Zero());
    if (purpose == Purpose::impact)
      solver_.free_velocity[place] = solver_.velocity[place] =
          body_vector(state.velocity[body], state.angular_velocity[body]);
  }
  if (purpose == Purpose::smooth) predict(scene, island, terms, step);

  captures_ = false;
  captured_.assign(island.bodies.size() + 1, 0);
  solver_.patches.clear();
  solver_.mid_arms.clear();
  solver_.patch_pair.clear();
  solver_.most_normal.clear();
  sources_.clear();
  std::uint32_t pair = 0;
  for (const std::uint32_t index : island.manifolds) {
    const Manifold& manifold = scene.manifolds[index];
    if (!manifold.active) continue;
    const bool with_fixed = is_fixed(bodies, manifold.a) || is_fixed(bodies, manifold.b);
    add_patches(scene, index, terms, purpose, step);
    solver_.patch_pair.resize(solver_.patches.size(), with_fixed ? kNoPair : pair);
    if (!with_fixed) ++pair;
  }
  // Without rotation both sets of arms are the same.
  if (std::none_of(turning_.begin(), turning_.end(), [](std::uint8_t t) { return t != 0; })) solver_.mid_arms.clear();
}

/// Velocities without contacts, start values, and how the bodies will turn within the step.
void IslandStepper::predict(const Scene& scene, const IslandView& island, const StepTerms& terms, double step) {
  const Bodies& bodies = scene.bodies;
  for (const std::uint32_t body : island.bodies) {
    const auto place = at(place_[body]);
    const Vec3& v = bodies.state.velocity[body];
    const Vec3& w = bodies.state.angular_velocity[body];
    const Vec3 v_guess = v + step * bodies.acceleration[body];
    const Vec3 w_guess = w + step * bodies.angular_acceleration[body];
    solver_.velocity[place] = body_vector(v_guess, w_guess);
    Vec3 w_free = w;
    if (w != Vec3::Zero() || w_guess != Vec3::Zero()) {
      turning_[place] = 1;
      // Angular velocity taken as linear in time.
      turn_mid_[place] = rotation_by(clamped(step * (3.0 * w + w_guess) / 8.0, 0.5 * kLargestTurn)).toRotationMatrix();
      turn_end_[place] = rotation_by(clamped(step * (w + w_guess) / 2.0, kLargestTurn)).toRotationMatrix();
      const Mat3 axes = turn_end_[place] * bodies.shape[body].axes;
      const Mat3 inertia = inertia_in_container(axes, bodies.principal_inertia[body]);
      // Angular momentum is what goes on without torque.
      w_free = inertia.inverse() * (bodies.inertia(body) * w);
      solver_.bodies[place].inertia = inertia;
    }
    solver_.free_velocity[place] = body_vector(v + step * terms.pull, w_free);
  }
}

void IslandStepper::add_patches(const Scene& scene, std::uint32_t index, const StepTerms& terms, Purpose purpose,
                                double step) {
  const Bodies& bodies = scene.bodies;
  const Manifold& manifold = scene.manifolds[index];
  const std::array<Vec3, 3> directions = directions_of(manifold.contact.normal);
  const bool a_fixed = is_fixed(bodies, manifold.a);
  const bool b_fixed = is_fixed(bodies, manifold.b);
  const double inverse_mass =
      (a_fixed ? 0.0 : 1.0 / bodies.mass[at(manifold.a)]) + (b_fixed ? 0.0 : 1.0 / bodies.mass[at(manifold.b)]);
  const std::int32_t place_a = a_fixed ? fixed_ : place_[at(manifold.a)];
  const std::int32_t place_b = b_fixed ? fixed_ : place_[at(manifold.b)];
  const std::size_t first = solver_.patches.size();
  const bool border = is_border(bodies, manifold);
  const bool pressed = std::any_of(manifold.memory.begin(), manifold.memory.begin() + manifold.contact.count,
                                   [](const PointMemory& memory) { return memory.pressed > 0.0; });
  const double touch = purpose != Purpose::rest ? kTouch : pressed ? kPressedTouch : leaning_gap(bodies, manifold);
  int used = 0;
  for (int i = 0; i < manifold.contact.count; ++i) {
    const ContactPoint& point = manifold.contact.points[at(i)];
    const Vec3 slip = relative_velocity(bodies, manifold, point);
    const double parting_speed = manifold.contact.normal.dot(slip);
    const bool moving = purpose == Purpose::smooth || purpose == Purpose::impact;
    const bool met = purpose == Purpose::smooth && (met_[index] >> i & 1) != 0;
    if (moving ? !met && !is_solved(point, parting_speed, terms, step) : point.gap > touch) continue;
    if (purpose == Purpose::impact && (struck_[index] >> i & 1) == 0) continue;
    const std::size_t lane = static_cast<std::size_t>(used % kLanes);
    if (lane == 0) {
      Patch& patch = solver_.patches.emplace_back();
      for (std::size_t d = 0; d < 3; ++d)
        patch.directions[d] = {directions[d].x(), directions[d].y(), directions[d].z()};
      patch.friction = purpose == Purpose::projection ? 0.0 : manifold.friction;
      patch.a = place_a;
      patch.b = place_b;
      solver_.mid_arms.emplace_back();
      sources_.push_back({index, {}});
      if (purpose == Purpose::rest) solver_.most_normal.emplace_back();
    }
    ++used;
    Patch& patch = solver_.patches.back();
    Arms& mid = solver_.mid_arms.back();
    patch.count = static_cast<std::int32_t>(lane) + 1;
    sources_.back().point[lane] = static_cast<std::uint8_t>(i);

    const auto set_arms = [&](bool fixed, std::int32_t body, std::int32_t place, const Vec3& on, auto Arms::*side) {
      if (fixed) return;
      const Vec3 arm = on - bodies.state.position[at(body)];
      const bool turns = purpose == Purpose::smooth && turning_[at(place)] != 0;
      const Vec3 end = turns ? Vec3(turn_end_[at(place)] * arm) : arm;
      const Vec3 middle = turns ? Vec3(turn_mid_[at(place)] * arm) : arm;
      for (std::size_t k = 0; k < 3; ++k) {
        (patch.arms.*side)[k][lane] = end[static_cast<Eigen::Index>(k)];
        (mid.*side)[k][lane] = middle[static_cast<Eigen::Index>(k)];
      }
    };
    set_arms(a_fixed, manifold.a, place_a, point.on_a, &Arms::a);
    set_arms(b_fixed, manifold.b, place_b, point.on_b, &Arms::b);

    const PointMemory& memory = manifold.memory[at(i)];
    patch.load[lane] = step * memory.force.dot(directions[0]);
    if (purpose == Purpose::rest)
      solver_.most_normal.back().lane[lane] =
          border ? kPressedMore * step * memory.pressed : std::numeric_limits<double>::infinity();
    switch (purpose) {
      case Purpose::projection:
        patch.allowance.row[0][lane] = point.gap + kTouch;
        break;
      case Purpose::impact: {
        patch.allowance.row[0][lane] = point.gap > kTouch ? point.gap / step : 0.0;
        if (parting_speed < -kReboundShare * terms.velocity_unit)
          patch.allowance.row[0][lane] += manifold.restitution * parting_speed;
        break;
      }
      case Purpose::rest:
      case Purpose::smooth:
        patch.allowance.row[0][lane] = purpose == Purpose::smooth && point.gap > kTouch ? point.gap / step : 0.0;
        if (purpose == Purpose::smooth) {
          if (std::max(0.0, point.gap) + step * parting_speed < -kJumpShare * terms.velocity_unit * step) {
            captures_ = true;
            captured_[at(place_a)] = captured_[at(place_b)] = 1;
          }
          // Friction along the mean slip makes curved paths second order in the step.
          const Vec3 slide = slip - manifold.contact.normal * parting_speed;
          if (slide.norm() > kLastingSlip * terms.velocity_unit)
            for (std::size_t d = 1; d < 3; ++d) patch.allowance.row[d][lane] = slide.dot(directions[d]);
        }
        for (std::size_t d = 0; d < 3; ++d) {
          patch.impulse.row[d][lane] = step * memory.force.dot(directions[d]);
          patch.slip.row[d][lane] = memory.slip.dot(directions[d]) + (d > 0 ? patch.allowance.row[d][lane] : 0.0);
        }
        patch.impulse.row[0][lane] = std::max(0.0, patch.impulse.row[0][lane]);
        break;
    }
  }
  for (std::size_t p = first; p < solver_.patches.size(); ++p) solver_.patches[p].base = 1.0 / (inverse_mass * used);
}

}  // namespace holdfast::internal::native
