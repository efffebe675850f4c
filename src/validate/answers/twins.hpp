#pragma once

#include "validate/laboratory/laboratory.hpp"

namespace holdfast::internal {

/// Three flat boxes of equal mass on each other with friction 0.5, 0.3 and 0.2 from the floor up, in the middle of a
/// container 16 m square. Under an acceleration of 0.5 g they slide on each other. The inertial force and the friction
/// of its neighbours act on each: the top one accelerates with 0.5 g − 0.2 g, the middle one with 0.5 g − (0.6 − 0.2)
/// g; the lowest one, on which 0.5 + 0.6 of its weight acts, stays, because friction at the floor can balance 1.5.
Scene slipping_stack();

/// Three kinds of motion at once, under an oblique acceleration of 0.5 g for half a second: three flat boxes that slide
/// on each other, a slender box that topples, and a box that slides alone. There are no collisions, so that small
/// differences stay small. Coordinates are binary fractions and the container is 16 m square, so that mirroring is
/// exact.
Scene assorted_scene();

/// Lengths times the factor, times multiplied by its square root: every trajectory keeps its shape, since gravity is
/// the only other scale. The engine's step is scaled too; masses, which must be given, do not change.
Scene scaled_twin(const Scene& scene, double factor);

/// All masses times the factor. The masses of the boxes must be given.
Scene heavier_twin(const Scene& scene, double factor);

/// Mirrored along an axis, 0 or 1: x → L − x. For scenes at rest without rotated boxes.
Scene mirrored_twin(const Scene& scene, int axis);

/// x and y exchanged. For scenes at rest without rotated boxes.
Scene swapped_twin(const Scene& scene);

/// The boxes in reverse order.
Scene reversed_twin(const Scene& scene);

/// Largest distance between the centres of a box in two states, m; infinite if their numbers of boxes differ.
double distance_between(const Snapshot& a, const Snapshot& b);

/// Whether two states have the same bits.
bool same_bits(const Snapshot& a, const Snapshot& b);

}  // namespace holdfast::internal
