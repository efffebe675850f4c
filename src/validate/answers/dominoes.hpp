#pragma once

#include "validate/laboratory/laboratory.hpp"

namespace holdfast::internal {

/// A row of dominoes along x, `height` m high, height/8 thick, at a pitch of height/2. The first one falls over its
/// lower front edge with an angular velocity of 3 rad/s times √(0.25 m / height).
Scene domino_row(double height);

/// Speed of the front between the fourth domino and the eleventh, from the times at which each is tilted by 1°, m/s;
/// NaN if the front does not reach them.
double domino_speed(Laboratory& laboratory, double height);

}  // namespace holdfast::internal
