#include "core/native/island.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/native/island_motion.hpp"
#include "core/native/rotation_step.hpp"

namespace holdfast::internal::native {

namespace {

/// Overlap at the end of a step that calls for a contact to be solved: at most this, m, and this share of |g − a| h².
constexpr double kOverlap = 5e-6;
constexpr double kOverlapShare = 0.01;

/// What is cut off at an impact is no shorter than this share of a step: divided by what is but rounding, velocities
/// would be anything.
constexpr double kLeastRest = 1e-9;

/// Rounds of activating manifolds that a step may take.
constexpr int kRounds = 12;

/// Where bodies are slower than |g − a| h, less of a residual may pass, in proportion: whether they move at all hangs
/// on it. No less than this share.
constexpr double kSlow = 0.04;

/// What contacts without load stand ready for in a crowd, see `SplittingOptions`: it settles sooner with much. Where
/// few bodies are, it would hold back what parts.
constexpr double kCrowdReady = 1.0;

/// Bodies that lean on others are asked for a proof of rest where none begins to move faster than this share of
/// |g − a| h. With 0.02 the verdict of rows near their limit depends on the accuracy; with 0.3 loads under the road
/// accelerations take 11 % more time, and no verdict changes.
constexpr double kLeaningMotion = 0.1;

/// How far positions are corrected: to this share of the overlap that is left alone.
constexpr double kProjected = 0.1;

/// Iterations of a moving step that could not be solved, over those of others.
constexpr int kCare = 4;

/// A residual above this many |g − a| h, or none at all, is that of an iteration that diverges: it starts again, with
/// this share of R.
constexpr double kDiverged = 10.0;
constexpr double kCarefulShare = 0.3;

/// Iterations of a proof of rest until its loads are nearly found.
constexpr int kSettling = 60;

/// R of a proof of rest, over the mass that a contact carries, until then and after it. Large R is slow to begin with
/// and quick at the end. Near the limit of balance (bridged stacks of 20 to 40 boxes, 0.995 to 0.999 of it) 1000 takes
/// 200 to 500 iterations where 100 takes 500 to 10,000; 300 and 3000 take up to twice as many. Far from the limit 1000
/// from the start would take twice as many.
constexpr double kRestStiffness = 100.0;
constexpr double kLateRestStiffness = 1000.0;

/// Tolerance of velocities in a proof of rest, over that of its balance.
constexpr double kBalanceTolerance = 0.1;

/// Iterations of a proof of rest that does not follow a change of the acceleration, at most.
constexpr int kWarmRestIterations = 30;

/// Root of the mean square of the bodies' speeds, m/s.
double mean_speed(const Bodies& bodies, const IslandView& island) {
  double squares = 0.0;
  for (const std::uint32_t body : island.bodies) squares += bodies.state.velocity[body].squaredNorm();
  return std::sqrt(squares / static_cast<double>(island.bodies.size()));
}

}  // namespace

bool overlaps_unseen(const ContactSet& contact, const ContactSet& before, double deep) {
  return contact.count > 0 && contact.nearest_gap() < std::min(0.0, before.nearest_gap()) - deep;
}

double least_overlap(const StepTerms& terms, double late) {
  return std::max({late, kTouch, std::min(kOverlap, kOverlapShare * terms.velocity_unit * terms.step)});
}

double contact_reach(const StepTerms& terms, double approach) {
  // What bodies fall in a step, what they approach, and a little for what rounding may hide.
  return 1e-5 + 1.2 * terms.longest_step * approach + terms.reach;
}

double contact_reach(const StepTerms& terms, const Bodies& bodies, std::int32_t a, std::int32_t b) {
  const StateColumns& state = bodies.state;
  const Vec3& v = state.velocity[at(b)];
  const double approach = a < 0 ? v.norm() : (v - state.velocity[at(a)]).norm() + bodies.spin(at(a));
  return contact_reach(terms, approach + bodies.spin(at(b)));
}

SplittingResult IslandStepper::run(const SplittingOptions& options, const StepTerms& terms, double step,
                                   IslandReport& report) {
  const double unit = terms.pull.norm() * step;
  const double scale = unit > 0.0 ? unit : 1e-3 * step;
  SplittingResult result = solver_.solve(options, scale);
  report.iterations += static_cast<std::uint64_t>(result.iterations);
  const bool diverged = !(result.residual < kDiverged * scale);
  if (!diverged && (options.more_iterations == 0 || result.residual <= options.worst_residual * scale)) return result;
  SplittingOptions careful = options;
  careful.accelerate = false;
  careful.more_iterations = kCare * (options.iterations + options.more_iterations);
  if (diverged) {
    careful.sticking *= kCarefulShare;
    careful.sliding *= kCarefulShare;
    solver_.restart(solver_.free_velocity);
  }
  result = solver_.solve(careful, scale);
  report.iterations += static_cast<std::uint64_t>(result.iterations);
  return result;
}

void IslandStepper::remember(Scene& scene, const IslandView& island, Purpose purpose, double step) const {
  const bool stepped = purpose == Purpose::smooth;
  // Points that were not part of the solve carry nothing.
  for (const std::uint32_t index : island.manifolds) {
    for (PointMemory& memory : scene.manifolds[index].memory) memory = {.pressed = stepped ? 0.0 : memory.pressed};
  }
  for (std::size_t p = 0; p < sources_.size(); ++p) {
    const Patch& patch = solver_.patches[p];
    Manifold& manifold = scene.manifolds[sources_[p].manifold];
    for (std::size_t lane = 0; lane < static_cast<std::size_t>(patch.count); ++lane) {
      PointMemory& memory = manifold.memory[sources_[p].point[lane]];
      if (stepped) memory.pressed = patch.impulse.row[0][lane] / step;
      if (!stepped && std::isfinite(solver_.most_normal[p].lane[lane]))
        memory.pressed = solver_.most_normal[p].lane[lane] / (kPressedMore * step);
      for (std::size_t d = 0; d < 3; ++d) {
        const Vec3 direction(patch.directions[d][0], patch.directions[d][1], patch.directions[d][2]);
        memory.force += (patch.impulse.row[d][lane] / step) * direction;
        memory.slip += (patch.slip.row[d][lane] - (d > 0 ? patch.allowance.row[d][lane] : 0.0)) * direction;
      }
    }
  }
}

bool IslandStepper::rests(Scene& scene, const IslandView& island, const StepTerms& terms, bool leans,
                          IslandReport& report) {
  load(scene, island, terms, Purpose::rest, terms.step);
  if (solver_.imbalance_at_rest(terms.velocity_unit) <= options_.rest_tolerance) return true;
  bool rests = !leans && find_balance(terms, report);
  if (!rests) {
    begin_motion(island, terms, report);
    // Forces that merely balance could lie in contacts that nothing pushes.
    if (terms.cold && admit_pushed(scene) && solver_.largest_speed() < kLeaningMotion * terms.velocity_unit)
      rests = find_balance(terms, report);
  }
  remember(scene, island, Purpose::rest, terms.step);
  if (rests) return true;
  for (const std::uint32_t body : island.bodies) {
    scene.bodies.acceleration[body] = linear(solver_.velocity[at(place_[body])]) / terms.step;
    scene.bodies.angular_acceleration[body] = angular(solver_.velocity[at(place_[body])]) / terms.step;
  }
  return false;
}

/// By Coulomb's law: how the bodies of the loaded island begin to move, and where the step goes on from. As exact as a
/// proof of rest, since just above the limit of balance they hardly do.
void IslandStepper::begin_motion(const IslandView& island, const StepTerms& terms, IslandReport& report) {
  effort_ = options_.effort(island.bodies.size());
  SplittingOptions options = cold_options();
  options.tolerance = std::min(options.tolerance, kBalanceTolerance * options_.rest_tolerance);
  run(options, terms, terms.step, report);
}

/// How a solve is made where the acceleration has just changed: to the end, since the last step is no guess for it.
SplittingOptions IslandStepper::cold_options() const {
  SplittingOptions options;
  options.tolerance = effort_.cold_tolerance;
  options.iterations = effort_.cold_iterations;
  options.accelerate = true;
  return options;
}

/// Lets a proof of rest use those contacts beside bodies that the beginning motion pushes, and no others; at walls no
/// more than it pushes. False when it pushes none.
bool IslandStepper::admit_pushed(const Scene& scene) {
  bool any = false;
  for (std::size_t p = 0; p < sources_.size(); ++p) {
    const Manifold& manifold = scene.manifolds[sources_[p].manifold];
    const bool wall = is_wall(scene.bodies, manifold);
    if (!wall && (supports(scene.bodies, manifold) || is_border(scene.bodies, manifold))) continue;
    for (std::size_t lane = 0; lane < static_cast<std::size_t>(solver_.patches[p].count); ++lane) {
      const double push = solver_.patches[p].impulse.row[0][lane];
      const double most = wall ? kPressedMore * push : std::numeric_limits<double>::infinity();
      solver_.most_normal[p].lane[lane] = push > 0.0 ? most : 0.0;
      any = any || push > 0.0;
    }
  }
  return any;
}

/// Looks for forces in the contacts' cones that balance the loaded island. The problem is convex: it ends with them, or
/// with a motion that proves that there are none.
bool IslandStepper::find_balance(const StepTerms& terms, IslandReport& report) {
  SplittingOptions options;
  // A look at the balance costs as much as an iteration: ten pass between two.
  options.iterations = 10;
  options.tolerance = kBalanceTolerance * options_.rest_tolerance;
  options.projection = Projection::orthogonal;
  options.relaxation = 1.6;
  // Its bodies' own mass, as in few: after a proof that fails the step goes on from here.
  options.ready = 0.01;
  options.accelerate = true;
  double island_mass = 0.0;
  for (const SolverBody& body : solver_.bodies) island_mass += body.mass;
  const double most = island_mass * terms.velocity_unit;
  // Boxes that come to rest have nearly the right forces already; where they have not, later is soon enough.
  const int iterations = terms.cold ? options_.rest_iterations : kWarmRestIterations;
  for (int done = 0; done < iterations; done += options.iterations) {
    // R follows the loads that are found; beyond that it would jump to and fro.
    options.refit_share = done <= kSettling ? 0.0 : 1.0;
    options.sticking = options.sliding = done < kSettling ? kRestStiffness : kLateRestStiffness;
    run(options, terms, terms.step, report);
    if (solver_.imbalance_at_rest(terms.velocity_unit) <= options_.rest_tolerance) return true;
    if (solver_.refutes_rest(most)) return false;
  }
  return false;
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
    // Where the acceleration has just changed, no velocity goes on as before, and only who has met jumps.
    const bool shows = captured_[place] != 0 || (!terms.cold && jump > kJumpShare * terms.velocity_unit);
    const bool jumps = captures_ && share == 1.0 && shows;
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
    const double reach = contact_reach(terms, scene.bodies, manifold.a, manifold.b);
    const ContactSet contact =
        contact_now(scene.bodies, scene.sides, manifold.a, manifold.b, reach, manifold.contact.axis);
    deep = deep || overlaps_unseen(contact, manifold.contact, options_.deep_overlap);
    renew_contact(manifold, contact, scene.bodies);
  }
  return deep;
}

