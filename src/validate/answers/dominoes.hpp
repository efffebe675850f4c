#pragma once

#include "validate/laboratory/laboratory.hpp"

namespace holdfast::internal {

/// A row of dominoes along x, `height` m high, height/8 thick and height/2 apart from face to like face. The first one
/// is on its way over, at a spin of 3 rad/s times √(0.25 m / height), about its lower front edge.
Scene domino_row(double height);

/// Speed of the front between the fourth domino and the eleventh, by when each is tilted by 1°, m/s; not a number when
/// it does not get there.
double domino_speed(Laboratory& laboratory, double height);

}  // namespace holdfast::internal
