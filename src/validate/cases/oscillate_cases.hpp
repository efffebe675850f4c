#pragma once

#include <vector>

#include "validate/laboratory/case.hpp"

namespace holdfast::internal {

/// The parts of the suite `oscillate`: accelerations that go to and fro, sampled as a recorder stores them.
std::vector<Case> rocking_train_cases();  ///< trains of sine cycles that overturn a block, or not
std::vector<Case> walk_cases();           ///< vibration moves boxes by micrometres per cycle; short shocks
std::vector<Case> kinetic_cases();        ///< kinetic friction below static friction: stick-slip
std::vector<Case> noise_cases();          ///< noise of the sea and of a lorry

/// Acceleration of gravity of the suite's scenes, m/s².
inline constexpr double kOscillateGravity = 9.81;

/// Boxes that move as one from rest, and what each moves by.
/// @return the displacement along y of the box that is farthest off, relative to the exact one, and the largest error
/// of
///         the displacement along x of any box, both over a length; nothing if the engine cannot model the scene
/// @param expected displacement of every box, m
/// @param distance that length, such as that of the exact path, m
std::vector<Measurement> moved_as_one(Laboratory& laboratory, const Scene& scene, const Vec3& expected, double distance,
                                      ToleranceClass tolerance);

/// Boxes of equal size on each other, in the middle of a container without walls near.
/// @param floor_friction of the box at the bottom with the floor
/// @param box_friction between the boxes
Scene tower(std::size_t count, const Vec3& box_size, double floor_friction, double box_friction);

}  // namespace holdfast::internal
