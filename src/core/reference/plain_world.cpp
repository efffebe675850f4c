#include "core/reference/plain_world.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/engine/step_plan.hpp"
#include "core/model/container_panels.hpp"
#include "core/model/container_sides.hpp"

namespace holdfast::internal::plain {

namespace {

constexpr double kStepsPerSecond = 240.0;

/// The solver ends when a sweep changes no velocity by more than this fraction of what the effective gravity adds in a
/// step.
constexpr double kTolerance = 1e-10;
constexpr std::uint64_t kMostSweeps = 5000;
/// A larger fraction in the last sweep is reported as not converged.
constexpr double kNotConverged = 1e-3;
/// Least effective gravity used for the tolerance, m/s²: with zero the tolerance would be zero.
constexpr double kWeakField = 1e-3;

/// Approach speeds, relative to what the effective gravity adds in a step: below the first it is noise of a resting
/// contact, not an impact; up to the second a body does not rebound, so that it can come to rest.
constexpr double kImpact = 0.02;
constexpr double kRebound = 2.0;

/// Penetration slop, m: smaller than anything visible in results; it prevents contacts from alternating between open
/// and closed.
constexpr double kOverlapLeft = 1e-5;
/// Passes of the position correction; the distance within which they include other contacts, and their accuracy, m.
constexpr int kSeparatingPasses = 4;
constexpr double kHeeded = 1e-3;
constexpr double kSeparatingTolerance = 1e-9;

/// The rotation, rotated further by a rotation vector (rad, container frame). Uses the tangent of the half angle to
/// third order instead of sine and cosine, which C libraries round differently. The error is |turn|^5 / 120: 1e-9 rad
/// for ten rad/s and 240 steps per second.
Rotation turned(const Rotation& from, const Vec3& turn) {
  const Vec3 tangent = 0.5 * (1.0 + turn.squaredNorm() / 12.0) * turn;
  return (Rotation(1.0, tangent.x(), tangent.y(), tangent.z()) * from).normalized();
}

/// A tensor in the container's frame, from its principal values in body axes.
Eigen::Matrix3d in_container(const Rotation& container_from_body, const Vec3& principal) {
  const Eigen::Matrix3d axes = container_from_body.toRotationMatrix();
  return axes * principal.asDiagonal() * axes.transpose();
}

}  // namespace

double steps_per_second(const Settings& settings) { return settings.steps_per_second.value_or(kStepsPerSecond); }

Block PlainWorld::Body::block() const {
  return {position - orientation * centre_of_mass, half_extents, orientation.toRotationMatrix()};
}

Mover PlainWorld::Body::mover_at_rest() const {
  Mover mover{.inverse_mass = inverse_mass};
  if (!is_fixed()) mover.inverse_inertia = in_container(orientation, inertia.cwiseInverse());
  return mover;
}

double PlainWorld::Body::radius() const { return half_extents.norm() + centre_of_mass.norm(); }

PlainWorld::PlainWorld(const WorldBatch& batch, const World& world, const Settings& settings)
    : world_(world), settings_(settings) {
  const BoxView boxes = view(batch.boxes, world);
  const StateView state = view(batch.state, world);
  for (std::size_t i = 0; i < world.box_count; ++i) {
    bodies_.push_back({boxes.half_extents[i], boxes.centre_of_mass[i], 1.0 / boxes.mass[i], boxes.inertia[i],
                       boxes.surface[i], state.position[i], state.orientation[i], state.velocity[i],
                       state.angular_velocity[i]});
  }
  const std::vector<Panel> panels = container_panels(world.container, kWallThickness);
  std::vector<std::vector<double>> gaps;
  for (const Panel& panel : panels) {
    Side& made = sides_.emplace_back();
    made.half_space = {panel.normal, panel.offset};
    if (panel.ends) made.block = Block{panel.centre, panel.half_extents, Eigen::Matrix3d::Identity()};
    made.surface = panel.surface;
    made.play.assign(bodies_.size(), 0.0);
    std::vector<double>& gap = gaps.emplace_back(bodies_.size(), std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < bodies_.size(); ++i)
      for (const ContactPoint& point : points_with(made, i, kLeastPlay))
        // A box on the edge of a wall is not beside it.
        if (point.normal.dot(panel.normal) > 0.5) gap[i] = std::min(gap[i], point.gap);
  }
  std::vector<std::vector<double>> plays = panel_plays(panels, gaps);
  for (std::size_t k = 0; k < panels.size(); ++k) sides_[k].play = std::move(plays[k]);
}

double PlainWorld::advance(const Phase& phase) {
  field_ = Vec3(0.0, 0.0, -settings_.gravity) - phase.acceleration;
  const StepPlan plan(phase, steps_per_second(settings_));
  const std::uint64_t index = plan.steps_before(std::max(time_, phase.begin));
  take_step(plan.step());
  time_ = plan.end_of(index);
  return time_;
}

void PlainWorld::read_back(StateColumns& state) const {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const std::size_t row = world_.box_begin + i;
    state.position[row] = bodies_[i].position;
    state.orientation[row] = bodies_[i].orientation;
    state.velocity[row] = bodies_[i].velocity;
    state.angular_velocity[row] = bodies_[i].angular_velocity;
  }
}

