#include "core/native/island.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/native/rotation_step.hpp"

namespace holdfast::native {

namespace {

/// Surfaces this near are in touch, m: rounding of positions is far below, what a scene shows far above.
constexpr double kTouch = 1e-7;

/// Overlap at the end of a step that calls for a contact to be solved: at most this, m, and this share of |g − a| h².
constexpr double kOverlap = 5e-6;
constexpr double kOverlapShare = 0.01;

/// Overlap that bodies may come to within a step without having been in contact before it, m.
constexpr double kDeepOverlap = 2e-4;

/// Impacts below this share of |g − a| h are never located in time: they close at the end of their step.
constexpr double kFastShare = 0.25;

/// Approach, and change of velocity beyond that of the step before, above this share of |g − a| h are an impact.
constexpr double kJumpShare = 0.1;

/// Impacts below this share of |g − a| h do not rebound: rest would otherwise never come.
constexpr double kReboundShare = 2.0;

/// Slip above this many times |g − a| h does not end within the step: friction opposes its mean over the step.
constexpr double kLastingSlip = 3.0;

/// Slip below this share of |g − a| h is none.
constexpr double kSlipShare = 1e-3;

/// A residual above this many |g − a| h, or none at all, is that of an iteration that diverges.
constexpr double kDiverged = 10.0;

/// A residual above this many |g − a| h after all iterations of a moving step calls for more care.
constexpr double kStuck = 0.5;

/// Iterations with care over those without, and the R they are taken with.
constexpr int kCare = 4;
constexpr double kCarefulShare = 0.3;

/// No part of a step that is cut is shorter than this share of it.
constexpr double kLeastStep = 1e-4;

/// Iterations of a proof of rest that does not follow a change of the acceleration, at most.
constexpr int kWarmRestIterations = 30;

/// Iterations of a proof of rest in which R follows the loads that are found. Beyond them it would jump to and fro.
constexpr int kSettling = 60;

/// Rounds of activating manifolds that a step may take.
constexpr int kRounds = 12;

/// Largest rotation that a step's arms are predicted for, rad.
constexpr double kLargestTurn = 0.25;

std::size_t at(std::int32_t index) { return static_cast<std::size_t>(index); }

Vec3 linear(const BodyVector& v) { return {v.row[0], v.row[1], v.row[2]}; }
Vec3 angular(const BodyVector& v) { return {v.row[3], v.row[4], v.row[5]}; }
BodyVector body_vector(const Vec3& linear, const Vec3& angular) {
  return {{linear.x(), linear.y(), linear.z(), angular.x(), angular.y(), angular.z(), 0.0, 0.0}};
}

/// Velocity of body `body` (negative: a side) at a point.
Vec3 velocity_at(const Bodies& bodies, std::int32_t body, const Vec3& point) {
  if (body < 0) return Vec3::Zero();
  const StateColumns& state = bodies.state;
  return state.velocity[at(body)] + state.angular_velocity[at(body)].cross(point - state.position[at(body)]);
}

/// Velocity of b's surface relative to a's, m/s.
Vec3 relative_velocity(const Bodies& bodies, const Manifold& manifold, const ContactPoint& point) {
  return velocity_at(bodies, manifold.b, point.on_b) - velocity_at(bodies, manifold.a, point.on_a);
}

/// Speed at which the surfaces part at a point, m/s.
double parting(const Bodies& bodies, const Manifold& manifold, const ContactPoint& point) {
  return manifold.contact.normal.dot(relative_velocity(bodies, manifold, point));
}

bool is_fixed(const Bodies& bodies, std::int32_t body) { return body < 0 || bodies.fixed[at(body)] != 0; }

}  // namespace

bool is_deep(const ContactSet& contact, const ContactSet& before) {
  return contact.count > 0 && contact.nearest_gap() < std::min(0.0, before.nearest_gap()) - kDeepOverlap;
}

double least_overlap(const StepTerms& terms) {
  return std::max(kTouch, std::min(kOverlap, kOverlapShare * terms.velocity_unit * terms.step));
}

double contact_reach(const StepTerms& terms, double approach) {
  // What bodies fall in a step, what they approach, and a little for what rounding may hide.
  return 1e-5 + 1.2 * terms.step * approach + terms.reach;
}

/// The first overlap that a step would bring.
struct IslandStepper::Event {
  bool activated = false;                                 ///< manifolds became active: the step must be solved again
  double time = std::numeric_limits<double>::infinity();  ///< of the first fast impact, s from the step's start
};

/// Contacts that are part of the solve: closed, or closing slower than what is located in time, or closing at all
/// once nothing more is located.
bool IslandStepper::is_solved(const ContactPoint& point, double parting, const StepTerms& terms, double step) const {
  const double slow_gap = std::max(kTouch, fast_approach(terms) * step);
  return point.gap <= slow_gap || (!may_cut_ && point.gap + step * parting < slow_gap);
}

/// Speed from which impacts are located in time, m/s.
double IslandStepper::fast_approach(const StepTerms& terms) const {
  return std::max(kFastShare * terms.velocity_unit, options_.impact_length / terms.step);
}

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
  turn_mid_.assign(island.bodies.size(), Rotation::Identity());
  turn_end_.assign(island.bodies.size(), Rotation::Identity());
  turning_.assign(island.bodies.size() + 1, 0);
  solver_.load_unit = terms.pull.norm() * (purpose == Purpose::smooth ? step : terms.step);

