#pragma once

#include <vector>

#include "validate/laboratory/scene.hpp"

namespace holdfast::internal {

/// Boxes of equal footprint, exactly on top of each other, alone on a floor; each has uniform density.
struct Stack {
  Vec3 box_size = Vec3::Ones();  ///< of each box, m
  std::vector<double> masses;    ///< from the floor up, kg
  double friction = 0.5;         ///< of every pair of surfaces
};

/// A stack of `count` boxes of 1 kg.
Stack even_stack(std::size_t count, const Vec3& box_size, double friction);

/// The stack in the middle of a large container, at rest, without accelerations.
Scene scene_of(const Stack& stack);

/// Acceleration along x at which the stack begins to tip, m/s². The boxes above a joint tip over its edge when the
/// moment of the inertial forces exceeds that of the weight: a Σ m z = g (l/2) Σ m, with z the height of a centre above
/// the joint. The result is the smallest value over all joints.
double tipping_load(const Stack& stack, double gravity);

/// Acceleration along x at which the stack begins to slide, m/s²: μ g at every joint.
double sliding_load(const Stack& stack, double gravity);

/// Acceleration along x, applied for `duration` from rest, that makes the stack tip as one rigid body over its lowest
/// edge until its top box has moved by `distance`, m/s². With r and α the distance from that edge to the centre of mass
/// and its angle from the vertical, and I the moment of inertia about the edge, all of the whole stack:
/// θ'' = (M r / I) (a cos(α − θ) − g sin(α − θ)). Valid if the lowest joint is clearly the weakest.
double load_that_tips(const Stack& stack, double gravity, double distance, double duration);

}  // namespace holdfast::internal
