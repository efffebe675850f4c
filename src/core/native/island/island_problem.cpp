#include "core/native/island/island_problem.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/native/contact_kinematics.hpp"
#include "core/native/rotation_step.hpp"

namespace holdfast::internal::native {

/// A contact point as the parts of a problem see it.
struct IslandProblem::PointView {
  int index = 0;     ///< among the contact's points
  double gap = 0.0;  ///< m
  const Vec3& normal;
  const End& a;
  const End& b;
  Vec3 arm_a, arm_b;  ///< at the start of the step; from anywhere where the body stays
  const CachedImpulse& cached;

  bool is_in(std::uint8_t bits) const { return (bits >> index & 1) != 0; }

  /// Of the surfaces at the start of the step: positive where they separate, m/s.
  double normal_velocity() const { return normal.dot(b.velocity_at(arm_b) - a.velocity_at(arm_a)); }

  /// Whether the filter takes it: the velocity matters only where it is not closed.
  bool is_taken(const PointFilter& filter, double step) const {
    return filter.is_closed(gap) || filter.takes(gap, normal_velocity(), step);
  }

  /// What the point begins with: the gap, and what the last solve left.
  void put_into(ContactStart& start, std::size_t lane) const {
    start.gap[lane] = gap;
    for (std::size_t k = 0; k < 3; ++k) {
      start.force.row[k][lane] = cached.force[static_cast<Eigen::Index>(k)];
      start.contact_velocity.row[k][lane] = cached.contact_velocity[static_cast<Eigen::Index>(k)];
    }
  }
};

/// Bodies in the solver's order, at rest, and without constraints.
void IslandProblem::begin(const Scene& scene, const IslandView& island, const StepTerms& terms, double step,
                          ContactSolver& solver) {
  const Bodies& bodies = scene.bodies;
  const std::size_t count = island.bodies.size();
  row_.resize(bodies.count());
  for (std::size_t i = 0; i < count; ++i) row_[island.bodies[i]] = static_cast<std::uint32_t>(i);
  pairs_.clear();
  for (const std::uint32_t index : island.manifolds) {
    const Manifold& manifold = scene.manifolds[index];
    if (!manifold.active || stays(bodies, manifold.a) || stays(bodies, manifold.b)) continue;
    pairs_.emplace_back(row_[at(manifold.a)], row_[at(manifold.b)]);
  }
  const std::span<const std::uint32_t> order = solver.order(count, pairs_);
  problem.pairs.clear();
  for (const auto& [a, b] : pairs_) problem.pairs.emplace_back(order[a], order[b]);
  problem.bodies.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t body = island.bodies[i];
    row_[body] = order[i];
    problem.bodies[order[i]] = {bodies.mass[body], bodies.inertia(body), bodies.radius[body]};
  }
  problem.free_velocity.assign(count, BodyVector{});
  problem.velocity.assign(count + 1, BodyVector{});
  problem.constraints.clear();
  start_.clear();
  problem.mid_arms.clear();
  problem.constraint_pair.clear();
  problem.normal_bounds.clear();
  problem.impulse_per_mass = terms.effective_gravity.norm() * step;
  problem.continues = false;
  sources.clear();
  motion_.assign(count + 1, BodyMotion{});
  late_impact_.assign(count + 1, 0);
  has_late_impact_ = false;
  outside_impulse_ = 0.0;
}

/// Adds what a force from outside does within the step to a body's free velocity.
void IslandProblem::push(const Bodies& bodies, std::uint32_t body, double step) {
  const Vec3& force = bodies.pushed[body].force;
  if (force == Vec3::Zero()) return;
  const std::size_t row = row_[body];
  const BodyVector& free = problem.free_velocity[row];
  const Vec3 turn = problem.bodies[row].inertia.inverse() * bodies.torque(body);
  problem.free_velocity[row] =
      body_vector(linear(free) + step / bodies.mass[body] * force, angular(free) + step * turn);
  outside_impulse_ += step * force.norm();
}

