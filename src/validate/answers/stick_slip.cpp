#include "validate/answers/stick_slip.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace holdfast::internal {

namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

double sign(double number) { return number > 0.0 ? 1.0 : number < 0.0 ? -1.0 : 0.0; }

/// Time at which a speed that changes at a constant rate becomes zero, s; infinity if it does not.
double time_to_zero(double speed, double rate) { return speed * rate < 0.0 ? -speed / rate : kNever; }

/// What is left of `push` after the friction of the floor on a body, N: none while it holds the body, to the last bit,
/// so that rounding does not start it. Friction is opposite to the velocity, or to `push` if the body is at rest.
/// @param most that friction holds; `kinetic_share` of it is left as soon as the body slides
double left_by_floor(double velocity, double push, double most, double kinetic_share) {
  if (velocity != 0.0) return push - sign(velocity) * kinetic_share * most;
  return std::abs(push) <= most ? 0.0 : push - sign(push) * kinetic_share * most;
}

struct StackedAccelerations {
  double lower = 0.0;
  double upper = 0.0;
};

StackedAccelerations accelerations_of(const StackedBlocks& blocks, double field, double lower_velocity, double slip) {
  const double total = blocks.lower_mass + blocks.upper_mass;
  const double most_floor = blocks.floor_friction * total * blocks.gravity;
  const double most_upper = blocks.upper_friction * blocks.upper_mass * blocks.gravity;
  const double share = blocks.kinetic_share;
  double on_upper = -sign(slip) * share * most_upper;
  if (slip == 0.0) {
    const double united = left_by_floor(lower_velocity, total * field, most_floor, share) / total;
    on_upper = blocks.upper_mass * (united - field);
    if (std::abs(on_upper) <= most_upper) return {united, united};
    on_upper = sign(on_upper) * share * most_upper;
  }
  const double push = blocks.lower_mass * field - on_upper;
  const double lower = left_by_floor(lower_velocity, push, most_floor, share) / blocks.lower_mass;
  return {lower, field + on_upper / blocks.upper_mass};
}

}  // namespace

SlidePath slide_along(int axis, const Acceleration& acceleration, double friction, double gravity, double velocity,
                      double kinetic_share) {
  SlidePath path;
  double x = 0.0;
  for (const Phase& phase : phases_of(acceleration, acceleration.end_time())) {
    const double field = -phase.acceleration[axis];
    const double limit = friction * (gravity + phase.acceleration.z());
    double time = phase.begin;
    while (time < phase.end) {
      const double left = phase.end - time;
      if (velocity == 0.0 && std::abs(field) <= limit) break;
      const double direction = velocity != 0.0 ? sign(velocity) : sign(field);
      const double rate = field - direction * kinetic_share * limit;
      const double stop = time_to_zero(velocity, rate);
      const double span = std::min(stop, left);
      const double way = velocity * span + 0.5 * rate * span * span;
      x += way;
      path.distance += std::abs(way);
      time = span == left ? phase.end : time + span;
      velocity = stop <= left ? 0.0 : velocity + rate * span;
      if (velocity == 0.0) path.stop_time = time;
    }
  }
  path.displacement[axis] = x;
  path.velocity[axis] = velocity;
  return path;
}

SlidePath slide_over(const Acceleration& acceleration, double friction, double gravity, const Vec3& start_velocity) {
  constexpr double kStep = 1e-5;
  const double limit = friction * gravity;
  SlidePath path;
  path.velocity = start_velocity;
  for (const Phase& phase : phases_of(acceleration, acceleration.end_time())) {
    const Vec3 field(-phase.acceleration.x(), -phase.acceleration.y(), 0.0);
    const auto rate = [&](const Vec3& velocity) { return Vec3(field - limit * velocity.normalized()); };
    const double count = std::ceil((phase.end - phase.begin) / kStep);
    const double h = (phase.end - phase.begin) / count;
    for (double i = 0.0; i < count; ++i) {
      Vec3& velocity = path.velocity;
      if (velocity.isZero(0.0)) {
        if (field.norm() <= limit) break;
        // From rest it moves along the effective acceleration.
        const Vec3 start = (field.norm() - limit) * field.normalized();
        path.displacement += 0.5 * h * h * start;
        velocity = h * start;
        continue;
      }
      const double stop = velocity.norm() / (limit - field.dot(velocity.normalized()));
      if (field.norm() <= limit && stop <= h) {
        path.displacement += 0.5 * stop * velocity;
        path.stop_time = phase.begin + i * h + stop;
        velocity.setZero();
        continue;
      }
      const Vec3 k1 = rate(velocity);
      const Vec3 k2 = rate(velocity + 0.5 * h * k1);
      const Vec3 k3 = rate(velocity + 0.5 * h * k2);
      const Vec3 k4 = rate(velocity + h * k3);
      path.displacement += h * velocity + h * h / 6.0 * (k1 + k2 + k3);
      velocity += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    }
  }
  return path;
}

StackedPaths slide_stacked(const Acceleration& acceleration, const StackedBlocks& blocks) {
  StackedPaths at;
  double slip = 0.0;  // velocity of the upper block relative to the lower one
  for (const Phase& phase : phases_of(acceleration, acceleration.end_time())) {
    double left = phase.end - phase.begin;
    while (left > 0.0) {
      const auto [lower, upper] = accelerations_of(blocks, -phase.acceleration.x(), at.lower_velocity, slip);
      const double lower_stop = time_to_zero(at.lower_velocity, lower);
      const double slip_stop = time_to_zero(slip, upper - lower);
      const double span = std::min({left, lower_stop, slip_stop});
      at.lower += at.lower_velocity * span + 0.5 * lower * span * span;
      at.upper += at.upper_velocity * span + 0.5 * upper * span * span;
      slip = span == slip_stop ? 0.0 : slip + (upper - lower) * span;
      at.lower_velocity = span == lower_stop ? 0.0 : at.lower_velocity + lower * span;
      at.upper_velocity = at.lower_velocity + slip;
      left = span == left ? 0.0 : left - span;
    }
  }
  return at;
}

}  // namespace holdfast::internal
