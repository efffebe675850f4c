#pragma once

#include <vector>

#include "validate/laboratory/scene.hpp"

namespace holdfast::internal {

/// Boxes of one footprint on top of each other, flush, alone on a floor; uniform density each.
struct Stack {
  Vec3 box_size = Vec3::Ones();  ///< of each box, m
  std::vector<double> masses;    ///< from the floor up, kg
  double friction = 0.5;         ///< of every pair of surfaces
};

/// A stack of `count` boxes of 1 kg.
Stack even_stack(std::size_t count, const Vec3& box_size, double friction);

/// The stack in the middle of a large container, nothing moving, no motion yet.
Scene scene_of(const Stack& stack);

/// Load along x at which the stack begins to tip, m/s². The boxes above a joint tip over its edge when the moment of
/// the load passes that of the weight: a Σ m z = g (l/2) Σ m, z being the height of a centre above the joint. The joint
/// of the least load counts.
double tipping_load(const Stack& stack, double gravity);

/// Load along x at which the stack begins to slide, m/s²: μ g at every joint alike.
double sliding_load(const Stack& stack, double gravity);

/// Load along x, applied for `duration` from rest, that makes the stack tip as one rigid piece over its lowest edge
/// until its top box has moved by `distance`, m/s². With r and α the distance and the angle from the vertical of the
/// centre of mass seen from that edge, and I the moment of inertia about it, all of the whole stack: θ'' = (M r / I) (a
/// cos(α − θ) − g sin(α − θ)). Right where the lowest joint is the weakest by a margin.
double load_that_tips(const Stack& stack, double gravity, double distance, double duration);

}  // namespace holdfast::internal