/// The boxes, and the container as a fixed body after them.
std::vector<Mover> PlainWorld::movers() const {
  std::vector<Mover> movers;
  for (const Body& body : bodies_) {
    movers.push_back(body.mover_at_rest());
    movers.back().velocity = body.velocity;
    movers.back().angular_velocity = body.angular_velocity;
  }
  movers.emplace_back();
  return movers;
}

/// Contact points of a body with a side, which stands back by its play.
std::vector<ContactPoint> PlainWorld::points_with(const Side& side, std::size_t body, double margin) const {
  const double play = side.play[body];
  const Vec3& normal = side.half_space.normal;
  const Block block = bodies_[body].block();
  if (!side.block) return contact_points(HalfSpace{normal, side.half_space.offset - play}, block, margin);
  Block moved = *side.block;
  moved.centre -= play * normal;
  return contact_points(moved, block, margin);
}

/// @param first the surface of body a; a is the container if its index follows that of the last box
PlainWorld::Touch PlainWorld::touch_at(const ContactPoint& point, std::size_t a, std::size_t b,
                                       const Surface& first) const {
  const auto arm = [&](std::size_t i) -> Vec3 {
    return i < bodies_.size() ? Vec3(point.position - bodies_[i].position) : Vec3::Zero();
  };
  const Surface& second = bodies_[b].surface;
  return {.law = {a, b, arm(a), arm(b), point.normal, 0.0,
                  friction_of_pair(world_.contact, first, second, point.normal.z())},
          .gap = point.gap,
          .restitution = restitution_of_pair(first, second)};
}

/// All contact points that could close within the step (s), or whose gap is at most `slack` (m).
std::vector<PlainWorld::Touch> PlainWorld::find_touches(double step, double slack) const {
  const double gain = step * step * field_.norm() + slack;
  const auto reach = [&](const Body& body) { return step * body.angular_velocity.norm() * body.radius(); };
  std::vector<Touch> touches;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const Body& second = bodies_[b];
    const Block block = second.block();
    if (!second.is_fixed()) {
      const double margin = gain + step * second.velocity.norm() + reach(second);
      for (const Side& side : sides_)
        for (const ContactPoint& point : points_with(side, b, margin))
          touches.push_back(touch_at(point, bodies_.size(), b, side.surface));
    }
    for (std::size_t a = 0; a < b; ++a) {
      const Body& first = bodies_[a];
      if (first.is_fixed() && second.is_fixed()) continue;
      const double margin = gain + step * (second.velocity - first.velocity).norm() + reach(first) + reach(second);
      for (const ContactPoint& point : contact_points(first.block(), block, margin))
        touches.push_back(touch_at(point, a, b, first.surface));
    }
  }
  return touches;
}

/// Sets the smallest normal velocity after the step. False for a point that does not touch in this step: bodies that
/// will rebound are not slowed down while they approach each other.
/// @param before     velocities at the start of the step
/// @param unhindered velocities at its end without contacts
bool PlainWorld::demand(Touch& touch, const std::vector<Mover>& before, const std::vector<Mover>& unhindered,
                        double step) const {
  const double gap = std::max(touch.gap, 0.0);
  const double old = touch.law.normal.dot(relative_velocity(before, touch.law));
  const double gain = touch.law.normal.dot(relative_velocity(unhindered, touch.law)) - old;
  touch.law.least = -gap / step;
  if (touch.restitution == 0.0 || -old <= kRebound * field_.norm() * step) return true;

  // The bodies meet within the step and separate with their speed times the coefficient of restitution (Newton); the
  // effective gravity acts before and after the impact.
  const double closing = -(old + 0.5 * gain) * step;
  if (gap >= closing) return false;
  touch.impact = gap / closing;
  const double approach = -(old + touch.impact * gain);
  touch.law.least = std::max(0.0, touch.restitution * approach + (1.0 - touch.impact) * gain);
  return true;
}

