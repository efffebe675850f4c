#include "validate/answers/stack.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace holdfast::internal {

namespace {

/// The stack as a pendulum on its lowest edge.
struct Pendulum {
  double rate = 0.0;   ///< M r / I, 1/m
  double angle = 0.0;  ///< of the centre of mass from the vertical at rest, rad
  double reach = 0.0;  ///< of the top box's centre from the edge, m
};

Pendulum pendulum_of(const Stack& stack) {
  const double half_length = 0.5 * stack.box_size.x();
  const double height = stack.box_size.z();
  double mass = 0.0;
  double moment = 0.0;
  double inertia = 0.0;
  double z = 0.5 * height;
  double top = z;
  for (const double m : stack.masses) {
    mass += m;
    moment += m * z;
    // The moment about the centre of the box, and the parallel axis theorem.
    inertia += m * ((4.0 * half_length * half_length + height * height) / 12.0 + half_length * half_length + z * z);
    top = z;
    z += height;
  }
  const double centre = moment / mass;
  return {mass * std::hypot(half_length, centre) / inertia, std::atan2(half_length, centre),
          std::hypot(half_length, top)};
}

/// Angle after `duration` from rest under the acceleration, rad; classical Runge-Kutta.
double angle_after(const Pendulum& pendulum, double gravity, double load, double duration) {
  constexpr int kSteps = 2000;
  const double h = duration / kSteps;
  const auto acceleration = [&](double theta) {
    const double lean = pendulum.angle - theta;
    return pendulum.rate * (load * std::cos(lean) - gravity * std::sin(lean));
  };
  double theta = 0.0;
  double omega = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double k1 = acceleration(theta);
    const double k2 = acceleration(theta + 0.5 * h * omega);
    const double k3 = acceleration(theta + 0.5 * h * omega + 0.25 * h * h * k1);
    const double k4 = acceleration(theta + h * omega + 0.5 * h * h * k2);
    theta += h * omega + h * h / 6.0 * (k1 + k2 + k3);
    omega += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  }
  return theta;
}

}  // namespace

Stack even_stack(std::size_t count, const Vec3& box_size, double friction) {
  return {box_size, std::vector<double>(count, 1.0), friction};
}

Scene scene_of(const Stack& stack) {
  const double height = stack.box_size.z() * static_cast<double>(stack.masses.size());
  Scene scene = empty_scene({20.0, 20.0, height + 5.0}, stack.friction);
  double z = 0.0;
  for (const double mass : stack.masses) {
    scene.boxes.push_back(
        standing_box(stack.box_size, {10.0 - 0.5 * stack.box_size.x(), 10.0 - 0.5 * stack.box_size.y(), z}));
    scene.boxes.back().mass = mass;
    z += stack.box_size.z();
  }
  return scene;
}

double tipping_load(const Stack& stack, double gravity) {
  double least = std::numeric_limits<double>::infinity();
  double mass = 0.0;
  double moment = 0.0;  // of the masses above the joint, relative to its height
  // From the top down: for the next lower joint all boxes above are one box higher.
  for (auto m = stack.masses.rbegin(); m != stack.masses.rend(); ++m) {
    moment += mass * stack.box_size.z() + *m * 0.5 * stack.box_size.z();
    mass += *m;
    least = std::min(least, gravity * 0.5 * stack.box_size.x() * mass / moment);
  }
  return least;
}

double sliding_load(const Stack& stack, double gravity) { return stack.friction * gravity; }

double load_that_tips(const Stack& stack, double gravity, double distance, double duration) {
  const Pendulum pendulum = pendulum_of(stack);
  const double wanted = 2.0 * std::asin(0.5 * distance / pendulum.reach);
  const double limit = tipping_load(stack, gravity);
  double low = limit;
  double high = 2.0 * limit;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (angle_after(pendulum, gravity, middle, duration) < wanted ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace holdfast::internal