/// Velocities without contacts, start values, and how the bodies will turn within the step. Returns whether any does.
/// None turns in a step of implicit Euler: where arms are those of one time, and friction opposes the velocity at the
/// end, v = 0 satisfies every contact, and a solution exists whatever is wedged (V. Acary, F. Cadoux, C. Lemaréchal, J.
/// Malick, "A formulation of the linear discrete Coulomb friction problem via convex optimization", ZAMM 91, 2011).
bool IslandProblem::predict(const Scene& scene, const IslandView& island, const StepTerms& terms, double step) {
  const Bodies& bodies = scene.bodies;
  bool any_turns = false;
  for (const std::uint32_t body : island.bodies) {
    const std::size_t row = row_[body];
    const Vec3& v = bodies.state.velocity[body];
    const Vec3& w = bodies.state.angular_velocity[body];
    BodyMotion& motion = motion_[row];
    motion.velocity = {v.x(), v.y(), v.z()};
    motion.angular_velocity = {w.x(), w.y(), w.z()};
    const LastStep& last = bodies.last_step[body];
    const Vec3 v_guess = v + step * last.acceleration;
    const Vec3 w_guess = w + step * last.angular_acceleration;
    problem.velocity[row] = body_vector(v_guess, w_guess);
    Vec3 w_free = w;
    if (!terms.implicit && (w != Vec3::Zero() || w_guess != Vec3::Zero())) {
      // The angular velocity is taken as linear in time.
      const Mat3 turn_mid =
          rotation_by(clamped(step * (3.0 * w + w_guess) / 8.0, 0.5 * kLargestTurn)).toRotationMatrix();
      const Mat3 turn_end = rotation_by(clamped(step * (w + w_guess) / 2.0, kLargestTurn)).toRotationMatrix();
      motion.turns = any_turns = true;
      for (Eigen::Index i = 0; i < 3; ++i) {
        motion.turn_mid[static_cast<std::size_t>(i)] = {turn_mid(i, 0), turn_mid(i, 1), turn_mid(i, 2)};
        motion.turn_end[static_cast<std::size_t>(i)] = {turn_end(i, 0), turn_end(i, 1), turn_end(i, 2)};
      }
      const Mat3 axes = turn_end * bodies.shape[body].axes;
      const Mat3 inertia = inertia_in_container(axes, bodies.principal_inertia[body]);
      // Without torque the angular momentum stays.
      w_free = inertia.inverse() * (bodies.inertia(body) * w);
      problem.bodies[row].inertia = inertia;
    }
    problem.free_velocity[row] =
        body_vector(v + last.missing_velocity + step * terms.effective_gravity, w_free + last.missing_angular_velocity);
    push(bodies, body, step);
  }
  return any_turns;
}

IslandProblem::End IslandProblem::end_of(const Bodies& bodies, std::int32_t body) const {
  End end;
  end.row = static_cast<std::int32_t>(problem.bodies.size());
  if (stays(bodies, body)) return end;
  const std::size_t row = row_[at(body)];
  end.row = static_cast<std::int32_t>(row);
  end.moves = true;
  end.position = bodies.state.position[at(body)];
  end.velocity = bodies.state.velocity[at(body)];
  end.angular_velocity = bodies.state.angular_velocity[at(body)];
  end.inverse_mass = 1.0 / bodies.mass[at(body)];
  return end;
}