/// For each body, the weight of its old velocity in its mean velocity over the step. One half is exact under constant
/// forces. A body whose velocity jumps in an impact has the old velocity before the impact and the new one after it;
/// otherwise it would penetrate the body that it hits. Impacts act instantly through all bodies that touch.
std::vector<double> PlainWorld::old_shares(const std::vector<Touch>& touches, const std::vector<Vec3>& impulses,
                                           const std::vector<Mover>& before, double step) const {
  constexpr double kNoImpact = std::numeric_limits<double>::infinity();
  std::vector<double> shares(bodies_.size() + 1, kNoImpact);
  std::vector<const PointLaw*> pressed;
  for (std::size_t i = 0; i < touches.size(); ++i) {
    const PointLaw& law = touches[i].law;
    if (law.normal.dot(impulses[i]) <= 0.0) continue;
    // The container and fixed bodies do not transmit impacts.
    if (before[law.a].inverse_mass > 0.0 && before[law.b].inverse_mass > 0.0) pressed.push_back(&law);
    if (-law.normal.dot(relative_velocity(before, law)) <= kImpact * field_.norm() * step) continue;
    for (const std::size_t body : {law.a, law.b}) shares[body] = std::min(shares[body], touches[i].impact);
  }
  for (bool changed = true; changed;) {
    changed = false;
    for (const PointLaw* law : pressed) {
      if (shares[law->a] == shares[law->b]) continue;
      shares[law->a] = shares[law->b] = std::min(shares[law->a], shares[law->b]);
      changed = true;
    }
  }
  std::replace(shares.begin(), shares.end(), kNoImpact, 0.5);
  return shares;
}

/// Moves a body through the step with its mean velocities. The impulses determine its angular momentum; the angular
/// velocity follows from it and the inertia at the end of the step, by fixed-point iteration.
void PlainWorld::move(Body& body, const Mover& after, double old_share, double step) const {
  if (body.is_fixed()) return;
  body.position += step * (old_share * body.velocity + (1.0 - old_share) * after.velocity);
  body.velocity = after.velocity;

  const Rotation start = body.orientation;
  const Vec3 momentum = in_container(start, body.inertia) * after.angular_velocity;
  Vec3 spin = after.angular_velocity;
  for (int i = 0; i < 4; ++i) {
    body.orientation = turned(start, step * (old_share * body.angular_velocity + (1.0 - old_share) * spin));
    spin = in_container(body.orientation, body.inertia.cwiseInverse()) * momentum;
  }
  body.angular_velocity = spin;
}

void PlainWorld::take_step(double step) {
  const std::vector<Mover> before = movers();
  std::vector<Mover> unhindered = before;
  for (Mover& mover : unhindered)
    if (mover.inverse_mass > 0.0) mover.velocity += step * field_;

  std::vector<Touch> touches = find_touches(step, kNothing);
  std::erase_if(touches, [&](Touch& touch) { return !demand(touch, before, unhindered, step); });
  std::vector<PointLaw> laws;
  for (const Touch& touch : touches) laws.push_back(touch.law);

  const double quantum = step * std::max(field_.norm(), kWeakField);
  std::vector<Mover> after = unhindered;
  const Solution solution = solve(after, laws, kTolerance * quantum, kMostSweeps);
  ++counters_.steps;
  counters_.solve_iterations += solution.sweeps;
  if (settings_.gravity > 0.0) counters_.note_residual(solution.residual, settings_.gravity * step);
  if (solution.residual > kNotConverged * quantum) status_ = status_ | Status::not_converged;

  const std::vector<double> shares = old_shares(touches, solution.impulses, before, step);
  for (std::size_t i = 0; i < bodies_.size(); ++i) move(bodies_[i], after[i], shares[i], step);
  separate();
}

/// Corrects penetrations above the slop, with the smallest displacements by mass and inertia: the laws of the solver
/// with displacements instead of velocities, and without friction. Velocities do not change: a penetration is an error
/// of the step, and must not become motion.
void PlainWorld::separate() {
  for (int pass = 0; pass < kSeparatingPasses; ++pass) {
    std::vector<PointLaw> laws;
    double deepest = 0.0;
    for (Touch& touch : find_touches(0.0, kHeeded)) {
      touch.law.friction = 0.0;
      touch.law.least = -(touch.gap + kOverlapLeft);
      laws.push_back(touch.law);
      deepest = std::max(deepest, -touch.gap);
    }
    if (deepest <= kOverlapLeft) return;

    std::vector<Mover> displaced;
    for (const Body& body : bodies_) displaced.push_back(body.mover_at_rest());
    displaced.emplace_back();
    counters_.solve_iterations += solve(displaced, laws, kSeparatingTolerance, kMostSweeps).sweeps;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      bodies_[i].position += displaced[i].velocity;
      bodies_[i].orientation = turned(bodies_[i].orientation, displaced[i].angular_velocity);
    }
  }
}

}  // namespace holdfast::internal::plain
