#pragma once

#include "validate/laboratory/laboratory.hpp"

namespace holdfast::internal {

/// Three flat boxes of equal mass on each other with friction 0.5, 0.3 and 0.2 from the floor up, in the middle of a
/// container 16 m square. Under a load of 0.5 g they slip on each other: with m a of its own and the friction of its
/// neighbours on each, the top one gains 0.5 g − 0.2 g, the middle one 0.5 g − (0.6 − 0.2) g; the lowest one, pulled
/// by 0.5 + 0.6 of its weight, stays, as the floor holds 1.5.
Scene slipping_stack();

/// Three kinds of motion at once, under an oblique load of 0.5 g for half a second: three flat boxes that slip on each
/// other, a slender box that topples, and a box that slides alone. Nothing collides, so that small differences stay
/// small. Coordinates are binary fractions, the container is 16 m square: mirroring it is exact.
Scene assorted_scene();

/// Lengths by the factor, times by its root: every trajectory keeps its shape, as gravity sets the only other scale.
/// The engine's step goes along; masses, which must be given, stay.
Scene scaled_twin(const Scene& scene, double factor);

/// All masses by the factor. The boxes' masses must be given.
Scene heavier_twin(const Scene& scene, double factor);

/// Mirrored along an axis, 0 or 1: x → L − x. For scenes at rest without turned boxes.
Scene mirrored_twin(const Scene& scene, int axis);

/// x and y exchanged. For scenes at rest without turned boxes.
Scene swapped_twin(const Scene& scene);

/// The boxes in reverse order.
Scene reversed_twin(const Scene& scene);

/// Largest distance of a box's centre in one state from that in the other, m; infinite unless both have as many boxes.
double distance_between(const Snapshot& a, const Snapshot& b);

/// Whether two states are the same bit for bit.
bool same_bits(const Snapshot& a, const Snapshot& b);

}  // namespace holdfast::internal