  for (const std::uint32_t body : island.bodies) {
    const auto place = at(place_[body]);
    const StateColumns& state = bodies.state;
    switch (purpose) {
      case Purpose::rest:
        solver_.free_velocity[place] = body_vector(step * terms.pull, Vec3::Zero());
        break;
      case Purpose::impact:
        solver_.free_velocity[place] = body_vector(state.velocity[body], state.angular_velocity[body]);
        solver_.velocity[place] = solver_.free_velocity[place];
        break;
      case Purpose::projection:
        break;
      case Purpose::smooth:
        break;
    }
  }
  if (purpose == Purpose::smooth) predict(scene, island, terms, step);

  captures_ = false;
  solver_.patches.clear();
  solver_.mid_arms.clear();
  solver_.patch_pair.clear();
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
      turn_mid_[place] = rotation_by(clamped(step * (3.0 * w + w_guess) / 8.0, 0.5 * kLargestTurn));
      turn_end_[place] = rotation_by(clamped(step * (w + w_guess) / 2.0, kLargestTurn));
      const Mat3 axes = turn_end_[place].toRotationMatrix() * bodies.shape[body].axes;
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
  int used = 0;
  for (int i = 0; i < manifold.contact.count; ++i) {
    const ContactPoint& point = manifold.contact.points[at(i)];
    const double parting_speed = parting(bodies, manifold, point);
    const bool moving = purpose == Purpose::smooth || purpose == Purpose::impact;
    if (moving ? !is_solved(point, parting_speed, terms, step) : point.gap > kTouch) continue;
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
        patch.allowance.row[0][lane] = point.gap > kTouch ? point.gap / step : 0.0;
        if (purpose == Purpose::smooth) {
          captures_ =
              captures_ || std::max(0.0, point.gap) + step * parting_speed < -kJumpShare * terms.velocity_unit * step;
          // Friction along the mean slip makes curved paths second order in the step.
          const Vec3 slip = relative_velocity(bodies, manifold, point);
          const Vec3 slide = slip - manifold.contact.normal * manifold.contact.normal.dot(slip);
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

SplittingResult IslandStepper::run(const SplittingOptions& options, const StepTerms& terms, double step,
                                   IslandReport& report) {
  const double unit = terms.pull.norm() * step;
  const double scale = unit > 0.0 ? unit : 1e-3 * step;
  SplittingResult result = solver_.solve(options, scale);
  report.iterations += static_cast<std::uint64_t>(result.iterations);
  const bool diverged = !(result.residual < kDiverged * scale);
  if (diverged || (options.more_iterations > 0 && result.residual > kStuck * scale)) {
    SplittingOptions careful = options;
    careful.accelerate = false;
    careful.sticking *= kCarefulShare;
    careful.sliding *= kCarefulShare;
    careful.more_iterations = kCare * (options.iterations + options.more_iterations);
    if (diverged) solver_.restart(solver_.free_velocity);
    result = solver_.solve(careful, scale);
    report.iterations += static_cast<std::uint64_t>(result.iterations);
  }
  return result;
}

void IslandStepper::remember(Scene& scene, const IslandView& island, double step) const {
  // Points that were not part of the solve carry nothing.
  for (const std::uint32_t index : island.manifolds) scene.manifolds[index].memory.fill(PointMemory{});
  for (std::size_t p = 0; p < sources_.size(); ++p) {
    const Patch& patch = solver_.patches[p];
    Manifold& manifold = scene.manifolds[sources_[p].manifold];
    for (std::size_t lane = 0; lane < static_cast<std::size_t>(patch.count); ++lane) {
      PointMemory& memory = manifold.memory[sources_[p].point[lane]];
      memory = PointMemory{};
      for (std::size_t d = 0; d < 3; ++d) {
        const Vec3 direction(patch.directions[d][0], patch.directions[d][1], patch.directions[d][2]);
        memory.force += (patch.impulse.row[d][lane] / step) * direction;
        memory.slip += (patch.slip.row[d][lane] - (d > 0 ? patch.allowance.row[d][lane] : 0.0)) * direction;
      }
    }
  }
}

bool IslandStepper::rests(Scene& scene, const IslandView& island, const StepTerms& terms, IslandReport& report) {
  load(scene, island, terms, Purpose::rest, terms.step);
  if (solver_.imbalance_at_rest(terms.velocity_unit) <= options_.rest_tolerance) return true;
  SplittingOptions tight;
  tight.iterations = 10;
  tight.tolerance = 0.1 * options_.rest_tolerance;
  tight.relaxation = 1.6;
  tight.sticking = 100.0;
  tight.sliding = 100.0;
  tight.reclassify_every = 1 << 30;
  tight.accelerate = true;
  // Boxes that come to rest have nearly the right forces already; where they have not, later is soon enough.
  const int most = terms.cold ? options_.rest_iterations : kWarmRestIterations;
  for (int done = 0; done < most; done += tight.iterations) {
    tight.keep_resistance = done >= kSettling;
    run(tight, terms, terms.step, report);
    std::vector<BodyVector> velocity = solver_.velocity;
    if (solver_.imbalance_at_rest(terms.velocity_unit) <= options_.rest_tolerance) {
      remember(scene, island, terms.step);
      return true;
    }
    solver_.velocity = std::move(velocity);
  }
  remember(scene, island, terms.step);
  // How the bodies begin to move, nearly.
  for (const std::uint32_t body : island.bodies) {
    scene.bodies.acceleration[body] = linear(solver_.velocity[at(place_[body])]) / terms.step;
    scene.bodies.angular_acceleration[body] = angular(solver_.velocity[at(place_[body])]) / terms.step;
  }
  return false;
}

/// Velocity of a body of the island at a point after the solve, m/s.
Vec3 IslandStepper::end_velocity(const Bodies& bodies, std::int32_t body, const Vec3& point) const {
  if (is_fixed(bodies, body)) return Vec3::Zero();
  const BodyVector& v = solver_.velocity[at(place_[at(body)])];
  return linear(v) + angular(v).cross(point - bodies.state.position[at(body)]);
}

void IslandStepper::resolve_impacts(Scene& scene, const IslandView& island, const StepTerms& terms, double step,
                                    IslandReport& report) {
  Bodies& bodies = scene.bodies;
  double fastest = 0.0;
  const double fast = fast_approach(terms);
  struck_.assign(scene.manifolds.size(), 0);
  for (const std::uint32_t index : island.manifolds) {
    Manifold& manifold = scene.manifolds[index];
    // Without rebound, and not located in time, an impact needs no solve of its own.
    if (options_.impact_cuts == 0 && manifold.restitution == 0.0) continue;
    for (int i = 0; i < manifold.contact.count; ++i) {
      const ContactPoint& point = manifold.contact.points[at(i)];
      const double speed = parting(bodies, manifold, point);
      if (!is_solved(point, speed, terms, step) || std::max(0.0, point.gap) + step * speed >= -fast * step) continue;
      struck_[index] |= static_cast<std::uint8_t>(1U << i);
      fastest = std::max(fastest, -speed);
    }
  }
  if (fastest == 0.0) return;
  SplittingOptions options;
  options.iterations = 2 * options_.iterations;
  options.tolerance = options_.tolerance;
  options.accelerate = true;
  const double unit = std::max(fastest, terms.velocity_unit);
  // An impact acts where surfaces meet, and from there where it would push others into each other: a contact that
  // need not answer it has no impulse, and no friction.
  for (int round = 0; round < kRounds; ++round) {
    for (const std::uint32_t index : island.manifolds) {
      if (struck_[index] == 0) continue;
      scene.manifolds[index].active = true;
      scene.manifolds[index].idle_steps = 0;
    }
    load(scene, island, terms, Purpose::impact, step);
    // What a contact carries is measured by the blow: by the weight in a step, R would be far too large.
    solver_.load_unit = unit;
    const SplittingResult result = solver_.solve(options, unit);
    report.iterations += static_cast<std::uint64_t>(result.iterations);
    if (strike_more(scene, island, terms, step)) continue;
    // In units of its own velocities, as that of other solves.
    report.residual = std::max(report.residual, terms.velocity_unit / unit * result.residual);
    break;
  }
  for (const std::uint32_t body : island.bodies) {
    bodies.state.velocity[body] = linear(solver_.velocity[at(place_[body])]);
    bodies.state.angular_velocity[body] = angular(solver_.velocity[at(place_[body])]);
  }
}

/// Adds the points that the solved impact pushes into each other. False when there are none.
bool IslandStepper::strike_more(const Scene& scene, const IslandView& island, const StepTerms& terms, double step) {
  const Bodies& bodies = scene.bodies;
  bool more = false;
  for (const std::uint32_t index : island.manifolds) {
    const Manifold& manifold = scene.manifolds[index];
    for (int i = 0; i < manifold.contact.count; ++i) {
      const ContactPoint& point = manifold.contact.points[at(i)];
      if ((struck_[index] >> i & 1) != 0 || !is_solved(point, parting(bodies, manifold, point), terms, step)) continue;
      const double after = manifold.contact.normal.dot(end_velocity(bodies, manifold.b, point.on_b) -
                                                       end_velocity(bodies, manifold.a, point.on_a));
      if (std::max(0.0, point.gap) + step * after >= -kSlipShare * terms.velocity_unit * step) continue;
      struck_[index] |= static_cast<std::uint8_t>(1U << i);
      more = true;
    }
  }
  return more;
}

IslandStepper::Event IslandStepper::find_overlap(Scene& scene, const IslandView& island, const StepTerms& terms,
                                                 double step) const {
  Event event;
  const Bodies& bodies = scene.bodies;
  const double overlap = least_overlap(terms);
  for (const std::uint32_t index : island.manifolds) {
    Manifold& manifold = scene.manifolds[index];
    for (int i = 0; i < manifold.contact.count; ++i) {
      const ContactPoint& point = manifold.contact.points[at(i)];
      const double u0 = parting(bodies, manifold, point);
      const bool solved = is_solved(point, u0, terms, step);
      if (manifold.active && solved) continue;
      const double u1 = manifold.contact.normal.dot(end_velocity(bodies, manifold.b, point.on_b) -
                                                    end_velocity(bodies, manifold.a, point.on_a));
      const double gap_end = point.gap + 0.5 * step * (u0 + u1);
      if (gap_end >= -overlap) continue;
      // gap + u0 t + (u1 − u0) t² / (2 step) = 0, the root in the step, in the form without cancellation.
      const double curvature = (u1 - u0) / step;
      const double root = std::sqrt(std::max(0.0, u0 * u0 - 2.0 * curvature * point.gap));
      const double time = u0 < root ? 2.0 * point.gap / (root - u0) : step;
      const bool fast = -(u0 + curvature * time) > fast_approach(terms);
      if (!may_cut_ || !fast || solved) {
        manifold.active = true;
        manifold.idle_steps = 0;
        event.activated = true;
      } else {
        event.time = std::min(event.time, std::max(time, kLeastStep * terms.step));
      }
    }
  }
  return event;
}

void IslandStepper::move(Scene& scene, const IslandView& island, const StepTerms& terms, double step, double share) {
  Bodies& bodies = scene.bodies;
  const double time = share * step;
  for (const std::uint32_t body : island.bodies) {
    const auto place = at(place_[body]);
    Vec3& v = bodies.state.velocity[body];
    Vec3& w = bodies.state.angular_velocity[body];
    const Vec3 v_end = linear(solver_.velocity[place]);
    const Vec3 w_end = angular(solver_.velocity[place]);
    const Vec3 v_new = share == 1.0 ? v_end : Vec3(v + share * (v_end - v));
    Vec3 w_new = share == 1.0 ? w_end : Vec3(w + share * (w_end - w));
    // The trapezoid: exact under constant forces. A velocity that jumps, at an impact too slow to be located, has
    // its new value from the start of the step: with the old one bodies would overlap.
    const double jump = (v_end - v - step * bodies.acceleration[body]).norm() +
                        bodies.radius[body] * (w_end - w - step * bodies.angular_acceleration[body]).norm();
    const bool jumps = captures_ && !terms.cold && share == 1.0 && jump > kJumpShare * terms.velocity_unit;
    const Vec3 v_mean = jumps ? v_new : Vec3(0.5 * (v + v_new));
    const Vec3 w_mean = jumps ? w_new : Vec3(0.5 * (w + w_new));
    bodies.acceleration[body] = jumps ? Vec3::Zero() : Vec3((v_end - v) / step);
    bodies.angular_acceleration[body] = jumps ? Vec3::Zero() : Vec3((w_end - w) / step);
    bodies.state.position[body] += time * v_mean;
    const Vec3 turn = time * w_mean;
    if (turn != Vec3::Zero()) {
      Rotation& orientation = bodies.state.orientation[body];
      orientation = (rotation_by(turn) * orientation).normalized();
    }
    bodies.update_shape(body);
    if (share == 1.0 && turning_[place] != 0)
      w_new = bodies.inertia(body).inverse() * (solver_.bodies[place].inertia * w_end);
    v = v_new;
    w = w_new;
  }
}

/// Finds the contacts of the island anew. True when bodies have met deeply.
bool IslandStepper::renew(Scene& scene, const IslandView& island, const StepTerms& terms) {
  bool deep = false;
  for (const std::uint32_t index : island.manifolds) {
    Manifold& manifold = scene.manifolds[index];
    scene.undo.emplace_back(index, manifold);
    double reach = terms.reach;
    for (int i = 0; i < manifold.contact.count; ++i) reach = std::max(reach, manifold.contact.points[at(i)].gap);
    const ContactSet contact = contact_now(manifold, scene.bodies, scene.sides, contact_reach(terms, 0.0) + reach);
    deep = deep || is_deep(contact, manifold.contact);
    renew_contact(manifold, contact);
  }
  return deep;
}

void IslandStepper::project(Scene& scene, const IslandView& island, const StepTerms& terms) {
  bool any = false;
  for (const std::uint32_t index : island.manifolds) {
    Manifold& manifold = scene.manifolds[index];
    for (int i = 0; i < manifold.contact.count; ++i) {
      if (manifold.contact.points[at(i)].gap >= -options_.overlap) continue;
      any = true;
      manifold.active = true;
    }
  }
  if (!any) return;
  load(scene, island, terms, Purpose::projection, terms.step);
  SplittingOptions options;
  options.iterations = 24;
  options.tolerance = 1e-6;
  solver_.solve(options, 1.0);
  for (const std::uint32_t body : island.bodies) {
    const BodyVector& shift = solver_.velocity[at(place_[body])];
    scene.bodies.state.position[body] += linear(shift);
    const Vec3 turn = clamped(angular(shift), kLargestTurn);
    if (turn != Vec3::Zero()) {
      Rotation& orientation = scene.bodies.state.orientation[body];
      orientation = (rotation_by(turn) * orientation).normalized();
    }
    scene.bodies.update_shape(body);
  }
  renew(scene, island, terms);
}

void IslandStepper::advance(Scene& scene, const IslandView& island, const StepTerms& terms, IslandReport& report) {
  project(scene, island, terms);
  SplittingOptions options;
  options.tolerance = terms.cold ? 1e-3 * options_.tolerance : options_.tolerance;
  options.iterations = terms.cold ? options_.cold_iterations : options_.iterations;
  options.more_iterations = 4 * options_.iterations;
  options.accelerate = terms.cold;

  double remaining = terms.step;
  int cuts = 0;
  int stops = 0;
  while (remaining > 0.0) {
    may_cut_ = cuts < options_.impact_cuts;
    double step = remaining;
    resolve_impacts(scene, island, terms, step, report);
    Event event;
    for (int round = 0; round < kRounds; ++round) {
      load(scene, island, terms, Purpose::smooth, step);
      const SplittingResult result = run(options, terms, step, report);
      event = find_overlap(scene, island, terms, step);
      if (!event.activated) {
        const double stop = stops < options_.stop_cuts && step == remaining ? first_stop(scene, terms, step) : step;
        if (stop >= step || stop >= event.time) {
          report.residual = std::max(report.residual, result.residual);
          break;
        }
        // Forces change where a slip ends: what comes before is a step of its own.
        step = stop;
        continue;
      }
      remember(scene, island, step);
    }
    remember(scene, island, step);
    const double share = event.time < step ? event.time / step : 1.0;
    move(scene, island, terms, step, share);
    if (share == 1.0 && step == remaining) return;
    if (renew(scene, island, terms)) report.met_deep = true;
    remaining -= share * step;
    // What is left is rounding: divided by it, velocities would be anything.
    if (remaining <= kLeastStep * terms.step) return;
    ++(share < 1.0 ? cuts : stops);
  }
}

/// Time until the first slip ends or turns back within the step, by the acceleration of the last step; `step` when
/// none does.
double IslandStepper::first_stop(const Scene& scene, const StepTerms& terms, double step) const {
  const Bodies& bodies = scene.bodies;
  const auto rate = [&](std::int32_t body, const Vec3& point) -> Vec3 {
    if (is_fixed(bodies, body)) return Vec3::Zero();
    return bodies.acceleration[at(body)] +
           bodies.angular_acceleration[at(body)].cross(point - bodies.state.position[at(body)]);
  };
  double first = step;
  for (std::size_t p = 0; p < sources_.size(); ++p) {
    const Manifold& manifold = scene.manifolds[sources_[p].manifold];
    const Vec3& normal = manifold.contact.normal;
    for (std::size_t lane = 0; lane < static_cast<std::size_t>(solver_.patches[p].count); ++lane) {
      if (!(solver_.patches[p].impulse.row[0][lane] > 0.0)) continue;
      const ContactPoint& point = manifold.contact.points[sources_[p].point[lane]];
      const auto tangential = [&](const Vec3& v) -> Vec3 { return v - normal * normal.dot(v); };
      const Vec3 slip = tangential(relative_velocity(bodies, manifold, point));
      const double speed = slip.norm();
      if (speed <= kSlipShare * terms.velocity_unit) continue;
      const Vec3 end =
          tangential(end_velocity(bodies, manifold.b, point.on_b) - end_velocity(bodies, manifold.a, point.on_a));
      // It goes on when it keeps some speed in its direction.
      if (end.dot(slip) > kSlipShare * speed * speed) continue;
      const double slowing = -slip.dot(tangential(rate(manifold.b, point.on_b) - rate(manifold.a, point.on_a))) / speed;
      if (slowing > 0.0) first = std::min(first, speed / slowing);
    }
  }
  // A cut right at the start or the end of the step would change nothing.
  return first > kLeastStep * terms.step && first < step - kLeastStep * terms.step ? first : step;
}

}  // namespace holdfast::native