/// The constraints of a manifold, with the arms of the start of the step.
/// @param takes_part `bool(const PointView&)`
/// @param fill       `void(const PointView&, ContactConstraint&, std::size_t lane)`: biases and start values
template <class TakesPart, class FillPoint>
void IslandProblem::add_constraints(const Scene& scene, std::uint32_t index, TakesPart takes_part, FillPoint fill) {
  const Bodies& bodies = scene.bodies;
  const Manifold& manifold = scene.manifolds[index];
  const End a = end_of(bodies, manifold.a);
  const End b = end_of(bodies, manifold.b);
  const std::size_t first = problem.constraints.size();
  int used = 0;
  for (int i = 0; i < manifold.contact.count; ++i) {
    const ContactPoint& point = manifold.contact.points[at(i)];
    const PointView view{i,
                         point.gap,
                         manifold.contact.normal,
                         a,
                         b,
                         point.on_a - a.position,
                         point.on_b - b.position,
                         manifold.cached[at(i)]};
    if (!takes_part(view)) continue;
    const std::size_t lane = static_cast<std::size_t>(used++ % kLanes);
    if (lane == 0) {
      ContactConstraint& made = problem.constraints.emplace_back();
      made.friction = manifold.friction_now();
      made.a = a.row;
      made.b = b.row;
      sources.push_back({index, {}});
    }
    ContactConstraint& constraint = problem.constraints.back();
    constraint.count = static_cast<std::int32_t>(lane) + 1;
    sources.back().point[lane] = static_cast<std::uint8_t>(i);
    for (std::size_t k = 0; k < 3; ++k) {
      if (a.moves) constraint.arms.a[k][lane] = view.arm_a[static_cast<Eigen::Index>(k)];
      if (b.moves) constraint.arms.b[k][lane] = view.arm_b[static_cast<Eigen::Index>(k)];
    }
    fill(view, constraint, lane);
  }
  if (used == 0) return;
  const std::array<Vec3, 3> directions = directions_of(manifold.contact.normal);
  for (std::size_t p = first; p < problem.constraints.size(); ++p) {
    ContactConstraint& made = problem.constraints[p];
    for (std::size_t d = 0; d < 3; ++d) made.directions[d] = {directions[d].x(), directions[d].y(), directions[d].z()};
    made.effective_mass = 1.0 / ((a.inverse_mass + b.inverse_mass) * used);
  }
}

/// Adds the constraints of all active manifolds.
/// @param add `void(std::uint32_t manifold)`
template <class AddManifold>
void IslandProblem::for_each_active(const Scene& scene, const IslandView& island, AddManifold add) {
  std::uint32_t pair = 0;
  for (const std::uint32_t index : island.manifolds) {
    const Manifold& manifold = scene.manifolds[index];
    if (!manifold.active) continue;
    add(index);
    const bool with_fixed = stays(scene.bodies, manifold.a) || stays(scene.bodies, manifold.b);
    problem.constraint_pair.resize(problem.constraints.size(), with_fixed ? kNoPair : pair);
    if (!with_fixed) ++pair;
  }
}

void IslandProblem::prepare_step(const Scene& scene, const IslandView& island, const StepTerms& terms, double step,
                                 ContactSolver& solver, const PointFilter& filter, const PointBits& predicted) {
  begin(scene, island, terms, step, solver);
  const bool any_turns = predict(scene, island, terms, step);
  for_each_active(scene, island, [&](std::uint32_t index) {
    add_constraints(
        scene, index,
        [&](const PointView& point) { return point.is_in(predicted[index]) || point.is_taken(filter, step); },
        [&](const PointView& point, ContactConstraint&, std::size_t lane) {
          start_.resize(problem.constraints.size());
          point.put_into(start_.back(), lane);
        });
  });
  // Without rotation both sets of arms are the same.
  if (any_turns) problem.mid_arms.resize(problem.constraints.size());
  // Slip that is slower may end within the step.
  const double lasting_slip = terms.implicit ? std::numeric_limits<double>::infinity() : terms.lasting_slip(step);
  has_late_impact_ = start_step({step, terms.velocity_unit, lasting_slip}, start_, motion_, problem.constraints,
                                problem.mid_arms, late_impact_);
}