void IslandStepper::project(Scene& scene, const IslandView& island, const StepTerms& terms, IslandReport& report) {
  bool any = false;
  for (const std::uint32_t index : island.manifolds) {
    Manifold& manifold = scene.manifolds[index];
    for (int i = 0; i < manifold.contact.count; ++i) {
      if (manifold.contact.points[at(i)].gap >= -effort_.overlap) continue;
      any = true;
      manifold.activate();
    }
  }
  if (!any) return;
  load(scene, island, terms, Purpose::projection, terms.step);
  SplittingOptions options;
  options.iterations = 24;
  options.tolerance = kProjected * effort_.overlap;
  report.iterations += static_cast<std::uint64_t>(solver_.solve(options, 1.0).iterations);
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
  effort_ = options_.effort(island.bodies.size());
  project(scene, island, terms, report);
  SplittingOptions options = terms.cold ? cold_options() : SplittingOptions{};
  if (!terms.cold) {
    options.tolerance = effort_.tolerance;
    options.iterations = effort_.iterations;
  }
  const double speed = mean_speed(scene.bodies, island);
  const double slow = speed < terms.velocity_unit ? std::max(kSlow, speed / terms.velocity_unit) : 1.0;
  options.mean_residual = slow * effort_.mean_residual;
  if (island.bodies.size() > kFewBodies) options.ready = kCrowdReady;
  options.more_iterations = 4 * effort_.iterations;

  double remaining = terms.step;
  int cuts = 0;
  int stops = 0;
  while (remaining > 0.0) {
    may_cut_ = cuts < effort_.impact_cuts;
    double step = remaining;
    resolve_impacts(scene, island, terms, step, report);
    Event event;
    SplittingResult result;
    met_.assign(scene.manifolds.size(), 0);
    for (int round = 0; round < kRounds;) {
      load(scene, island, terms, Purpose::smooth, step);
      result = run(options, terms, step, report);
      event = find_overlap(scene, island, terms, step);
      if (event.activated) {
        remember(scene, island, Purpose::smooth, step);
        ++round;
        continue;
      }
      const double stop = stops < effort_.stop_cuts && step == remaining ? first_stop(scene, terms, step) : step;
      if (stop >= step || stop >= event.time) break;
      // Forces change where a slip ends: what comes before is a step of its own.
      step = stop;
    }
    report.residual = std::max(report.residual, result.residual);
    remember(scene, island, Purpose::smooth, step);
    const double share = event.time < step - kLeastRest * terms.step ? event.time / step : 1.0;
    move(scene, island, terms, step, share);
    if (share == 1.0 && step == remaining) return;
    if (renew(scene, island, terms)) report.met_deep = true;
    remaining -= share * step;
    ++(share < 1.0 ? cuts : stops);
  }
}

}  // namespace holdfast::internal::native