void IslandProblem::prepare_impact(const Scene& scene, const IslandView& island, const StepTerms& terms, double step,
                                   ContactSolver& solver, const PointFilter& filter, const PointBits& impacting) {
  const Bodies& bodies = scene.bodies;
  begin(scene, island, terms, step, solver);
  for (const std::uint32_t body : island.bodies)
    problem.free_velocity[row_[body]] = problem.velocity[row_[body]] =
        body_vector(bodies.state.velocity[body], bodies.state.angular_velocity[body]);
  for_each_active(scene, island, [&](std::uint32_t index) {
    const Manifold& manifold = scene.manifolds[index];
    add_constraints(
        scene, index,
        [&](const PointView& point) { return point.is_in(impacting[index]) && point.is_taken(filter, step); },
        [&](const PointView& point, ContactConstraint& constraint, std::size_t lane) {
          double& bias = constraint.velocity_bias.row[0][lane];
          bias = point.gap > kTouch ? point.gap / step : 0.0;
          const double speed = point.normal_velocity();
          if (speed < -kLarge * terms.velocity_unit) bias += manifold.restitution * speed;
          constraint.expected_impulse[lane] = step * point.cached.force.dot(manifold.contact.normal);
        });
  });
}

void IslandProblem::prepare_rest(const Scene& scene, const IslandView& island, const StepTerms& terms,
                                 ContactSolver& solver) {
  const Bodies& bodies = scene.bodies;
  const double step = terms.step;
  begin(scene, island, terms, step, solver);
  for (const std::uint32_t body : island.bodies) {
    problem.free_velocity[row_[body]] = body_vector(step * terms.effective_gravity, Vec3::Zero());
    push(bodies, body, step);
  }
  for_each_active(scene, island, [&](std::uint32_t index) {
    const Manifold& manifold = scene.manifolds[index];
    const bool pressed = std::any_of(manifold.cached.begin(), manifold.cached.begin() + manifold.contact.count,
                                     [](const CachedImpulse& cached) { return cached.pressed > 0.0; });
    const double touch = pressed ? kPressedTouch : leaning_gap(scene, manifold);
    const bool bounded = is_wall_or_roof(bodies, manifold);
    add_constraints(
        scene, index, [&](const PointView& point) { return point.gap <= touch; },
        [&](const PointView& point, ContactConstraint&, std::size_t lane) {
          problem.normal_bounds.resize(problem.constraints.size());
          problem.normal_bounds.back().lane[lane] =
              bounded ? (1.0 + kSlack) * step * point.cached.pressed : std::numeric_limits<double>::infinity();
          start_.resize(problem.constraints.size());
          point.put_into(start_.back(), lane);
        });
  });
  start_from_last(step, start_, problem.constraints);
}

/// Calls `store(constraint, lane, cached)` for the caches of all points, which hold what the solution says of them.
template <class Store>
void IslandProblem::store_impulses(Scene& scene, double step, Store store) {
  start_.resize(sources.size());
  to_container_frame(step, problem.constraints, start_);
  for (std::size_t p = 0; p < sources.size(); ++p) {
    Manifold& manifold = scene.manifolds[sources[p].manifold];
    const auto at_point = [](const ConstraintVector& of, std::size_t lane) {
      return Vec3(of.row[0][lane], of.row[1][lane], of.row[2][lane]);
    };
    for (std::size_t lane = 0; lane < at(problem.constraints[p].count); ++lane) {
      CachedImpulse& cached = manifold.cached[sources[p].point[lane]];
      cached.force = at_point(start_[p].force, lane);
      cached.contact_velocity = at_point(start_[p].contact_velocity, lane);
      store(p, lane, cached);
    }
  }
}

void IslandProblem::store_step_impulses(Scene& scene, const IslandView& island, double step) {
  for (const std::uint32_t index : island.manifolds)
    if (scene.manifolds[index].active) scene.manifolds[index].cached = {};
  store_impulses(scene, step, [&](std::size_t p, std::size_t lane, CachedImpulse& cached) {
    cached.pressed = problem.constraints[p].impulse.row[0][lane] / step;
  });
}

void IslandProblem::store_rest_impulses(Scene& scene, const IslandView& island, double step) {
  for (const std::uint32_t index : island.manifolds)
    if (scene.manifolds[index].active)
      for (CachedImpulse& cached : scene.manifolds[index].cached) cached = {.pressed = cached.pressed};
  store_impulses(scene, step, [&](std::size_t p, std::size_t lane, CachedImpulse& cached) {
    const double bound = problem.normal_bounds[p].lane[lane];
    if (std::isfinite(bound)) cached.pressed = bound / ((1.0 + kSlack) * step);
  });
}

void IslandProblem::complete_impulses() {
  const auto velocity = [&](std::int32_t row, const std::array<Lanes, 3>& arm, std::size_t lane) -> Vec3 {
    const BodyVector& v = problem.velocity[at(row)];
    return linear(v) + angular(v).cross(Vec3(arm[0][lane], arm[1][lane], arm[2][lane]));
  };
  for (ContactConstraint& constraint : problem.constraints) {
    for (std::size_t lane = 0; lane < at(constraint.count); ++lane) {
      const Vec3 relative =
          velocity(constraint.b, constraint.arms.b, lane) - velocity(constraint.a, constraint.arms.a, lane);
      for (std::size_t d = 0; d < 3; ++d) {
        const double u =
            relative.dot(Vec3::Map(constraint.directions[d].data())) + constraint.velocity_bias.row[d][lane];
        const double z = constraint.contact_velocity.row[d][lane];
        constraint.impulse.row[d][lane] += constraint.penalty[d > 0 ? 1 : 0][lane] * (z - u);
      }
    }
  }
}

void IslandProblem::find_missing_velocities() {
  if (has_late_impact_) complete_impulses();
  find_missing_momentum(problem, wrench_, missing_velocity_);
  for (std::size_t row = 0; row < problem.bodies.size(); ++row) {
    const ProblemBody& body = problem.bodies[row];
    BodyVector& missing = missing_velocity_[row];
    missing = body_vector(linear(missing) / body.mass, body.inertia.inverse() * angular(missing));
  }
}

void IslandProblem::minimise_wall_forces(const Scene& scene, double cost) {
  for (std::size_t p = 0; p < sources.size(); ++p) {
    const Manifold& manifold = scene.manifolds[sources[p].manifold];
    if (!is_wall(scene.bodies, manifold)) continue;
    problem.constraints[p].velocity_bias.row[0].fill(cost);
    problem.normal_bounds[p].lane.fill(std::numeric_limits<double>::infinity());
  }
}

double IslandProblem::wall_cost() const {
  double cost = 0.0;
  for (const ContactConstraint& constraint : problem.constraints)
    for (std::size_t lane = 0; lane < at(constraint.count); ++lane)
      cost += constraint.velocity_bias.row[0][lane] * constraint.impulse.row[0][lane];
  return cost;
}

void IslandProblem::add_pushes(const Scene& scene, double factor, std::vector<SidePush>& pushes) const {
  for (std::size_t p = 0; p < sources.size(); ++p) {
    const Manifold& manifold = scene.manifolds[sources[p].manifold];
    const bool on_a = stays(scene.bodies, manifold.a);
    if (!on_a && !stays(scene.bodies, manifold.b)) continue;
    const std::optional<std::size_t> side = pushed_side(scene, manifold, on_a ? manifold.a : manifold.b);
    if (!side) continue;
    const ContactConstraint& constraint = problem.constraints[p];
    for (std::size_t lane = 0; lane < at(constraint.count); ++lane) {
      Vec3 impulse = Vec3::Zero();
      for (std::size_t d = 0; d < 3; ++d)
        impulse += constraint.impulse.row[d][lane] * Vec3::Map(constraint.directions[d].data());
      pushes.push_back({static_cast<std::uint32_t>(on_a ? manifold.b : manifold.a), *side,
                        (on_a ? -factor : factor) * impulse, manifold.contact.points[sources[p].point[lane]].on_a});
    }
  }
}

}  // namespace holdfast::internal::native
